/// @file callback_threads.h
#ifndef AIBO_DRIVER_NODE_CALLBACK_THREADS_H
#define AIBO_DRIVER_NODE_CALLBACK_THREADS_H

#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/poll_manager.h>
#include <ros/steady_timer.h>

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <thread>
#include <vector>

#include "system/receipt_clock.h"

namespace aibo_driver::node {

using aibo_system::ReceiptClock;

/// Gives a clock the signs of life of roscpp's thread, which reads all messages: on a busy computer, another thread may
/// wake much earlier.
class SignsOfLife {
 public:
  /// @param clock must outlive the object
  explicit SignsOfLife(ReceiptClock& clock);

  /// After this call, roscpp's thread reports no more signs of life.
  ~SignsOfLife();
  SignsOfLife(const SignsOfLife&) = delete;
  SignsOfLife& operator=(const SignsOfLife&) = delete;

 private:
  boost::signals2::connection listener_;
};

/// The time at which the message or call came that this thread handles now. If the thread runs no callback of a
/// StampedQueue, the result is the present time.
ReceiptClock::TimePoint receivedAt();

/// A callback queue that notes when each callback came. It logs exceptions that callbacks throw.
class StampedQueue : public ros::CallbackQueue {
 public:
  /// @param clock must outlive the queue
  explicit StampedQueue(ReceiptClock& clock) : clock_(clock) {}
  void addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t owner) override;

 private:
  ReceiptClock& clock_;
};

/// A callback queue with threads of its own. Topics and services of its handle never wait for the callbacks of another
/// queue. Each callback can ask when it came: see receivedAt().
///
/// The threads sleep until a callback comes. The threads of ros::AsyncSpinner wake up ten times a second each, which
/// took half of an idle driver's processor time.
class CallbackThreads {
 public:
  /// @param handle the handle whose namespace handle() gets
  /// @param clock must outlive the queue
  /// @param count the number of threads; with one thread, callbacks run one after the other
  explicit CallbackThreads(const ros::NodeHandle& handle, ReceiptClock& clock, int count = 1)
      : count_(count), queue_(clock), handle_(handle) {
    handle_.setCallbackQueue(&queue_);
  }
  ~CallbackThreads() { stop(); }

  CallbackThreads(const CallbackThreads&) = delete;
  CallbackThreads& operator=(const CallbackThreads&) = delete;

  const ros::NodeHandle& handle() const { return handle_; }

  /// Starts the threads. No callback runs before this call.
  void start();

  /// Waits for the callbacks that are running. After it returns, no callback runs.
  void stop();

 private:
  void run();

  const int count_;
  StampedQueue queue_;
  ros::NodeHandle handle_;
  std::atomic<bool> stopping_{false};
  std::vector<std::thread> threads_;
};

/// A timer that does not run yet. It calls `work` on the handle's callback queue every `period`.
ros::SteadyTimer makeTimer(ros::NodeHandle handle, std::chrono::duration<double> period,
                           const std::function<void()>& work);

/// The same, but it calls `work` only once.
ros::SteadyTimer makeOneShotTimer(ros::NodeHandle handle, std::chrono::duration<double> delay,
                                  const std::function<void()>& work);

/// Lets a timer run for its whole period from now on. A timer that has run out does not start unless it is stopped.
void restart(ros::SteadyTimer* timer);

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_CALLBACK_THREADS_H
