#include "support/ros/driver_process.h"

#include <cstdlib>

namespace test_support {

std::vector<std::string> nodeletHost(const std::vector<std::string>& arguments) {
  std::vector<std::string> command{"rosrun"};
  if (const std::string library = SANITIZER_LIBRARY; !library.empty()) {
    const char* options = std::getenv("ASAN_OPTIONS");
    command.insert(command.end(), {"--prefix", "env LD_PRELOAD=" + library + " ASAN_OPTIONS=" +
                                                   (options != nullptr ? options : "") + ":detect_leaks=0"});
  }
  command.insert(command.end(), {"nodelet", "nodelet"});
  command.insert(command.end(), arguments.begin(), arguments.end());
  return command;
}

}  // namespace test_support
