#include "ros/body/motion_name.h"

#include <gmock/gmock.h>

namespace aibo_driver::node {
namespace {

TEST(MotionFileName, IsTheSameForAllWaysToWriteAName) {
  EXPECT_EQ(motionFileName("nod"), "NOD.MTN");
  EXPECT_EQ(motionFileName("Nod.mtn"), "NOD.MTN");
  EXPECT_EQ(motionFileName("NOD.MTN"), "NOD.MTN");
  EXPECT_EQ(motionFileName("nod.txt"), "NOD.TXT") << "for the robot to refuse";
  EXPECT_EQ(motionFileName(""), "");
}

}  // namespace
}  // namespace aibo_driver::node
