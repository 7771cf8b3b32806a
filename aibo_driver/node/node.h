/// @file node.h
/// Functions that the programs of this package need to be ROS nodes.
#ifndef AIBO_DRIVER_NODE_NODE_H
#define AIBO_DRIVER_NODE_NODE_H

#include <ros/node_handle.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>

namespace aibo_driver::node {

/// Where a node finds its topics and services. A node that rosrun starts in the root namespace uses the same names as
/// one that is launched. The log says so.
/// @param handle the namespace that the node was started in
/// @param default_namespace used instead of the root namespace, such as "aibo"
ros::NodeHandle inDriverNamespace(const ros::NodeHandle& handle, const std::string& default_namespace);

/// @return the number, whole or not; NaN if the value is anything else, such as a text
double numberIn(XmlRpc::XmlRpcValue value);

/// A sentence for the user about a parameter that is refused.
/// @param name the name with its namespace
/// @param allowed the words to put after "it must be"
std::string describeRefusal(const std::string& name, XmlRpc::XmlRpcValue value, const std::string& allowed);

/// What a user can do about a parameter that is refused, as a sentence.
constexpr const char* kHowToRemove = "'rosparam delete NAME' removes a parameter that was set before.";

/// Reads a parameter that is a number.
/// @param number the value if the parameter is not set
/// @param highest, lowest the range of values that are allowed
/// @throw std::runtime_error the parameter is not a number, or is out of this range; the message names it and the range
double readNumber(const ros::NodeHandle& parameters, const std::string& name, double number, double highest,
                  double lowest = 0);

/// Reads a parameter that is true or false. It is false if it is not set.
/// @throw std::runtime_error the parameter is something else, such as 1 or a text; the message names it
bool readFlag(const ros::NodeHandle& parameters, const std::string& name);

/// Calls ros::init(). From then on, each line that this process logs, also by roscpp itself, is plain, and a flood of
/// lines is limited (text/log_lines.h), in the terminal as in /rosout. Only nodes of runNode() have /rosout.
///
/// If roscpp cannot make a name of an argument, such as host:=192.168.1.20 without the underscore of a parameter,
/// init() says so and ends the process with EXIT_FAILURE. roscpp itself would abort the process.
/// @param options ros::InitOption
void init(int& argc, char** argv, const std::string& name, std::uint32_t options = 0);

/// Runs a node until it is shut down. It serves the global callback queue.
///
/// On Ctrl-C (SIGINT) or SIGTERM the node ends as roscpp does on Ctrl-C, but within 10 s: roscpp unregisters each topic
/// and service with the ROS master and waits for its answers without limit. If that takes longer, the process says so
/// on stderr and ends at once with EXIT_FAILURE. A second signal always ends it at once.
///
/// Call this once, from main(), after init(). It takes over the signal SIGALRM.
/// @param name the name for the log, to put into "The ... cannot start."
/// @param make makes the objects of the node, which live until the node ends
/// @return the exit status; EXIT_FAILURE if `make` throws
int runNode(const std::string& name, const std::function<std::shared_ptr<void>()>& make);

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_NODE_H
