/// @file driver_process.h
#ifndef TEST_SUPPORT_ROS_DRIVER_PROCESS_H
#define TEST_SUPPORT_ROS_DRIVER_PROCESS_H

#include <map>
#include <string>
#include <vector>

#include "support/process.h"

namespace test_support {

/// A parameter: all pictures come over the connection, and so through a proxy.
constexpr const char* kByTcp = "_transport:=tcp";

// Pictures come although nobody subscribes.
constexpr const char* kStreams = "_stream_on_demand:=false";

/// The executable aibo_driver_node in a namespace of its own.
class DriverProcess : public Process {
 public:
  /// @param name_space such as "/services"
  /// @param port of its robot, on 127.0.0.1
  /// @param parameters further private parameters, such as "_stream_on_start:=false"
  /// @param environment as for Process
  /// @param program another executable that takes the same arguments
  DriverProcess(const std::string& name_space, int port, const std::vector<std::string>& parameters = {},
                const std::map<std::string, std::string>& environment = {},
                const std::string& program = AIBO_DRIVER_NODE)
      : Process(command({program, "__ns:=" + name_space, "_port:=" + std::to_string(port)}, parameters), environment) {}

 private:
  static std::vector<std::string> command(std::vector<std::string> words, const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }
};

/// The command that starts ROS' host of nodelets. In a build with a sanitizer, the sanitizer's library is preloaded,
/// and leaks are not reported, because the host itself has some.
/// @param arguments such as {"standalone", "aibo_driver/AiboDriverNodelet"}
std::vector<std::string> nodeletHost(const std::vector<std::string>& arguments);

}  // namespace test_support

#endif  // TEST_SUPPORT_ROS_DRIVER_PROCESS_H
