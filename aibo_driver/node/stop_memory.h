/// @file stop_memory.h
#ifndef AIBO_DRIVER_NODE_STOP_MEMORY_H
#define AIBO_DRIVER_NODE_STOP_MEMORY_H

#include <ros/node_handle.h>

#include <condition_variable>
#include <future>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace aibo_driver::node {

/// Remembers who has stopped the robot, even if the driver crashes. The memory is the parameter `stopped_by` in the
/// driver's namespace, which exists while the robot is stopped. A thread of its own writes it, so that a stop never
/// waits for the ROS master, and writes it again every few seconds for a master that was restarted.
class StopMemory {
 public:
  /// Reads the parameter.
  /// @param handle a handle in the driver's namespace
  explicit StopMemory(const ros::NodeHandle& handle);

  /// Ends the thread. The parameter stays.
  ~StopMemory();

  StopMemory(const StopMemory&) = delete;
  StopMemory& operator=(const StopMemory&) = delete;

  /// The name of the node that had stopped the robot when the last driver ended; no value if nobody had.
  const std::optional<std::string>& left() const { return left_; }

  /// Changes the parameter soon, without waiting for anything. Any thread may call it.
  /// @param stopped_by empty unless the robot is stopped
  void remember(const std::optional<std::string>& stopped_by);

 private:
  void run();
  bool write(const std::optional<std::string>& stopped_by) const;

  const std::string parameter_;
  const std::optional<std::string> left_;
  std::promise<void> end_;
  const std::shared_future<void> ended_{end_.get_future()};
  std::mutex mutex_;
  std::condition_variable changed_;
  bool is_ending_ = false;
  bool has_changed_ = false;
  std::optional<std::string> stopped_by_ = left_;
  std::thread thread_;  // last, because it uses all members above
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_STOP_MEMORY_H
