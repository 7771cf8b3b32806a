/// @file callback_threads.h
#ifndef AIBO_DRIVER_ROS_CALLBACK_THREADS_H
#define AIBO_DRIVER_ROS_CALLBACK_THREADS_H

#include <ros/callback_queue.h>
#include <ros/node_handle.h>

#include <atomic>
#include <thread>
#include <vector>

namespace aibo_driver::node {

/// A callback queue with threads of its own. What is subscribed to and advertised with its handle never waits for the
/// callbacks of another queue.
///
/// The threads sleep until a callback comes. Those of ros::AsyncSpinner wake up ten times a second each, which took
/// half of an idle driver's processor time.
class CallbackThreads {
 public:
  /// @param handle whose namespace handle() gets
  /// @param count with a single thread, callbacks run one after the other
  explicit CallbackThreads(const ros::NodeHandle& handle, int count = 1) : count_(count), handle_(handle) {
    handle_.setCallbackQueue(&queue_);
  }
  ~CallbackThreads() { stop(); }

  CallbackThreads(const CallbackThreads&) = delete;
  CallbackThreads& operator=(const CallbackThreads&) = delete;

  const ros::NodeHandle& handle() const { return handle_; }

  /// No callback runs before this.
  void start() {
    for (int i = 0; i < count_; ++i) {
      threads_.emplace_back([this] { run(); });
    }
  }

  /// Waits for the callbacks that are running. No callback runs once it has returned.
  void stop() {
    stopping_ = true;
    queue_.disable();  // wakes the threads
    for (std::thread& thread : threads_) {
      thread.join();
    }
    threads_.clear();
  }

 private:
  void run() {
    while (!stopping_) {
      queue_.callOne(ros::WallDuration(3600));
    }
  }

  const int count_;
  ros::CallbackQueue queue_;
  ros::NodeHandle handle_;
  std::atomic<bool> stopping_{false};
  std::vector<std::thread> threads_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_CALLBACK_THREADS_H
