#include "simulator/openr_host/configuration/model_lines.h"

#include <optional>

#include "simulator/openr_host/configuration/text.h"

namespace openr_host {
namespace {

/// The model that "[MODEL]" names.
std::optional<std::string> parseSection(const std::string& content) {
  if (content.size() < 2 || content.front() != '[' || content.find(']') != content.size() - 1) {
    return std::nullopt;
  }
  return withoutSpaceAround(content.substr(1, content.size() - 2));
}

}  // namespace

std::vector<ModelLine> readModelLines(std::istream& text, const std::string& design) {
  std::vector<ModelLine> lines;
  bool is_for_design = true;
  int number = 0;
  for (std::string raw; std::getline(text, raw);) {
    ++number;
    const std::string content = withoutSpaceAround(raw.substr(0, raw.find('#')));
    if (const auto section = parseSection(content)) {
      is_for_design = *section == design;
    } else if (!content.empty()) {
      lines.push_back({content, number, is_for_design});
    }
  }
  return lines;
}

}  // namespace openr_host
