#include "motion_tool/motion_tool.h"

#include <gmock/gmock.h>

#include <sstream>
#include <string>
#include <vector>

namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<std::string> obstaclesOf(const std::string& key_frames, const std::string& on = "ERS-7") {
  std::istringstream text("robot ERS-7\n" + key_frames);
  const std::string bytes = motion_tool::encodeMtn(motion_tool::parseTextForm(text));
  mtn::Motion motion;
  EXPECT_TRUE(motion.read(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size())) << motion.problem();
  return motion_tool::findObstacles(motion, *robot_model::findRobotModel(on.c_str()));
}

TEST(MotionCheckTest, findsNothingInAMotionWithinAllLimits) {
  EXPECT_THAT(obstaclesOf("at 0 neck_tilt -60 head_tilt 5\nat 1600 neck_tilt 0 head_tilt -5\n"), IsEmpty());
}

TEST(MotionCheckTest, findsAJointBeyondItsLimits) {
  EXPECT_THAT(obstaclesOf("at 0 head_pan 0\nat 1600 head_pan 88.5\n"),
              ElementsAre(HasSubstr("at 1600 ms, head_pan is at 88.5 degrees, outside -88.0 to 88.0")));
}

TEST(MotionCheckTest, findsJointsInEachOthersWay) {
  EXPECT_THAT(obstaclesOf("at 0 neck_tilt -60 head_tilt 4\n"),
              ElementsAre(HasSubstr("at 0 ms, head_tilt is below 5.0 degrees, where it hits neck_tilt at -60.0")));
}

TEST(MotionCheckTest, findsAJointThatWouldBeTooFast) {
  EXPECT_THAT(obstaclesOf("at 0 neck_tilt 0\nat 160 neck_tilt -40\n"),
              ElementsAre(HasSubstr("at 160 ms, neck_tilt would have moved at 250.0 degrees a second")));
}

TEST(MotionCheckTest, findsJointsThatTheRobotDoesNotHave) {
  EXPECT_THAT(obstaclesOf("at 0 head_pan 0\n", "ERS-210"),
              ElementsAre(HasSubstr("an ERS-210 has no joint PRM:/r1/c1/c2-Joint2:12")));
}

}  // namespace
