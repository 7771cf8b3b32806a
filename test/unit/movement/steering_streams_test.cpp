#include "movement/steering_streams.h"

#include <gtest/gtest.h>

namespace aibo_driver::movement {
namespace {

using std::chrono::milliseconds;

class SteeringStreamsTest : public ::testing::Test {
 protected:
  static SteadyTime at(int time) { return SteadyTime(milliseconds(100000 + time)); }

  std::string receive(int time, const std::string& node = "/a", bool is_zero = false) {
    return streams_.receive({node, at(time)}, is_zero);
  }

  SteeringStreams streams_;
};

TEST_F(SteeringStreamsTest, AStreamThatWasOverruledCountsAgainAfterAZero) {
  EXPECT_EQ(receive(0), "");
  streams_.overrule("stop was called");
  EXPECT_EQ(receive(100), "stop was called");
  EXPECT_EQ(receive(200), "stop was called");
  EXPECT_EQ(receive(300, "/a", true), "");
  EXPECT_EQ(receive(400), "");
}

TEST_F(SteeringStreamsTest, AStreamThatWasOverruledCountsAgainAfterAPause) {
  receive(0);
  streams_.overrule("stop was called");
  EXPECT_EQ(receive(499), "stop was called");
  EXPECT_EQ(receive(999), "");
}

TEST_F(SteeringStreamsTest, WhoLetsGoLetsGoForHimselfAlone) {
  receive(0, "/stuck");
  receive(0, "/joystick");
  streams_.overrule("stop was called");
  receive(100, "/joystick", true);
  EXPECT_EQ(receive(100, "/stuck"), "stop was called");
  EXPECT_EQ(receive(200, "/joystick"), "");
  streams_.overrule("/joystick", "again");
  EXPECT_EQ(receive(300, "/joystick"), "again");
  EXPECT_EQ(receive(300, "/stuck"), "stop was called");
  EXPECT_TRUE(streams_.goesOn("/stuck", at(799))) << "though it does not count";
}

TEST_F(SteeringStreamsTest, WhoBeginsLaterWasNotOverruled) {
  streams_.overrule("stop was called");
  EXPECT_EQ(receive(0), "");
  EXPECT_TRUE(streams_.goesOn("/a", at(499)));
  EXPECT_FALSE(streams_.goesOn("/a", at(500)));
  EXPECT_FALSE(streams_.goesOn("/b", at(0)));
}

}  // namespace
}  // namespace aibo_driver::movement
