#include "movement/trajectory.h"

#include <gtest/gtest.h>

namespace aibo_driver::movement {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kPeriod{32};

class TrajectoryClockTest : public ::testing::Test {
 protected:
  static TrajectoryClock::SteadyTime at(int time) { return TrajectoryClock::SteadyTime(milliseconds(time)); }

  TrajectoryClock clock_{at(5000), kPeriod};
};

TEST_F(TrajectoryClockTest, IsTheTimeSinceTheBeginning) {
  EXPECT_DOUBLE_EQ(clock_.attend(at(4000)), -1);
  EXPECT_DOUBLE_EQ(clock_.attend(at(5010)), 0.01);
  EXPECT_DOUBLE_EQ(clock_.attend(at(5042)), 0.042);
  EXPECT_DOUBLE_EQ(clock_.attend(at(5230)), 0.23) << "a little late: it catches up";
}

TEST_F(TrajectoryClockTest, StandsStillDuringALongGap) {
  clock_.attend(at(5100));
  EXPECT_NEAR(clock_.at(at(7100)), 0.132, 1e-9);
  EXPECT_NEAR(clock_.attend(at(7100)), 0.132, 1e-9);
  EXPECT_NEAR(clock_.attend(at(7132)), 0.164, 1e-9);
}

TEST_F(TrajectoryClockTest, BeginsLaterIfItIsNotAttendedThen) {
  clock_.attend(at(4900));
  EXPECT_NEAR(clock_.attend(at(6000)), 0.032, 1e-9);
}

}  // namespace
}  // namespace aibo_driver::movement
