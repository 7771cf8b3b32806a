#include "body/motion_files.h"

#include <algorithm>
#include <cctype>

#include "files/files.h"
#include "mtn/layout.h"
#include "mtn/motion.h"

namespace aibo_driver::body {

std::string motionFileName(const std::string& name) {
  std::string file = name;
  if (!file.empty() && file.find('.') == std::string::npos) {
    file += ".MTN";
  }
  std::transform(file.begin(), file.end(), file.begin(), [](unsigned char c) { return std::toupper(c); });
  return file;
}

std::vector<std::uint8_t> loadMotion(const std::string& path) {
  std::vector<std::uint8_t> content = files::loadFile(path, mtn::MAX_FILE_SIZE);
  mtn::Motion motion;
  if (!motion.read(content.data(), content.size())) {
    throw files::FileException("'" + path + "' is not a motion file: " + motion.problem());
  }
  return content;
}

}  // namespace aibo_driver::body
