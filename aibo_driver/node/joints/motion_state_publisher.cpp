#include "node/joints/motion_state_publisher.h"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

namespace aibo_driver::node {
namespace {

std::string describe(const movement::Mover::State& state) {
  std::string text;
  for (const movement::Movement& movement : state.movements) {
    const std::string what = movement::describe(movement);
    text += text.empty() ? "moved by " : " and ";
    text += movement.source.empty() ? what : movement.source + " (" + what + ")";
  }
  text = text.empty() ? "nothing moves the robot" : text;
  if (state.ended.empty()) {
    return text;
  }
  const movement::EndedMovement& last = state.ended.back();
  return text + "; last ended: " + movement::describe(last.movement) +
         (last.how == aibo_client::EndedHow::kDone ? ", done" : ": " + last.reason);
}

Movement toMessage(const movement::Movement& movement, movement::SteadyTime steady_now, const ros::Time& now) {
  Movement message;
  message.kind = static_cast<std::uint8_t>(movement.kind);
  message.name = movement.name;
  message.source = movement.source;
  message.joints = movement.joints;
  message.order = movement.order;
  if (movement.end) {
    const double left = std::max(0.0, std::chrono::duration<double>(*movement.end - steady_now).count());
    const double end = now.toSec() + left;
    // ros::Time would throw if the sum were too large.
    message.end = end < ros::TIME_MAX.toSec() ? ros::Time(end) : ros::TIME_MAX;
  }
  return message;
}

}  // namespace

std::uint8_t endConstant(aibo_client::EndedHow how) {
  return static_cast<std::uint8_t>(how);
}

MotionState toMessage(const movement::Mover::State& state, movement::SteadyTime steady_now, const ros::Time& now) {
  MotionState message;
  message.header.stamp = now;
  for (const movement::Movement& movement : state.movements) {
    message.movements.push_back(toMessage(movement, steady_now, now));
  }
  const auto most = static_cast<std::ptrdiff_t>(std::min(state.ended.size(), kEndsInMessage));
  for (auto each = state.ended.end() - most; each != state.ended.end(); ++each) {
    EndedMovement ended;
    ended.movement = toMessage(each->movement, steady_now, now);
    ended.how = endConstant(each->how);
    ended.reason = each->reason;
    message.ended.push_back(ended);
  }
  message.text = describe(state);
  return message;
}

std::vector<MotionState> toMessages(const movement::Mover::State& state, std::size_t fresh,
                                    movement::SteadyTime steady_now, const ros::Time& now) {
  std::vector<MotionState> messages;
  for (std::size_t left = fresh; left > kEndsInMessage; left -= kEndsInMessage) {
    movement::Mover::State earlier = state;
    earlier.ended.resize(state.ended.size() - (left - kEndsInMessage));
    messages.push_back(toMessage(earlier, steady_now, now));
  }
  messages.push_back(toMessage(state, steady_now, now));
  return messages;
}

RobotState toMessage(const movement::Mover::State& state) {
  RobotState message;
  message.motors = static_cast<std::uint8_t>(state.robot.motors);
  message.posture = static_cast<std::uint8_t>(state.robot.posture);
  message.stopped = static_cast<std::uint8_t>(state.stopped_by.has_value());
  message.stopped_by = state.stopped_by.value_or("");
  return message;
}

MotionStatePublisher::MotionStatePublisher(const ros::NodeHandle& handle, const movement::Mover& mover,
                                           StopMemory& stop_memory)
    : mover_(mover), stop_memory_(stop_memory), robot_(handle, "robot_state") {
  constexpr bool kLatched = true;
  publisher_ = ros::NodeHandle(handle).advertise<MotionState>("motion_state", 10, kLatched);
  publisher_.publish(toMessage(mover_.state(), std::chrono::steady_clock::now(), ros::Time::now()));
  robot_.publish(RobotState());
}

void MotionStatePublisher::publish() {
  // The lock is held until the state is published, so that the newest state is published last.
  const std::lock_guard<std::mutex> lock(mutex_);
  const movement::Mover::State state = mover_.state();
  const ros::Time now = ros::Time::now();
  const std::size_t fresh = std::min(state.ends - std::exchange(ends_, state.ends), state.ended.size());
  const bool has_changed = state.movements != std::exchange(movements_, state.movements);
  if (fresh > 0 || has_changed) {
    for (const MotionState& message : toMessages(state, fresh, std::chrono::steady_clock::now(), now)) {
      publisher_.publish(message);
    }
  }
  stop_memory_.remember(state.stopped_by);
  robot_.publish(toMessage(state));
}

}  // namespace aibo_driver::node
