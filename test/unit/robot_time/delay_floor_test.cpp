#include "robot_time/delay_floor.h"

#include <gmock/gmock.h>

namespace aibo_driver::robot_time {
namespace {

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
