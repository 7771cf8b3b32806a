#include "openr_host/configuration/service_name.h"

#include <regex>

namespace openr_host {

std::optional<ServiceName> ServiceName::parse(const std::string& text) {
  static const std::regex pattern(R"((\w+)\.(\w+)\.(\w+)\.([SO]))");
  std::smatch part;
  if (!std::regex_match(text, part, pattern)) {
    return std::nullopt;
  }
  return ServiceName{part[1], part[2], part[3], part[4] == "S"};
}

std::string ServiceName::text() const {
  return object + "." + service + "." + data_type + (is_subject ? ".S" : ".O");
}

}  // namespace openr_host
