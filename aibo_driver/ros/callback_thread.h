/// @file callback_thread.h
#ifndef AIBO_DRIVER_ROS_CALLBACK_THREAD_H
#define AIBO_DRIVER_ROS_CALLBACK_THREAD_H

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>

namespace aibo_driver::node {

/// A thread with a callback queue of its own: what is subscribed to and advertised with its handle is served one after
/// the other, and waits for nobody else. Nothing is served before start(), or once stop() has returned.
class CallbackThread {
 public:
  /// @param handle whose namespace it is
  explicit CallbackThread(const ros::NodeHandle& handle) : handle_(handle), spinner_(1, &queue_) {
    handle_.setCallbackQueue(&queue_);
  }

  const ros::NodeHandle& handle() const { return handle_; }

  void start() { spinner_.start(); }
  void stop() { spinner_.stop(); }

 private:
  ros::CallbackQueue queue_;
  ros::NodeHandle handle_;
  ros::AsyncSpinner spinner_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_CALLBACK_THREAD_H
