#include "node/callback_threads.h"

#include <gtest/gtest.h>

#include <boost/make_shared.hpp>

#include <stdexcept>

namespace aibo_driver::node {
namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;
using TimePoint = ReceiptClock::TimePoint;

class Callback : public ros::CallbackInterface {
 public:
  explicit Callback(std::function<void()> work) : work_(std::move(work)) {}
  CallResult call() override {
    work_();
    return Success;
  }

 private:
  const std::function<void()> work_;
};

// Adds callbacks to the queue, and waits for them.
class CallbackThreadsTest : public ::testing::Test {
 protected:
  CallbackThreadsTest() { ros::Time::init(); }

  void add(const std::function<void()>& work) { queue_.addCallback(boost::make_shared<Callback>(work), 0); }

  ReceiptClock clock_;
  StampedQueue queue_{clock_};
};

TEST_F(CallbackThreadsTest, ACallbackKnowsWhenItCame) {
  const TimePoint before = steady_clock::now();
  TimePoint received;
  add([&received] { received = receivedAt(); });
  const TimePoint after = steady_clock::now();
  while (steady_clock::now() < after + milliseconds(10)) {
  }
  queue_.callAvailable();
  EXPECT_GE(received, before);
  EXPECT_LE(received, after);
  EXPECT_GE(receivedAt(), after + milliseconds(10)) << "outside of a callback, it is now";
}

TEST_F(CallbackThreadsTest, AnExceptionOfACallbackDoesNotEndTheProcess) {
  bool next_runs = false;
  add([] { throw std::runtime_error("Time is out of dual 32-bit range"); });
  add([&next_runs] { next_runs = true; });
  queue_.callAvailable();
  EXPECT_TRUE(next_runs);
  add([] { throw std::runtime_error("again"); });
  queue_.callAvailable();
  const TimePoint before = steady_clock::now();
  EXPECT_GE(receivedAt(), before) << "no callback runs any more";
}

TEST(ReceiptClock, WhatIsReadAfterAHoldUpMayBeAsOldAsTheLastSignOfLife) {
  ReceiptClock clock;
  const TimePoint begin = TimePoint() + std::chrono::hours(2);
  EXPECT_EQ(clock.receipt(begin - std::chrono::hours(1)), begin - std::chrono::hours(1)) << "nobody gives signs yet";
  clock.alive(begin);
  EXPECT_EQ(clock.receipt(begin + milliseconds(400)), begin + milliseconds(400));
  const TimePoint woken = begin + milliseconds(6400);
  EXPECT_EQ(clock.receipt(woken), begin + milliseconds(400));
  EXPECT_EQ(clock.receipt(woken + milliseconds(199)), begin + milliseconds(400));
  EXPECT_EQ(clock.receipt(woken + milliseconds(200)), woken + milliseconds(200));
  clock.alive(woken + milliseconds(190));  // another thread was quicker
  EXPECT_EQ(clock.receipt(woken + milliseconds(700)), woken + milliseconds(700)) << "no sign of life is missing";
  EXPECT_EQ(clock.receipt(woken + milliseconds(2000)), woken + milliseconds(700)) << "stalled again";
  EXPECT_EQ(clock.receipt(woken + milliseconds(2199)), woken + milliseconds(700));
  EXPECT_EQ(clock.receipt(woken + milliseconds(2200)), woken + milliseconds(2200));
}

}  // namespace
}  // namespace aibo_driver::node
