#include "simulator/openr_host/configuration/object_configuration.h"

#include <algorithm>
#include <cctype>
#include <optional>

#include "simulator/openr_host/configuration/configuration_error.h"
#include "simulator/openr_host/configuration/model_lines.h"

namespace openr_host {
namespace {

std::string inCapitals(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(),
                 [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  return text;
}

/// The name, in capitals, of an object's file. Names on the stick have at most eight characters and three more.
std::optional<std::string> parseObject(const std::string& content) {
  const std::string folder = "/MS/OPEN-R/MW/OBJS/";
  const std::string ending = ".BIN";
  const std::string path = inCapitals(content);
  if (path.size() < folder.size() + 1 + ending.size() || path.size() > folder.size() + 8 + ending.size() ||
      path.compare(0, folder.size(), folder) != 0 ||
      path.compare(path.size() - ending.size(), ending.size(), ending) != 0) {
    return std::nullopt;
  }
  const std::string name = path.substr(folder.size());
  const bool has_a_name_of_the_stick = std::all_of(name.begin(), name.end() - ending.size(), [](unsigned char c) {
    return std::isalnum(c) != 0 || std::string("_~$-").find(static_cast<char>(c)) != std::string::npos;
  });
  return has_a_name_of_the_stick ? std::make_optional(name) : std::nullopt;
}

}  // namespace

std::vector<ObjectFile> readObjectConfiguration(std::istream& text, const std::string& file,
                                                const std::string& design) {
  std::vector<ObjectFile> objects;
  for (const auto& line : readModelLines(text, design)) {
    const auto name = parseObject(line.text);
    if (!name) {
      throw ConfigurationError(
          file, line.number,
          "expected an object such as /MS/OPEN-R/MW/OBJS/RCSERVER.BIN (a name of at most 8 characters and "
          ".BIN), or a model such as [ERS-7], found '" +
              line.text + "'");
    }
    if (!line.is_for_design) {
      continue;
    }
    if (std::any_of(objects.begin(), objects.end(), [&](const ObjectFile& other) { return other.name == *name; })) {
      throw ConfigurationError(file, line.number, *name + " stands here a second time");
    }
    objects.push_back({*name, line.number});
  }
  return objects;
}

}  // namespace openr_host
