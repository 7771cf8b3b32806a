/// @file driver_search.h
#ifndef AIBO_DRIVER_REMOTE_CONTROL_DRIVER_SEARCH_H
#define AIBO_DRIVER_REMOTE_CONTROL_DRIVER_SEARCH_H

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace aibo_driver::remote_control {

/// What the ROS master knows of topics.
struct MasterState {
  std::map<std::string, std::string> types;                    ///< of topics, by name
  std::map<std::string, std::vector<std::string>> publishers;  ///< nodes, by topic
};

/// Asks the ROS master. Waits for its answer, but not for a master that is not there.
/// @return empty if it does not answer
std::optional<MasterState> askMaster();

/// The namespaces in which there are drivers, such as "/aibo": those with a topic `connection` of ours.
std::vector<std::string> driversIn(const MasterState& state);

/// Where the driver in a namespace has its settings (dynamic_reconfigure): the namespace of its parameters, such as
/// "/aibo/aibo_driver". It is found by the node that publishes `connection`.
/// @return empty if the driver is not known to the master
std::string settingsOf(const std::string& name_space, const MasterState& state);

}  // namespace aibo_driver::remote_control

#endif  // AIBO_DRIVER_REMOTE_CONTROL_DRIVER_SEARCH_H
