#include "support/ros/joint_listener.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace test_support {

namespace {

// The value of a joint in one of the arrays of a message.
std::optional<double> valueOf(const sensor_msgs::JointState& message, const std::vector<double>& values,
                              const std::string& joint) {
  const auto found = std::find(message.name.begin(), message.name.end(), joint);
  if (found == message.name.end()) {
    return std::nullopt;
  }
  return values.at(static_cast<std::size_t>(found - message.name.begin()));
}

}  // namespace

std::optional<double> positionOf(const sensor_msgs::JointState& message, const std::string& joint) {
  return valueOf(message, message.position, joint);
}

std::optional<double> speedOf(const sensor_msgs::JointState& message, const std::string& joint) {
  const std::optional<double> velocity = valueOf(message, message.velocity, joint);
  return velocity ? std::optional<double>(std::abs(*velocity)) : std::nullopt;
}

std::map<std::string, double> JointListener::waitForPositions(const std::map<std::string, double>& expected,
                                                              std::chrono::milliseconds timeout) {
  listener_.clear();
  std::map<std::string, double> elsewhere;
  std::map<std::string, double> latest;
  listener_.waitFor(
      [&](const sensor_msgs::JointState& message) {
        for (std::size_t i = 0; i < message.name.size(); ++i) {
          latest[message.name[i]] = message.position[i];
        }
        elsewhere.clear();
        for (const auto& joint : expected) {
          const auto found = latest.find(joint.first);
          const double position = found == latest.end() ? std::numeric_limits<double>::quiet_NaN() : found->second;
          if (!(std::abs(position - joint.second) <= kTolerance)) {
            elsewhere[joint.first] = position;
          }
        }
        return elsewhere.empty();
      },
      timeout);
  return elsewhere;
}

bool JointListener::waitForSpeedBelow(const std::string& joint, double speed) {
  listener_.clear();
  return listener_.waitFor([&](const auto& message) { return speedOf(message, joint).value_or(speed) < speed; }) !=
         nullptr;
}

double JointListener::position(const std::string& joint) {
  listener_.clear();
  const auto message = listener_.waitFor([&](const auto& candidate) { return positionOf(candidate, joint); });
  return message ? *positionOf(*message, joint) : std::numeric_limits<double>::quiet_NaN();
}

double JointListener::highestSpeed(const std::string& joint) {
  double highest = 0;
  for (const auto& message : listener_.waitForCount(1)) {
    highest = std::max(highest, speedOf(*message, joint).value_or(0));
  }
  return highest;
}

}  // namespace test_support
