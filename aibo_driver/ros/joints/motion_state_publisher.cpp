#include "ros/joints/motion_state_publisher.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>

namespace aibo_driver::node {
namespace {

using movement::MovementEnd;

// The end of a trajectory is computed anew each time, from two clocks.
constexpr double kSameEnd = 0.05;  // s

std::uint8_t kindConstant(movement::Movement::Kind kind) {
  switch (kind) {
    case movement::Movement::Kind::kCommand:
      return Movement::COMMAND;
    case movement::Movement::Kind::kTrajectory:
      return Movement::TRAJECTORY;
    case movement::Movement::Kind::kWalk:
      return Movement::WALK;
    case movement::Movement::Kind::kPosture:
      return Movement::POSTURE;
    case movement::Movement::Kind::kMotion:
      break;
  }
  return Movement::MOTION;
}

std::string kindOf(const Movement& movement) {
  switch (movement.kind) {
    case Movement::COMMAND:
      return "command";
    case Movement::TRAJECTORY:
      return "trajectory";
    case Movement::WALK:
      return "walk";
    case Movement::POSTURE:
      return "posture " + movement.name;
    default:
      return "motion " + movement.name;
  }
}

std::string describe(const Movement& movement) {
  std::string text = kindOf(movement);
  const char* separator = " of ";
  for (const std::string& joint : movement.joints) {
    text += separator + joint;
    separator = ", ";
  }
  return text;
}

std::string describe(const MotionState& state) {
  std::string text;
  for (const Movement& movement : state.movements) {
    text += (text.empty() ? "moved by " : " and ") + describe(movement);
  }
  text = text.empty() ? "nothing moves the robot" : text;
  if (state.last.kind == Movement::NONE) {
    return text;
  }
  return text + "; last ended: " + describe(state.last) +
         (state.last_reason.empty() ? ", done" : ": " + state.last_reason);
}

Movement toMessage(const movement::Movement& movement, JointMover::SteadyTime steady_now, const ros::Time& now) {
  Movement message;
  message.kind = kindConstant(movement.kind);
  message.name = movement.name;
  message.source = movement.source;
  message.joints = movement.joints;
  if (movement.end) {
    message.end = now + ros::Duration(std::max(0.0, std::chrono::duration<double>(*movement.end - steady_now).count()));
  }
  return message;
}

bool areSame(const Movement& a, const Movement& b) {
  const double difference = a.end.toSec() - b.end.toSec();
  return a.kind == b.kind && a.name == b.name && a.source == b.source && a.joints == b.joints &&
         difference > -kSameEnd && difference < kSameEnd;
}

bool areSame(const MotionState& a, const MotionState& b) {
  if (a.movements.size() != b.movements.size()) {
    return false;
  }
  for (std::size_t i = 0; i < a.movements.size(); ++i) {
    if (!areSame(a.movements[i], b.movements[i])) {
      return false;
    }
  }
  return areSame(a.last, b.last) && a.last_end == b.last_end && a.last_reason == b.last_reason;
}

}  // namespace

std::uint8_t endConstant(MovementEnd how) {
  switch (how) {
    case MovementEnd::kDone:
      return MotionState::DONE;
    case MovementEnd::kReplaced:
      return MotionState::REPLACED;
    case MovementEnd::kStopped:
      return MotionState::STOPPED;
    case MovementEnd::kRefused:
      return MotionState::REFUSED;
    case MovementEnd::kFell:
      return MotionState::FELL;
    case MovementEnd::kUnknown:
      break;
  }
  return MotionState::UNKNOWN;
}

MotionState toMessage(const JointMover::State& state, JointMover::SteadyTime steady_now, const ros::Time& now) {
  MotionState message;
  message.header.stamp = now;
  for (const movement::Movement& movement : state.movements) {
    message.movements.push_back(toMessage(movement, steady_now, now));
  }
  if (state.last) {
    message.last = toMessage(state.last->movement, steady_now, now);
    message.last.end = ros::Time();
    message.last_end = endConstant(state.last->how);
    message.last_reason = state.last->reason;
  }
  message.text = describe(message);
  return message;
}

MotionStatePublisher::MotionStatePublisher(const ros::NodeHandle& handle, const JointMover& mover) : mover_(mover) {
  constexpr bool kLatched = true;
  publisher_ = ros::NodeHandle(handle).advertise<MotionState>("motion_state", 10, kLatched);
  last_ = toMessage(mover_.state(), std::chrono::steady_clock::now(), ros::Time::now());
  publisher_.publish(last_);
}

void MotionStatePublisher::publish() {
  const std::lock_guard<std::mutex> lock(mutex_);  // the newest state is published last
  const MotionState present = toMessage(mover_.state(), std::chrono::steady_clock::now(), ros::Time::now());
  if (!areSame(present, last_)) {
    last_ = present;
    publisher_.publish(present);
  }
}

}  // namespace aibo_driver::node
