/// @file joints.h
#ifndef TEST_SUPPORT_ROS_JOINTS_H
#define TEST_SUPPORT_ROS_JOINTS_H

#include <sensor_msgs/JointState.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "support/ros/topics.h"

namespace test_support {

/// Positions of joints, in radians.
using Posture = std::map<std::string, double>;

/// A message for the topic joint_command.
inline sensor_msgs::JointState command(const Posture& posture) {
  sensor_msgs::JointState message;
  for (const auto& [joint, position] : posture) {
    message.name.push_back(joint);
    message.position.push_back(position);
  }
  return message;
}

/// A message for the topic joint_trajectory with one point.
inline trajectory_msgs::JointTrajectory trajectory(const Posture& posture, double seconds) {
  trajectory_msgs::JointTrajectory message;
  message.points.resize(1);
  message.points[0].time_from_start = ros::Duration(seconds);
  for (const auto& [joint, position] : posture) {
    message.joint_names.push_back(joint);
    message.points[0].positions.push_back(position);
  }
  return message;
}

/// The value of a joint in one of the arrays of a message, or nothing.
inline std::optional<double> valueOf(const sensor_msgs::JointState& message, const std::vector<double>& values,
                                     const std::string& joint) {
  const auto found = std::find(message.name.begin(), message.name.end(), joint);
  return found == message.name.end() ? std::nullopt
                                     : std::optional(values.at(static_cast<std::size_t>(found - message.name.begin())));
}

inline std::optional<double> positionOf(const sensor_msgs::JointState& message, const std::string& joint) {
  return valueOf(message, message.position, joint);
}

/// The absolute speed of a joint in a message, or nothing.
inline std::optional<double> speedOf(const sensor_msgs::JointState& message, const std::string& joint) {
  const std::optional<double> velocity = valueOf(message, message.velocity, joint);
  return velocity ? std::optional(std::abs(*velocity)) : std::nullopt;
}

/// Listens to joint_states.
class JointListener {
 public:
  /// Allows for the steps of an encoder and for rounding.
  static constexpr double kTolerance = 0.02;  // rad

  explicit JointListener(const std::string& name_space) : listener_(name_space + "/joint_states") {}

  /// Waits until the joints have these positions.
  /// @return the joints that were elsewhere in the last message; empty if all came in time
  Posture waitForPositions(const Posture& expected, std::chrono::milliseconds timeout = kSafetyNet) {
    Posture elsewhere = expected;
    listener_.clear();
    listener_.waitFor(
        [&](const sensor_msgs::JointState& message) {
          for (const auto& [joint, target] : expected) {
            if (const std::optional<double> position = positionOf(message, joint)) {
              elsewhere.erase(joint);
              if (!(std::abs(*position - target) <= kTolerance)) {
                elsewhere[joint] = *position;
              }
            }
          }
          return elsewhere.empty();
        },
        timeout);
    return elsewhere;
  }

  /// Waits until the joint moves slower than this.
  /// @return false if it did not in time
  bool waitForSpeedBelow(const std::string& joint, double speed) {
    listener_.clear();
    return listener_.waitFor([&](const auto& message) { return speedOf(message, joint).value_or(speed) < speed; }) !=
           nullptr;
  }

  /// The position of the joint in the next message that contains it.
  double position(const std::string& joint) {
    listener_.clear();
    const auto message = listener_.waitFor([&](const auto& candidate) { return positionOf(candidate, joint); });
    return message ? *positionOf(*message, joint) : std::numeric_limits<double>::quiet_NaN();
  }

  /// The highest speed of the joint in all messages so far.
  double highestSpeed(const std::string& joint) {
    double highest = 0;
    for (const auto& message : listener_.waitForCount(1)) {
      highest = std::max(highest, speedOf(*message, joint).value_or(0));
    }
    return highest;
  }

  TopicListener<sensor_msgs::JointState>& messages() { return listener_; }

 private:
  TopicListener<sensor_msgs::JointState> listener_;
};

}  // namespace test_support

#endif  // TEST_SUPPORT_ROS_JOINTS_H
