#include "movement/joint_table.h"

#include <gmock/gmock.h>

#include "aibo_client/exceptions.h"

namespace aibo_driver::movement {
namespace {

TEST(JointTable, ScalesTheLowerOfTwoSpeedLimits) {
  JointTable table("ERS-7", 4);
  for (const double scale : {1.0, 0.5}) {
    table.setSpeedScale(scale);
    EXPECT_DOUBLE_EQ(table.speedLimit(*table.findByName("head_pan")), scale * 4);
    EXPECT_NEAR(table.speedLimit(*table.findByName("neck_tilt")), scale * 3.185226, 1e-6);
  }
}

TEST(JointTable, MotionsMayBeAsFastAsTheJointsUnlessTheyAreLimited) {
  const JointTable own("ERS-7", 1);
  JointTable limited("ERS-7", 1, 4);
  limited.setSpeedScale(0.5);
  const std::vector<aibo_client::JointSpeedLimit> free = own.motionSpeedLimits();
  const std::vector<aibo_client::JointSpeedLimit> slow = limited.motionSpeedLimits();
  ASSERT_EQ(free.size(), own.size());
  ASSERT_EQ(slow.size(), own.size());
  for (std::size_t i = 0; i < own.size(); ++i) {
    EXPECT_EQ(free[i].id, own[i].id);
    EXPECT_DOUBLE_EQ(free[i].speed, own[i].own_speed);
    EXPECT_DOUBLE_EQ(slow[i].speed, 0.5 * std::min(4.0, own[i].own_speed));
  }
}

TEST(JointTable, HasOtherRobotsByTheirDesign) {
  EXPECT_TRUE(JointTable("ERS-210", 1).findByName("head_roll"));
  EXPECT_FALSE(JointTable("ERS-7", 1).findByName("head_roll"));
  EXPECT_FALSE(JointTable("ERS-7", 1).findById(99));
  EXPECT_THROW(JointTable("ERS-8", 1), aibo_client::InvalidArgumentException);
}

}  // namespace
}  // namespace aibo_driver::movement
