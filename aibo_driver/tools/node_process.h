/// @file node_process.h
/// Finds the process of a ROS node on this machine.
#ifndef AIBO_DRIVER_TOOLS_NODE_PROCESS_H
#define AIBO_DRIVER_TOOLS_NODE_PROCESS_H

#include <sys/types.h>

#include <chrono>
#include <optional>
#include <string>

namespace aibo_driver::tools {

/// Asks the ROS master and the node itself, and waits for each of them for 2 s at most.
/// @param node_name its full name, such as "/aibo/aibo_driver"
/// @return empty if the node does not answer, or runs on another machine
std::optional<pid_t> processOfNode(const std::string& node_name);

/// The processor time that all threads of a process on this machine have used since it began.
/// @return empty if there is no such process
std::optional<std::chrono::nanoseconds> processorTime(pid_t process);

}  // namespace aibo_driver::tools

#endif  // AIBO_DRIVER_TOOLS_NODE_PROCESS_H
