#include "node/callback_threads.h"

#include <ros/console.h>

#include <boost/make_shared.hpp>

#include <exception>
#include <optional>
#include <utility>

namespace aibo_driver::node {
namespace {

using std::chrono::steady_clock;

thread_local std::optional<ReceiptClock::TimePoint> running_since;

/// Wraps another callback, and remembers when it came.
class Received : public ros::CallbackInterface {
 public:
  Received(ros::CallbackInterfacePtr callback, ReceiptClock::TimePoint time)
      : callback_(std::move(callback)), time_(time) {}

  bool ready() override { return callback_->ready(); }

  CallResult call() override {
    running_since = time_;
    CallResult result = Success;
    try {
      result = callback_->call();
    } catch (const std::exception& error) {
      ROS_ERROR_STREAM("A message or a call could not be served: " << error.what());
    }
    running_since.reset();
    return result;
  }

 private:
  const ros::CallbackInterfacePtr callback_;
  const ReceiptClock::TimePoint time_;
};

ros::SteadyTimer createTimer(const ros::NodeHandle& handle, std::chrono::duration<double> period,
                             const std::function<void()>& work, bool is_one_shot) {
  constexpr bool kAutostart = false;
  const auto call = [work](const ros::SteadyTimerEvent&) { work(); };
  return handle.createSteadyTimer(ros::WallDuration(period.count()), call, is_one_shot, kAutostart);
}

}  // namespace

SignsOfLife::SignsOfLife(ReceiptClock& clock)
    : listener_(ros::PollManager::instance()->addPollThreadListener([&clock] { clock.alive(steady_clock::now()); })) {}

SignsOfLife::~SignsOfLife() {
  ros::PollManager::instance()->removePollThreadListener(listener_);
}

ReceiptClock::TimePoint receivedAt() {
  return running_since.value_or(steady_clock::now());
}

void StampedQueue::addCallback(const ros::CallbackInterfacePtr& callback, std::uint64_t owner) {
  const ReceiptClock::TimePoint time = clock_.receipt(steady_clock::now());
  CallbackQueue::addCallback(boost::make_shared<Received>(callback, time), owner);
}

void CallbackThreads::start() {
  for (int i = 0; i < count_; ++i) {
    threads_.emplace_back([this] { run(); });
  }
}

void CallbackThreads::stop() {
  stopping_ = true;
  queue_.disable();  // wakes the threads
  for (std::thread& thread : threads_) {
    thread.join();
  }
  threads_.clear();
}

void CallbackThreads::run() {
  while (!stopping_) {
    queue_.callOne(ros::WallDuration(3600));
  }
}

ros::SteadyTimer makeTimer(ros::NodeHandle handle, std::chrono::duration<double> period,
                           const std::function<void()>& work) {
  return createTimer(handle, period, work, false);
}

ros::SteadyTimer makeOneShotTimer(ros::NodeHandle handle, std::chrono::duration<double> delay,
                                  const std::function<void()>& work) {
  return createTimer(handle, delay, work, true);
}

void restart(ros::SteadyTimer* timer) {
  timer->stop();
  timer->start();
}

}  // namespace aibo_driver::node
