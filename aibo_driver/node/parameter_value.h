/// @file parameter_value.h Reads values of parameters, and makes messages about refused ones. Any thread may call the
///   functions.
#ifndef AIBO_DRIVER_NODE_PARAMETER_VALUE_H
#define AIBO_DRIVER_NODE_PARAMETER_VALUE_H

#include <xmlrpcpp/XmlRpcValue.h>

#include <string>

namespace aibo_driver::node {

/// @return the number, whole or not; NaN if the value is anything else, such as a text
double numberIn(XmlRpc::XmlRpcValue value);

/// A sentence for the user about a parameter that is refused.
/// @param name the name with its namespace
/// @param allowed the words to put after "it must be"
std::string describeRefusal(const std::string& name, XmlRpc::XmlRpcValue value, const std::string& allowed);

/// What a user can do about a parameter that is refused, as a sentence.
constexpr const char* kHowToRemove = "'rosparam delete NAME' removes a parameter that was set before.";

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_PARAMETER_VALUE_H
