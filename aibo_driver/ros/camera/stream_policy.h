/// @file stream_policy.h
#ifndef AIBO_DRIVER_ROS_CAMERA_STREAM_POLICY_H
#define AIBO_DRIVER_ROS_CAMERA_STREAM_POLICY_H

#include <functional>
#include <mutex>

namespace aibo_driver::node {

/// Decides whether the robot shall stream.
///
/// It shall while the stream is wanted (~stream_on_start, set_streaming, toggle_streaming) and, with
/// ~stream_on_demand, only while a camera topic has a subscriber too. Every function may be called from any thread.
class StreamPolicy {
 public:
  /// @param has_subscriber has a camera topic a subscriber at this moment
  /// @param set_streaming hands each decision on; must not block. Neither may call back into this class
  StreamPolicy(bool wanted, bool on_demand, std::function<bool()> has_subscriber,
               std::function<void(bool)> set_streaming);

  /// Hands the first decision on, and every later one. Before this, decisions are only remembered.
  void start();

  /// Decisions are only remembered again. When it has returned, neither function is running or will be called.
  void stop();

  void setWanted(bool wanted);

  /// Wants what was not wanted before.
  /// @return what is wanted now
  bool toggleWanted();

  /// To be called whenever a subscriber of a camera topic came or went.
  void subscribersChanged();

  bool wanted() const;

  /// True if the stream is wanted and only waits for a subscriber.
  bool waitsForSubscriber() const;

 private:
  bool demanded() const;
  void decide();

  const bool on_demand_;
  const std::function<bool()> has_subscriber_;
  const std::function<void(bool)> set_streaming_;

  mutable std::mutex mutex_;
  bool started_ = false;
  bool wanted_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_CAMERA_STREAM_POLICY_H
