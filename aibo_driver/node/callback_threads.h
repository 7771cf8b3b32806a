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
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace aibo_driver::node {

/// Knows when messages and calls came. If a process stalls, it reads the messages that have come meanwhile only
/// afterwards. Such a message may have come right after the last sign of life, so we assume that it did. The signs are
/// those of roscpp's thread, which reads all messages: on a busy computer, another thread may wake much earlier. Any
/// thread may call any function.
class ReceiptClock {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;

  /// The greatest gap between two signs of life without a stall. It is five times what roscpp's thread sleeps at most
  /// (ros::PollManager), because a busy computer lets that thread wait, too.
  static constexpr std::chrono::milliseconds kLongestGap{500};
  /// The time after a longer gap within which all that has waited is read.
  static constexpr std::chrono::milliseconds kCatchingUp{200};

  ReceiptClock();
  ~ReceiptClock();
  ReceiptClock(const ReceiptClock&) = delete;
  ReceiptClock& operator=(const ReceiptClock&) = delete;

  /// Notes a sign of life. After the first one, the next is expected within kLongestGap.
  /// @param now the time of the steady clock
  void alive(TimePoint now);

  /// The time when something that is read now came, or the earliest possible time if that is not known. Before the
  /// first sign of life, the result is `now`.
  /// @param now the time of the steady clock
  TimePoint receipt(TimePoint now);

 private:
  void noteLife(TimePoint now);

  std::mutex mutex_;
  std::optional<TimePoint> last_;  ///< the last sign of life
  TimePoint before_gap_;           ///< the last sign of life before the process stalled
  TimePoint caught_up_;            ///< messages that are read before this time may be old
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

/// A timer that does not run yet. It calls `work` on the handle's callback queue, once or every `period`.
ros::SteadyTimer makeTimer(ros::NodeHandle handle, std::chrono::duration<double> period, bool is_one_shot,
                           const std::function<void()>& work);

/// Lets a timer run for its whole period from now on. A timer that has run out does not start unless it is stopped.
void restart(ros::SteadyTimer* timer);

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_CALLBACK_THREADS_H
