// The motions on the memory stick.
#include <gmock/gmock.h>

#include "motion_tool/motion_tool.h"
#include "mtn/motion.h"
#include "support/temporary_folder.h"

namespace {

using test_support::contentOf;

const char* const kMotions[] = {"LIE", "NOD", "WAG", "SIT"};

TEST(ShippedMotions, AreMadeFromTheirSources) {
  for (const std::string name : kMotions) {
    const std::string source = contentOf(MOTION_SOURCES "/" + name + ".txt");
    EXPECT_EQ(contentOf(MOTIONS "/" + name + ".MTN"), motion_tool::encodeMtn(motion_tool::parseTextForm(source)))
        << name << ": make it again: docs/motions.md";
  }
}

TEST(ShippedMotions, CanBeDoneByAnErs7AndEndWhereTheyBegan) {
  for (const std::string name : kMotions) {
    const std::string bytes = contentOf(MOTIONS "/" + name + ".MTN");
    mtn::Motion motion;
    ASSERT_TRUE(motion.read(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size())) << motion.problem();
    EXPECT_EQ(motion_tool::describeChanges(motion, *robot_model::findRobotModel("ERS-7")), "") << name;
    for (int joint = 0; joint < motion.numberOfJoints(); ++joint) {
      EXPECT_EQ(motion.position(motion.numberOfKeyFrames() - 1, joint), motion.position(0, joint)) << name << joint;
    }
  }
}

}  // namespace
