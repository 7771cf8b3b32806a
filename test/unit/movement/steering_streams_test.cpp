#include "movement/steering_streams.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

namespace aibo_driver::movement {
namespace {

using std::chrono::milliseconds;

class SteeringStreamsTest : public ::testing::Test {
 protected:
  static SteadyTime at(int time) { return SteadyTime(milliseconds(100000 + time)); }

  std::string receive(int time, const std::string& node = "/a", bool is_zero = false) {
    return streams_.receive({node, at(time)}, is_zero, at(time));
  }

  void overrule(int time, const std::string& what) { streams_.overrule(at(time), what); }

  SteeringStreams streams_;
};

TEST_F(SteeringStreamsTest, AStreamThatWasOverruledCountsAgainAfterAZeroOrAPause) {
  EXPECT_EQ(receive(0), "");
  overrule(50, "stop was called");
  EXPECT_EQ(receive(100), "stop was called");
  EXPECT_EQ(receive(200), "stop was called");
  EXPECT_EQ(receive(300, "/a", true), "");
  EXPECT_EQ(receive(400), "");
  overrule(450, "stop was called");
  EXPECT_EQ(receive(899), "stop was called");
  EXPECT_EQ(receive(1399), "");
}

TEST_F(SteeringStreamsTest, WhatWaitedWhileTheProcessWasHeldUpIsNoPause) {
  receive(0);
  overrule(50, "stop was called");
  EXPECT_EQ(streams_.receive({"/a", at(100)}, false, at(1100)), "stop was called");
  EXPECT_EQ(receive(1200), "stop was called");
}

TEST_F(SteeringStreamsTest, WhoLetsGoLetsGoForHimselfAlone) {
  receive(0, "/stuck");
  receive(0, "/joystick");
  overrule(50, "stop was called");
  receive(100, "/joystick", true);
  EXPECT_EQ(receive(100, "/stuck"), "stop was called");
  EXPECT_EQ(receive(200, "/joystick"), "");
  EXPECT_TRUE(streams_.goesOn("/stuck", at(599))) << "though it does not count";
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

// What comes from other nodes between two velocities of /a, at 0 and 100 ms.
TEST_F(SteeringStreamsTest, WhoseVelocitiesComeBetweenThoseOfAnotherIsItsRival) {
  struct Row {
    const char* what;
    std::function<void()> between;
    std::string rival;
  };
  const std::vector<Row> rows = {
      {"nothing", [] {}, ""},
      {"a zero", [this] { receive(50, "/b", true); }, "/b"},
      {"a velocity", [this] { receive(50, "/b"); }, "/b"},
      {"its own zero after another's",
       [this] {
         receive(50, "/b");
         receive(60, "/a", true);
       },
       ""},
  };
  for (const Row& row : rows) {
    streams_ = {};
    receive(0);
    row.between();
    receive(100);
    EXPECT_EQ(streams_.rivalOf("/a", at(100)), row.rival) << row.what;
    receive(599);
    EXPECT_EQ(streams_.rivalOf("/a", at(599)), row.rival) << row.what;
    EXPECT_EQ(streams_.rivalOf("/a", at(600)), "") << row.what << ": it has stopped";
  }
}

TEST_F(SteeringStreamsTest, WhoseVelocitiesDoNotCountIsNoRival) {
  receive(0, "/b");
  overrule(50, "stop was called");
  receive(100, "/a");
  EXPECT_EQ(receive(150, "/b"), "stop was called");
  receive(200, "/a");
  EXPECT_EQ(streams_.rivalOf("/a", at(200)), "");
}

TEST_F(SteeringStreamsTest, WhoTakesOverIsNoRival) {
  receive(0, "/a");
  receive(100, "/b");
  receive(200, "/b");
  EXPECT_EQ(streams_.rivalOf("/a", at(200)) + streams_.rivalOf("/b", at(200)), "");
}

}  // namespace
}  // namespace aibo_driver::movement
