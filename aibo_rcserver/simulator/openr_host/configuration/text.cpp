#include "simulator/openr_host/configuration/text.h"

#include <algorithm>
#include <cctype>
#include <sstream>

namespace openr_host {
namespace {

bool isWord(const std::string& text) {
  return !text.empty() &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
}

}  // namespace

std::optional<ServiceName> ServiceName::parse(const std::string& text) {
  const auto parts = splitAt('.', text);
  if (parts.size() != 4 || !std::all_of(parts.begin(), parts.end(), isWord) || (parts[3] != "S" && parts[3] != "O")) {
    return std::nullopt;
  }
  return ServiceName{parts[0], parts[1], parts[2], parts[3] == "S"};
}

std::string ServiceName::text() const {
  return object + "." + service + "." + data_type + (is_subject ? ".S" : ".O");
}

std::string withoutSpaceAround(const std::string& text) {
  constexpr char kSpace[] = " \t\r";
  const auto begin = text.find_first_not_of(kSpace);
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(kSpace) - begin + 1);
}

std::vector<std::string> splitAt(char separator, const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream rest(text + separator);
  for (std::string part; std::getline(rest, part, separator);) {
    parts.push_back(part);
  }
  return parts;
}

}  // namespace openr_host
