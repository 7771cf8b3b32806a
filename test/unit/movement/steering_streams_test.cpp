#include "movement/steering_streams.h"

#include <gtest/gtest.h>

namespace aibo_driver::movement {
namespace {

class SteeringStreamsTest : public ::testing::Test {
 protected:
  static SteadyTime at(int time) { return SteadyTime(std::chrono::milliseconds(100000 + time)); }

  std::string receive(int time, const std::string& node = "/a") {
    return streams_.receive({node, at(time)}, false, at(time));
  }

  void overrule(int time, const std::string& what) { streams_.overrule(at(time), what); }

  SteeringStreams streams_;
};

TEST_F(SteeringStreamsTest, WhatWaitedWhileTheProcessWasHeldUpIsNoPause) {
  receive(0);
  overrule(50, "stop was called");
  EXPECT_EQ(streams_.receive({"/a", at(100)}, false, at(1100)), "stop was called");
  EXPECT_EQ(receive(1200), "stop was called");
}

TEST_F(SteeringStreamsTest, AStreamCountsIfItBeganLaterThanWhatOverrulesOthers) {
  overrule(50, "stop was called");
  EXPECT_EQ(receive(49, "/early"), "stop was called") << "it waited";
  EXPECT_EQ(receive(60, "/early"), "stop was called");
  EXPECT_EQ(receive(51, "/late"), "");
  EXPECT_TRUE(streams_.goesOn("/late", at(550)));
  EXPECT_FALSE(streams_.goesOn("/late", at(551)));
  EXPECT_FALSE(streams_.goesOn("/b", at(0)));
}

}  // namespace
}  // namespace aibo_driver::movement
