#include "body/motion_files.h"

#include "files/files.h"
#include "mtn/layout.h"
#include "mtn/motion.h"

namespace aibo_driver::body {

std::string motionFileName(const std::string& name) {
  return files::fileNameOnRobot(name, ".MTN");
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
