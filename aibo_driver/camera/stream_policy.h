/// @file stream_policy.h
#ifndef AIBO_DRIVER_CAMERA_STREAM_POLICY_H
#define AIBO_DRIVER_CAMERA_STREAM_POLICY_H

#include <functional>
#include <utility>

namespace aibo_driver::camera {

/// Decides whether the robot streams.
///
/// The robot streams while the stream is wanted (~stream_on_start, set_streaming, toggle_streaming). With
/// ~stream_on_demand, a camera topic must have a subscriber, too. Only one thread at a time may use it.
class StreamPolicy {
 public:
  /// @param has_subscriber returns whether a camera topic has a subscriber at this moment
  /// @param set_streaming called with each decision; must not block
  StreamPolicy(bool wanted, bool on_demand, std::function<bool()> has_subscriber,
               std::function<void(bool)> set_streaming)
      : wanted_(wanted),
        on_demand_(on_demand),
        has_subscriber_(std::move(has_subscriber)),
        set_streaming_(std::move(set_streaming)) {}

  void setWanted(bool wanted) {
    wanted_ = wanted;
    decide();
  }

  /// Call this at the start, and whenever a subscriber of a camera topic comes or goes.
  void decide() const { set_streaming_(wanted_ && !waitsForSubscriber()); }

  bool wanted() const { return wanted_; }

  /// True if the stream is wanted but has no subscriber yet.
  bool waitsForSubscriber() const { return wanted_ && on_demand_ && !has_subscriber_(); }

 private:
  bool wanted_;
  const bool on_demand_;
  const std::function<bool()> has_subscriber_;
  const std::function<void(bool)> set_streaming_;
};

}  // namespace aibo_driver::camera

#endif  // AIBO_DRIVER_CAMERA_STREAM_POLICY_H
