/// @file driver_search.h
#ifndef AIBO_DRIVER_REMOTE_CONTROL_DRIVER_SEARCH_H
#define AIBO_DRIVER_REMOTE_CONTROL_DRIVER_SEARCH_H

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace aibo_driver::remote_control {

/// The topics that have publishers, and their types.
using TopicTypes = std::map<std::string, std::string>;

/// Asks the ROS master for its topics, and waits for the answer for 2 s at most.
/// @return empty if the master does not answer
std::optional<TopicTypes> askMaster();

/// The namespaces in which there are drivers, such as "/aibo". These are the namespaces with a topic `connection` of
/// our type.
std::vector<std::string> driversIn(const TopicTypes& types);

/// The driver to try after the one in this namespace: the next of those found. After the last one comes the first.
/// @param found the namespaces that driversIn() has found
/// @return the same namespace if no driver was found
std::string driverAfter(const std::string& name_space, const std::vector<std::string>& found);

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_DRIVER_SEARCH_H
