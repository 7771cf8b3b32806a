#include "support/ros/driver_process.h"

namespace test_support {
namespace {

std::vector<std::string> command(const std::string& name_space, int port, const std::vector<std::string>& parameters) {
  std::vector<std::string> result{AIBO_DRIVER_NODE, "__ns:=" + name_space, "_port:=" + std::to_string(port)};
  result.insert(result.end(), parameters.begin(), parameters.end());
  return result;
}

}  // namespace

DriverProcess::DriverProcess(const std::string& name_space, int port, const std::vector<std::string>& parameters,
                             const std::map<std::string, std::string>& environment)
    : Process(command(name_space, port, parameters), environment) {}

}  // namespace test_support
