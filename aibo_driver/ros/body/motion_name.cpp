#include "ros/body/motion_name.h"

#include <algorithm>
#include <cctype>

namespace aibo_driver::node {

std::string motionFileName(const std::string& name) {
  std::string file = name;
  if (!file.empty() && file.find('.') == std::string::npos) {
    file += ".MTN";
  }
  std::transform(file.begin(), file.end(), file.begin(), [](unsigned char c) { return std::toupper(c); });
  return file;
}

}  // namespace aibo_driver::node
