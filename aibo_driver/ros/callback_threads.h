/// @file callback_threads.h
#ifndef AIBO_DRIVER_ROS_CALLBACK_THREADS_H
#define AIBO_DRIVER_ROS_CALLBACK_THREADS_H

#include <ros/callback_queue.h>
#include <ros/node_handle.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

namespace aibo_driver::node {

/// Knows when messages and calls came. A process that was held up reads what waited for it only afterwards; such a
/// message may be as old as the last sign of life before that, and is taken to be.
class ReceiptClock {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;

  /// From one sign of life to the next.
  static constexpr std::chrono::milliseconds kPeriod{200};
  /// After a longer gap, the process was held up.
  static constexpr std::chrono::milliseconds kLongestGap{500};
  /// Then it takes this long at most until everything that waited has been read.
  static constexpr std::chrono::milliseconds kCatchingUp{200};

  ReceiptClock() = default;
  ~ReceiptClock() { stop(); }

  ReceiptClock(const ReceiptClock&) = delete;
  ReceiptClock& operator=(const ReceiptClock&) = delete;

  /// Starts a thread that gives the signs of life.
  void start();
  void stop();

  /// When something that is read now came, or may have come.
  /// @param now by the steady clock
  TimePoint receipt(TimePoint now);

  /// From now on signs of life come. Before this, every receipt is at its own time.
  void expectLife(TimePoint now);

 private:
  void noteLife(TimePoint now);

  std::mutex mutex_;
  std::condition_variable stopping_;
  bool stops_ = false;
  bool life_expected_ = false;
  TimePoint last_;        ///< sign of life
  TimePoint before_gap_;  ///< the last one before the process was held up
  TimePoint caught_up_;   ///< until then, what is read may be that old
  std::thread thread_;
};

/// When the message or call came whose callback runs on this thread; now, if none of a StampedQueue does.
ReceiptClock::TimePoint receivedAt();

/// A callback queue that notes when each callback came. An exception of a callback is logged.
class StampedQueue : public ros::CallbackQueue {
 public:
  /// @param clock must outlive the queue
  explicit StampedQueue(ReceiptClock& clock) : clock_(clock) {}
  void addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t owner) override;

 private:
  ReceiptClock& clock_;
};

/// A callback queue with threads of its own. What is subscribed to and advertised with its handle never waits for the
/// callbacks of another queue, and each of its callbacks knows when it came: see receivedAt().
///
/// The threads sleep until a callback comes. Those of ros::AsyncSpinner wake up ten times a second each, which took
/// half of an idle driver's processor time.
class CallbackThreads {
 public:
  /// @param handle whose namespace handle() gets
  /// @param clock must outlive the queue
  /// @param count with a single thread, callbacks run one after the other
  explicit CallbackThreads(const ros::NodeHandle& handle, ReceiptClock& clock, int count = 1)
      : count_(count), queue_(clock), handle_(handle) {
    handle_.setCallbackQueue(&queue_);
  }
  ~CallbackThreads() { stop(); }

  CallbackThreads(const CallbackThreads&) = delete;
  CallbackThreads& operator=(const CallbackThreads&) = delete;

  const ros::NodeHandle& handle() const { return handle_; }

  /// No callback runs before this.
  void start();

  /// Waits for the callbacks that are running. No callback runs once it has returned.
  void stop();

 private:
  void run();

  const int count_;
  StampedQueue queue_;
  ros::NodeHandle handle_;
  std::atomic<bool> stopping_{false};
  std::vector<std::thread> threads_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_CALLBACK_THREADS_H
