/// @file master_watch.h
#ifndef AIBO_DRIVER_NODE_MASTER_WATCH_H
#define AIBO_DRIVER_NODE_MASTER_WATCH_H

#include <future>
#include <string>
#include <thread>

namespace aibo_driver::node {

/// Registers again what the ROS master has forgotten about this process.
///
/// roscpp registers topics and services only once. A restarted roscore knows none of them. A node that had the same
/// names also removes them when it ends. Existing subscribers then go on, but new ones do not find the driver. So every
/// few seconds we ask the master what it knows about this process, and register the topics, services and parameters
/// that are missing. The robot and the subscribers notice nothing. While the master does not answer, nothing is done.
class MasterWatch {
 public:
  /// Begins to watch in a thread of its own. All services of this process must have been advertised before.
  /// @param parameters the name of the node or nodelet; a new master gets its parameters unless it already has some
  explicit MasterWatch(const std::string& parameters);

  /// Ends at once, even if the master does not answer.
  ~MasterWatch();

  MasterWatch(const MasterWatch&) = delete;
  MasterWatch& operator=(const MasterWatch&) = delete;

 private:
  void run(const std::string& parameters);

  std::promise<void> end_;
  std::shared_future<void> ended_{end_.get_future()};
  std::thread thread_;  // last, because it uses all members above
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_MASTER_WATCH_H
