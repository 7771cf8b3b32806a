/// @file stream_policy.h
#ifndef AIBO_DRIVER_NODE_CAMERA_STREAM_POLICY_H
#define AIBO_DRIVER_NODE_CAMERA_STREAM_POLICY_H

#include <functional>
#include <mutex>

namespace aibo_driver::node {

/// Decides whether the robot streams.
///
/// The robot streams while the stream is wanted (~stream_on_start, set_streaming, toggle_streaming). With
/// ~stream_on_demand, a camera topic must have a subscriber, too. Any thread may call any function.
class StreamPolicy {
 public:
  StreamPolicy(bool wanted, bool on_demand) : on_demand_(on_demand), wanted_(wanted) {}

  /// Passes on the present decision and every later one. Before this call, decisions are only remembered.
  /// @param has_subscriber returns whether a camera topic has a subscriber at this moment
  /// @param set_streaming called with each decision; must not block. Neither function may call back into this class
  void start(std::function<bool()> has_subscriber, std::function<void(bool)> set_streaming);

  /// Only remembers decisions from now on. After it returns, neither function is running or will be called.
  void stop();

  void setWanted(bool wanted);

  /// @return whether the stream is wanted now
  bool toggleWanted();

  /// Call this whenever a subscriber of a camera topic comes or goes.
  void subscribersChanged();

  bool wanted() const;

  /// True if the stream is wanted but has no subscriber yet.
  bool waitsForSubscriber() const;

 private:
  bool demanded() const;
  void decide();

  const bool on_demand_;

  mutable std::mutex mutex_;
  bool wanted_;
  std::function<bool()> has_subscriber_;
  std::function<void(bool)> set_streaming_;  ///< empty unless start() was called
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_CAMERA_STREAM_POLICY_H
