/// @file parameter_watch.h
#ifndef AIBO_DRIVER_NODE_PARAMETER_WATCH_H
#define AIBO_DRIVER_NODE_PARAMETER_WATCH_H

#include <xmlrpcpp/XmlRpcValue.h>

#include <map>
#include <string>
#include <vector>

namespace aibo_driver::node {

/// Values by the names of their parameters, as texts that can be compared.
using ParameterTexts = std::map<std::string, std::string>;

/// A running driver does not read its parameters again. This notices when somebody changes one nevertheless, such as
/// with rosparam set.
class ParameterWatch {
 public:
  /// @param at_start the driver's parameters as it has read them
  /// @param name_prefix the namespace of the parameters, with a slash at its end
  ParameterWatch(const XmlRpc::XmlRpcValue& at_start, const std::string& name_prefix);

  /// Call this every few seconds. A change is told at the second call that sees it.
  /// @param present the parameters now
  /// @param in_force the settings of dynamic_reconfigure. Their parameters follow a change of the settings a moment
  ///   later, so a difference counts when it is seen a second time.
  /// @return what to tell the user, once for each change
  std::vector<std::string> check(const XmlRpc::XmlRpcValue& present, const ParameterTexts& in_force);

 private:
  std::string describe(const std::string& name, const std::string& value, const ParameterTexts& in_force) const;

  const std::string name_prefix_;
  const ParameterTexts at_start_;
  ParameterTexts different_;  // from what they should be, in the last check
  ParameterTexts told_;       // changes that the user was told
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_PARAMETER_WATCH_H
