#include "node/parameter_watch.h"

#include <sstream>
#include <utility>

#include "text/plain_text.h"

namespace aibo_driver::node {
namespace {

using XmlRpc::XmlRpcValue;

std::string textOf(XmlRpcValue value) {
  std::ostringstream text;
  switch (value.getType()) {
    case XmlRpcValue::TypeInt:
      text << static_cast<int>(value);
      break;
    case XmlRpcValue::TypeDouble:
      text << static_cast<double>(value);
      break;
    case XmlRpcValue::TypeBoolean:
      text << (static_cast<bool>(value) ? "true" : "false");
      break;
    case XmlRpcValue::TypeString:
      text << static_cast<std::string>(value);
      break;
    default:
      value.write(text);
  }
  return text::plainLine(text.str());
}

/// Leaves out namespaces below this one, which belong to others.
ParameterTexts textsOf(XmlRpcValue values) {
  ParameterTexts texts;
  if (values.getType() == XmlRpcValue::TypeStruct) {
    for (auto& entry : values) {
      if (entry.second.getType() != XmlRpcValue::TypeStruct) {
        texts[entry.first] = textOf(entry.second);
      }
    }
  }
  return texts;
}

bool has(const ParameterTexts& texts, const ParameterTexts::value_type& text) {
  const auto found = texts.find(text.first);
  return found != texts.end() && *found == text;
}

}  // namespace

ParameterWatch::ParameterWatch(const XmlRpcValue& at_start, const std::string& name_prefix)
    : name_prefix_(name_prefix), at_start_(textsOf(at_start)) {}

std::vector<std::string> ParameterWatch::check(const XmlRpcValue& present, const ParameterTexts& in_force) {
  std::vector<std::string> news;
  ParameterTexts expected = in_force;
  expected.insert(at_start_.begin(), at_start_.end());
  const ParameterTexts before = std::exchange(different_, {});
  const ParameterTexts told = std::exchange(told_, {});
  for (const auto& parameter : textsOf(present)) {
    const auto& [name, value] = parameter;
    if (has(expected, parameter)) {
      continue;
    }
    different_.insert(parameter);
    if (has(told, parameter)) {
      told_.insert(parameter);
    } else if (has(before, parameter)) {
      told_.insert(parameter);
      news.push_back(describe(name, value, in_force));
    }
  }
  return news;
}

std::string ParameterWatch::describe(const std::string& name, const std::string& value,
                                     const ParameterTexts& in_force) const {
  const std::string what = "Parameter " + name_prefix_ + name + " was set to '" + value + "', ";
  const auto setting = in_force.find(name);
  if (setting == in_force.end()) {
    return what + "which has no effect before the driver is started again.";
  }
  const std::string node = name_prefix_.substr(0, name_prefix_.size() - 1);
  return what + "but '" + setting->second +
         "' stays in force, because a running driver does not read parameters. Use " +
         "'rosrun dynamic_reconfigure dynparam set " + node + " " + name + " " + value + "' instead.";
}

}  // namespace aibo_driver::node
