/// @file robot_frames.h
#ifndef AIBO_DRIVER_CLIENT_ROBOT_FRAMES_H
#define AIBO_DRIVER_CLIENT_ROBOT_FRAMES_H

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <optional>

#include "protocol/version2.h"
#include "robot_model/robot_model.h"

namespace aibo_client {

/// Knows the robot's present frame, so that the robot can tell which orders are too old. Only messages that came over
/// one TCP connection count: anybody can forge a datagram, and a robot that was restarted counts from 0. A late message
/// makes the frame seem earlier than it is, so an order may be refused too soon, but never carried out too late.
class RobotFrames {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;

  /// The greatest age of a message from which the present frame is computed. Even if the clocks drift by 0.3 %, that is
  /// less than a frame in this time. This and kBetterOnly are our choice.
  static constexpr std::chrono::seconds kLongestAge{2};
  /// Any newer message replaces one of this age. A younger one is replaced only by one that was less late.
  static constexpr std::chrono::seconds kBetterOnly{1};

  /// Call this when a message with a frame number has come.
  void told(std::uint32_t frame, TimePoint now) {
    const std::optional<std::uint32_t> expected = present(now);
    if (!expected || now - time_ > kBetterOnly || static_cast<std::int32_t>(frame - *expected) > 0) {
      frame_ = frame;
      time_ = now;
    }
  }

  /// The robot's present frame. It is empty if no message of the last 2 s has a frame.
  std::optional<std::uint32_t> present(TimePoint now) const {
    if (!frame_ || now - time_ > kLongestAge) {
      return std::nullopt;
    }
    return *frame_ + static_cast<std::uint32_t>((now - time_) / kFrame);
  }

  /// The last frame in which the robot may carry out an order, as the protocol writes it. It is empty if the present
  /// frame is not known.
  std::optional<unsigned> notAfter(TimePoint not_after, TimePoint now) const {
    // Frames are compared by signed differences, so an order cannot be good for more than 2^31 of them.
    constexpr TimePoint::rep kMostFrames = 1 << 30;
    const std::optional<std::uint32_t> frame = present(now);
    if (!frame) {
      return std::nullopt;
    }
    const auto frames = std::min<TimePoint::rep>((std::max(not_after, now) - now) / kFrame, kMostFrames);
    return protocol::version2::notAfter(*frame, static_cast<int>(frames));
  }

 private:
  static constexpr std::chrono::milliseconds kFrame{robot_model::FRAME_MILLISECONDS};

  std::optional<std::uint32_t> frame_;
  TimePoint time_;  // when frame_ came
};

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_ROBOT_FRAMES_H
