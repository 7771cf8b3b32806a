/// @file stream_policy.h
#ifndef AIBO_DRIVER_ROS_CAMERA_STREAM_POLICY_H
#define AIBO_DRIVER_ROS_CAMERA_STREAM_POLICY_H

#include <functional>
#include <mutex>

namespace aibo_driver::node {

/// Decides whether the robot streams.
///
/// It streams while the stream is wanted (~stream_on_start, set_streaming, toggle_streaming) and, with
/// ~stream_on_demand, only while a camera topic has a subscriber too. Every function may be called from any thread.
class StreamPolicy {
 public:
  StreamPolicy(bool wanted, bool on_demand) : on_demand_(on_demand), wanted_(wanted) {}

  /// Hands on the first decision, and every later one. Before this, decisions are only remembered.
  /// @param has_subscriber whether a camera topic has a subscriber at this moment
  /// @param set_streaming takes each decision; must not block. Neither may call back into this class
  void start(std::function<bool()> has_subscriber, std::function<void(bool)> set_streaming);

  /// From now on decisions are only remembered. When it has returned, neither function is running or will be called.
  void stop();

  void setWanted(bool wanted);

  /// @return whether the stream is wanted now
  bool toggleWanted();

  /// To be called whenever a subscriber of a camera topic comes or goes.
  void subscribersChanged();

  bool wanted() const;

  /// True if the stream is wanted and waits only for a subscriber.
  bool waitsForSubscriber() const;

 private:
  bool demanded() const;
  void decide();

  const bool on_demand_;

  mutable std::mutex mutex_;
  bool wanted_;
  std::function<bool()> has_subscriber_;
  std::function<void(bool)> set_streaming_;  ///< empty unless started
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_CAMERA_STREAM_POLICY_H
