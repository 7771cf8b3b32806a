/// @file joint_listener.h
#ifndef TEST_SUPPORT_ROS_JOINT_LISTENER_H
#define TEST_SUPPORT_ROS_JOINT_LISTENER_H

#include <sensor_msgs/JointState.h>

#include <chrono>
#include <map>
#include <optional>
#include <string>

#include "support/ros/topic_listener.h"

namespace test_support {

/// The position of a joint in a message, or nothing.
std::optional<double> positionOf(const sensor_msgs::JointState& message, const std::string& joint);

/// The absolute speed of a joint in a message, or nothing.
std::optional<double> speedOf(const sensor_msgs::JointState& message, const std::string& joint);

/// Listens to joint_states.
class JointListener {
 public:
  /// Allows for the steps of an encoder and for rounding.
  static constexpr double kTolerance = 0.02;  // rad

  explicit JointListener(const std::string& name_space) : listener_(name_space + "/joint_states") {}

  /// Waits until the joints have these positions.
  /// @return the joints that were elsewhere in the last message; empty if all came in time
  std::map<std::string, double> waitForPositions(const std::map<std::string, double>& expected,
                                                 std::chrono::milliseconds timeout = kSafetyNet);

  /// Waits until the joint has this position.
  /// @return false if it did not in time
  bool waitForPosition(const std::string& joint, double expected) {
    return waitForPositions({{joint, expected}}).empty();
  }

  /// Waits until the joint moves slower than this.
  /// @return false if it did not in time
  bool waitForSpeedBelow(const std::string& joint, double speed);

  /// The position of the joint in the next message that contains it.
  double position(const std::string& joint);

  /// The highest speed of the joint in all messages so far.
  double highestSpeed(const std::string& joint);

  TopicListener<sensor_msgs::JointState>& messages() { return listener_; }

 private:
  TopicListener<sensor_msgs::JointState> listener_;
};

}  // namespace test_support

#endif  // TEST_SUPPORT_ROS_JOINT_LISTENER_H
