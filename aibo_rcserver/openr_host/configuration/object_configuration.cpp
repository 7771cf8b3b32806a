#include "openr_host/configuration/object_configuration.h"

#include <algorithm>
#include <cctype>
#include <regex>

#include "openr_host/configuration/configuration_error.h"

namespace openr_host {
namespace {

std::string withoutCommentAndSpace(const std::string& line) {
  const char space[] = " \t\r";
  const std::string text = line.substr(0, line.find('#'));
  const auto begin = text.find_first_not_of(space);
  return begin == std::string::npos ? "" : text.substr(begin, text.find_last_not_of(space) - begin + 1);
}

std::string inCapitals(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

}  // namespace

std::vector<ObjectFile> readObjectConfiguration(std::istream& text, const std::string& file,
                                                const std::string& design) {
  static const std::regex section_pattern(R"(\[\s*([^\]]+?)\s*\])");
  // Names on the stick have at most eight characters and three more.
  static const std::regex object_pattern(R"(/MS/OPEN-R/MW/OBJS/([\w~$-]{1,8}\.BIN))", std::regex::icase);

  std::vector<ObjectFile> objects;
  bool is_for_design = true;
  int line = 0;
  for (std::string raw; std::getline(text, raw);) {
    ++line;
    const std::string content = withoutCommentAndSpace(raw);
    std::smatch part;
    if (content.empty()) {
      continue;
    }
    if (std::regex_match(content, part, section_pattern)) {
      is_for_design = part[1] == design;
      continue;
    }
    if (!std::regex_match(content, part, object_pattern)) {
      throw ConfigurationError(
          file, line,
          "expected an object such as /MS/OPEN-R/MW/OBJS/RCSERVER.BIN (a name of at most 8 characters and "
          ".BIN), or a model such as [ERS-7], found '" +
              content + "'");
    }
    const std::string name = inCapitals(part[1]);
    if (!is_for_design) {
      continue;
    }
    if (std::any_of(objects.begin(), objects.end(), [&](const ObjectFile& other) { return other.name == name; })) {
      throw ConfigurationError(file, line, name + " stands here a second time");
    }
    objects.push_back({name, line});
  }
  return objects;
}

}  // namespace openr_host
