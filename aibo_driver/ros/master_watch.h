/// @file master_watch.h
#ifndef AIBO_DRIVER_ROS_MASTER_WATCH_H
#define AIBO_DRIVER_ROS_MASTER_WATCH_H

#include <future>
#include <string>
#include <thread>

namespace aibo_driver::node {

/// Registers what the ROS master has forgotten of this process.
///
/// roscpp registers topics and services only once. A restarted roscore knows none of them, and a node that had the same
/// names takes them with it when it ends: existing subscribers go on, but new ones do not find the driver. So every few
/// seconds the master is asked what it knows of this process. What is missing of topics, services and parameters is
/// registered again. Neither the robot nor the subscribers notice. While the master does not answer, nothing is done.
class MasterWatch {
 public:
  /// Begins to watch, in a thread of its own. By now all services of this process must be advertised.
  /// @param parameters name of the node or nodelet; a new master gets its parameters, unless it already has some
  explicit MasterWatch(const std::string& parameters);

  /// Ends at once, whether the master answers or not.
  ~MasterWatch();

  MasterWatch(const MasterWatch&) = delete;
  MasterWatch& operator=(const MasterWatch&) = delete;

 private:
  void run(const std::string& parameters);

  std::promise<void> end_;
  std::shared_future<void> ended_{end_.get_future()};
  std::thread thread_;  // last: it uses all of the above
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_MASTER_WATCH_H
