#include "robot_time/delay_floor.h"

#include <gmock/gmock.h>

namespace aibo_driver::robot_time {
namespace {

TEST(DelayFloor, OfOneMessageIsItsLateness) {
  DelayFloor floor;
  floor.add(10, 0.02);
  EXPECT_DOUBLE_EQ(floor.at(10), 0.02);
  EXPECT_DOUBLE_EQ(floor.at(11), 0.02);
  EXPECT_DOUBLE_EQ(floor.drift(), 0);
}

TEST(DelayFloor, FollowsTheDriftBelowTheDelays) {
  DelayFloor floor;
  for (int i = 0; i < 400; ++i) {
    const double sent = 0.05 * i;
    floor.add(sent, 0.005 + 100e-6 * sent + (i % 10 == 0 ? 0 : 0.03));
  }
  EXPECT_NEAR(floor.drift(), 100e-6, 1e-9);
  EXPECT_NEAR(floor.at(30), 0.005 + 100e-6 * 30, 1e-9);
}

TEST(DelayFloor, DoesNotExceedTheDriftOfRealClocks) {
  DelayFloor floor;
  floor.add(0, 0.050);
  floor.add(1, 0.005);
  EXPECT_DOUBLE_EQ(floor.drift(), -DelayFloor::kHighestDrift);
  EXPECT_DOUBLE_EQ(floor.at(1), 0.005);
}

TEST(DelayFloor, ForgetsMessagesOlderThanItsWindow) {
  DelayFloor floor;
  floor.add(0, 0.005);
  for (double sent = 1; sent < DelayFloor::kWindow; ++sent) {
    floor.add(sent, 0.020);
  }
  EXPECT_LT(floor.at(0), 0.006);
  floor.add(DelayFloor::kWindow + 1, 0.020);
  EXPECT_NEAR(floor.at(DelayFloor::kWindow + 1), 0.020, 1e-9);
}

}  // namespace
}  // namespace aibo_driver::robot_time
