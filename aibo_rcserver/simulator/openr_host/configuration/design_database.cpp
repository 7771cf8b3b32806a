#include "simulator/openr_host/configuration/design_database.h"

#include <strings.h>

#include <sstream>

#include "simulator/openr_host/configuration/configuration_error.h"
#include "simulator/openr_host/configuration/model_lines.h"

namespace openr_host {

std::map<std::string, std::string> readDesignDatabase(std::istream& text, const std::string& file,
                                                      const std::string& design) {
  const std::string stick = "/MS/";
  std::map<std::string, std::string> files;
  for (const auto& line : readModelLines(text, design)) {
    std::istringstream words(line.text);
    std::string keyword;
    std::string path;
    std::string more;
    words >> keyword >> path >> more;
    if (path.size() <= stick.size() || strncasecmp(path.c_str(), stick.c_str(), stick.size()) != 0 || !more.empty()) {
      throw ConfigurationError(file, line.number,
                               "expected a keyword and a file such as /MS/OPEN-R/MW/DATA/P/SOUND.WAV, or a model such "
                               "as [ERS-7], found '" +
                                   line.text + "'");
    }
    if (line.is_for_design && !files.emplace(keyword, path.substr(stick.size())).second) {
      throw ConfigurationError(file, line.number, "a second " + keyword);
    }
  }
  return files;
}

}  // namespace openr_host
