/// @file joint_listener.h
#ifndef TEST_SUPPORT_ROS_JOINT_LISTENER_H
#define TEST_SUPPORT_ROS_JOINT_LISTENER_H

#include <sensor_msgs/JointState.h>

#include <map>
#include <optional>
#include <string>

#include "support/ros/topic_listener.h"

namespace test_support {

/// The position of a joint in a message, or nothing.
std::optional<double> positionOf(const sensor_msgs::JointState& message, const std::string& joint);

/// How fast a joint moves in a message, whichever way, or nothing.
std::optional<double> speedOf(const sensor_msgs::JointState& message, const std::string& joint);

/// Follows joint_states.
class JointListener {
 public:
  /// What an encoder's steps and what is rounded on the way may add up to.
  static constexpr double kTolerance = 0.02;  // rad

  explicit JointListener(const std::string& name_space) : listener_(name_space + "/joint_states") {}

  /// Waits for a message in which the joints are where they are expected.
  /// @return the joints that are elsewhere in the last message, if there was none
  std::map<std::string, double> waitForPositions(const std::map<std::string, double>& expected);

  /// True if the joint comes to this position.
  bool waitForPosition(const std::string& joint, double expected) {
    return waitForPositions({{joint, expected}}).empty();
  }

  /// True if the joint comes to move slower than this.
  bool waitForSpeedBelow(const std::string& joint, double speed);

  /// The position of a joint in the next message with it.
  double position(const std::string& joint);

  /// The highest speed of a joint in all messages so far.
  double highestSpeed(const std::string& joint);

  TopicListener<sensor_msgs::JointState>& messages() { return listener_; }

 private:
  TopicListener<sensor_msgs::JointState> listener_;
};

}  // namespace test_support

#endif  // TEST_SUPPORT_ROS_JOINT_LISTENER_H
