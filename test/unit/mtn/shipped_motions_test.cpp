// The motions on the memory stick.
#include <gmock/gmock.h>

#include <fstream>

#include "motion_tool/motion_tool.h"
#include "mtn/motion.h"

namespace {

const char* const kMotions[] = {"LIE", "NOD", "WAG", "SIT"};

std::string fileOf(const std::string& path) {
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

TEST(ShippedMotions, AreMadeFromTheirSources) {
  for (const std::string name : kMotions) {
    const std::string source = fileOf(MOTION_SOURCES "/" + name + ".txt");
    EXPECT_EQ(fileOf(MOTIONS "/" + name + ".MTN"), motion_tool::encodeMtn(motion_tool::parseTextForm(source)))
        << name << ": make it again: docs/motions.md";
  }
}

TEST(ShippedMotions, CanBeDoneByAnErs7AndEndWhereTheyBegan) {
  for (const std::string name : kMotions) {
    const std::string bytes = fileOf(MOTIONS "/" + name + ".MTN");
    mtn::Motion motion;
    ASSERT_TRUE(motion.read(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size())) << motion.problem();
    EXPECT_EQ(motion_tool::describeChanges(motion, *robot_model::findRobotModel("ERS-7")), "") << name;
    for (int joint = 0; joint < motion.numberOfJoints(); ++joint) {
      EXPECT_EQ(motion.position(motion.numberOfKeyFrames() - 1, joint), motion.position(0, joint)) << name << joint;
    }
  }
}

}  // namespace
