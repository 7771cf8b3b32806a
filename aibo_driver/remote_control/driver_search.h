/// @file driver_search.h
#ifndef AIBO_DRIVER_REMOTE_CONTROL_DRIVER_SEARCH_H
#define AIBO_DRIVER_REMOTE_CONTROL_DRIVER_SEARCH_H

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace aibo_driver::remote_control {

/// What the ROS master knows about topics and parameters.
struct MasterState {
  std::map<std::string, std::string> types;                    ///< the types of topics; the key is the topic
  std::map<std::string, std::vector<std::string>> publishers;  ///< the nodes that publish a topic; the key is the topic
  std::set<std::string> parameters;
};

/// Asks the ROS master. It waits for each of three answers for 2 s at most.
/// @return empty if the master does not answer
std::optional<MasterState> askMaster();

/// The namespaces in which there are drivers, such as "/aibo". These are the namespaces with a topic `connection` of
/// our type.
std::vector<std::string> driversIn(const MasterState& state);

/// The driver to try after the one in this namespace: the next of those found. The first one follows the last one.
/// @param found as driversIn() gives them
/// @return the same namespace if no driver was found
std::string driverAfter(const std::string& name_space, const std::vector<std::string>& found);

/// Where the driver in a namespace has its settings (dynamic_reconfigure). This is the namespace of its parameters,
/// such as "/aibo/aibo_driver". The node that publishes `connection` leads to it.
/// @return empty if the master does not know the driver
std::string settingsOf(const std::string& name_space, const MasterState& state);

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_DRIVER_SEARCH_H
