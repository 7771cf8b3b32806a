/// @file diagnostics_listener.h
#ifndef TEST_ROS_DIAGNOSTICS_LISTENER_H
#define TEST_ROS_DIAGNOSTICS_LISTENER_H

#include <diagnostic_msgs/DiagnosticArray.h>

#include <string>

#include "support/ros/topics.h"

namespace test_support {

/// Waits for statuses in /diagnostics.
class DiagnosticsListener {
 public:
  DiagnosticsListener() : listener_("/diagnostics") {}

  /// Waits for a status of this name that comes after this call and fulfils the condition.
  /// @return an empty status if it did not come in time
  template <typename Condition>
  diagnostic_msgs::DiagnosticStatus waitFor(const std::string& name, Condition condition) {
    listener_.clear();
    diagnostic_msgs::DiagnosticStatus found;
    listener_.waitFor([&](const diagnostic_msgs::DiagnosticArray& array) {
      for (const diagnostic_msgs::DiagnosticStatus& status : array.status) {
        if (status.name == name && condition(status)) {
          found = status;
          return true;
        }
      }
      return false;
    });
    return found;
  }

  diagnostic_msgs::DiagnosticStatus waitForNext(const std::string& name) {
    return waitFor(name, [](const diagnostic_msgs::DiagnosticStatus&) { return true; });
  }

  /// The value of a key; empty without this key.
  static std::string value(const diagnostic_msgs::DiagnosticStatus& status, const std::string& key) {
    for (const diagnostic_msgs::KeyValue& entry : status.values) {
      if (entry.key == key) {
        return entry.value;
      }
    }
    return {};
  }

 private:
  TopicListener<diagnostic_msgs::DiagnosticArray> listener_;
};

}  // namespace test_support

#endif  // TEST_ROS_DIAGNOSTICS_LISTENER_H
