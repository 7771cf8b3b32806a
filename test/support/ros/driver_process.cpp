#include "support/ros/driver_process.h"

#include <cstdlib>

namespace test_support {
namespace {

std::vector<std::string> command(const std::string& program, const std::string& name_space, int port,
                                 const std::vector<std::string>& parameters) {
  std::vector<std::string> result{program, "__ns:=" + name_space, "_port:=" + std::to_string(port)};
  result.insert(result.end(), parameters.begin(), parameters.end());
  return result;
}

}  // namespace

DriverProcess::DriverProcess(const std::string& name_space, int port, const std::vector<std::string>& parameters,
                             const std::map<std::string, std::string>& environment, const std::string& program)
    : Process(command(program, name_space, port, parameters), environment) {}

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
