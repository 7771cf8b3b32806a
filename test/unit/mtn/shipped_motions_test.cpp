// The motions on the memory stick.
#include <gmock/gmock.h>

#include <fstream>
#include <iterator>
#include <string>

#include "motion_tool/motion_tool.h"
#include "mtn/motion.h"

namespace {

using ::testing::IsEmpty;

class ShippedMotions : public ::testing::TestWithParam<const char*> {
 protected:
  std::string file() const {
    std::ifstream stream(MOTIONS "/" + std::string(GetParam()) + ".MTN", std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  }
};

TEST_P(ShippedMotions, IsMadeFromItsSource) {
  std::ifstream source(MOTION_SOURCES "/" + std::string(GetParam()) + ".txt");
  EXPECT_EQ(file(), motion_tool::encodeMtn(motion_tool::parseTextForm(source))) << "make it again: docs/motions.md";
}

TEST_P(ShippedMotions, CanBeDoneByAnErs7) {
  const std::string bytes = file();
  mtn::Motion motion;
  ASSERT_TRUE(motion.read(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size())) << motion.problem();
  EXPECT_THAT(motion_tool::findObstacles(motion, *robot_model::findRobotModel("ERS-7")), IsEmpty());
}

TEST_P(ShippedMotions, EndsWhereItBegan) {
  const std::string bytes = file();
  mtn::Motion motion;
  ASSERT_TRUE(motion.read(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size())) << motion.problem();
  for (int joint = 0; joint < motion.numberOfJoints(); ++joint) {
    EXPECT_EQ(motion.position(motion.numberOfKeyFrames() - 1, joint), motion.position(0, joint)) << joint;
  }
}

INSTANTIATE_TEST_SUITE_P(Motions, ShippedMotions, ::testing::Values("LIE", "NOD", "WAG", "SIT"));

}  // namespace
