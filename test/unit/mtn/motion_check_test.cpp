#include "motion_tool/motion_tool.h"

#include <gmock/gmock.h>

#include <sstream>
#include <string>
#include <vector>

namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// What a function of motion_tool.h says of a motion of an ERS-7 on this robot.
template <typename Result>
Result verdict(Result (*function)(const mtn::Motion&, const robot_model::RobotModel&), const std::string& key_frames,
               const std::string& on) {
  std::istringstream text("robot ERS-7\n" + key_frames);
  std::string bytes = motion_tool::encodeMtn(motion_tool::parseTextForm(text));
  mtn::Motion motion;
  EXPECT_TRUE(motion.read(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size())) << motion.problem();
  // The body's yaw, before the positions of the last key frame, is no joint's.
  bytes[bytes.size() - static_cast<std::size_t>(motion.numberOfJoints()) * mtn::VALUE_SIZE - 1] = '\xff';
  return function(motion, *robot_model::findRobotModel(on.c_str()));
}

std::vector<std::string> obstaclesOf(const std::string& key_frames, const std::string& on = "ERS-7") {
  return verdict(motion_tool::findObstacles, key_frames, on);
}

std::string changesOf(const std::string& key_frames, const std::string& on = "ERS-7") {
  return verdict(motion_tool::describeChanges, key_frames, on);
}

TEST(MotionCheckTest, findsNothingInAMotionWithinAllLimits) {
  EXPECT_THAT(obstaclesOf("at 0 neck_tilt -60 head_tilt 5\nat 1600 neck_tilt 0 head_tilt -5\n"), IsEmpty());
}

TEST(MotionCheckTest, findsAJointBeyondItsLimits) {
  EXPECT_THAT(obstaclesOf("at 0 tail_pan 0 head_pan 0\nat 1600 head_pan 88.5\nat 3200 head_pan -88.5\n"),
              ElementsAre(HasSubstr("at 1600 ms, head_pan is at 88.5 degrees, outside -88.0 to 88.0"),
                          HasSubstr("at 3200 ms, head_pan is at -88.5 degrees")));
}

TEST(MotionCheckTest, findsJointsInEachOthersWay) {
  EXPECT_THAT(obstaclesOf("at 0 neck_tilt -60 head_tilt 4\n"),
              ElementsAre(HasSubstr("at 0 ms, head_tilt is below 5.0 degrees, where it hits neck_tilt at -60.0")));
  EXPECT_THAT(obstaclesOf("at 0 mouth -40 head_tilt 4 left_front_rotator -22 left_front_elevator -9.5\n"),
              ElementsAre(HasSubstr("hits left_front_rotator at"), HasSubstr("hits mouth at")));
}

TEST(MotionCheckTest, jointsThatAreNotInTheMotionAreOutOfTheWay) {
  EXPECT_THAT(obstaclesOf("at 0 head_tilt -15\n"), IsEmpty());
  EXPECT_THAT(obstaclesOf("at 0 neck_tilt -60\n"), IsEmpty());
}

TEST(MotionCheckTest, findsAJointThatWouldBeTooFast) {
  EXPECT_THAT(
      obstaclesOf("at 0 tail_pan 0 neck_tilt 0\nat 1600 neck_tilt -10\nat 1760 neck_tilt -50\n"
                  "at 1776 tail_pan 40\nat 3376 tail_pan -40\n"),
      ElementsAre("at 1760 ms, neck_tilt would have moved at 250.0 degrees a second, above its limit of 182.5",
                  "at 1776 ms, tail_pan would have moved at 2500.0 degrees a second, above its limit of 868.8"));
}

TEST(MotionCheckTest, toleratesAThousandthOfADegree) {
  EXPECT_THAT(obstaclesOf("at 0 head_pan 88.0009 neck_tilt -60 head_tilt 4.9991\nat 16 neck_tilt -57.0793\n"),
              IsEmpty());
}

TEST(MotionCheckTest, knowsTheEars) {
  EXPECT_THAT(obstaclesOf("at 0 head_pan 0 left_ear 0 right_ear 0\nat 16 left_ear 1\n"), IsEmpty());
}

TEST(MotionCheckTest, describesAWholeMotionInOneLine) {
  EXPECT_EQ(changesOf("at 0 head_pan 0\nat 1600 head_pan 80\n"), "");
  EXPECT_THAT(changesOf("robot ERS-210\nat 0 head_pan 0\nat 1600 head_pan 91\n", "ERS-210"),
              ::testing::StartsWith("on an ERS-210, 1 position is clipped"));
  EXPECT_THAT(changesOf("at 0 tail_tilt 10\nat 32 tail_tilt 55\n"), HasSubstr("1 step is too fast"));
  EXPECT_EQ(changesOf("at 0 head_pan 0\nat 1600 head_pan 90\nat 3200 head_pan -90\nat 3232 head_pan -60\n"),
            "on an ERS-7, 2 positions are clipped, by up to 2.0 degrees (head_pan at 1600 ms); "
            "1 step is too fast, so it takes 3.25 s, which is 0.02 s longer");
  EXPECT_EQ(changesOf("at 0 head_pan 100\n"),
            "an ERS-7 does not play it: it moves head_pan to 100.0 degrees at 0 ms, 12.0 beyond what it can do there; "
            "up to 5.0 are clipped");
}

TEST(MotionCheckTest, saysThatARobotWithoutOneOfTheJointsDoesNotPlayIt) {
  std::istringstream text("robot ERS-7\nat 0 head_pan 0 mouth -10\n");
  std::string bytes = motion_tool::encodeMtn(motion_tool::parseTextForm(text));
  bytes.replace(bytes.find("-Joint2"), 7, "-Joint9");
  mtn::Motion motion;
  ASSERT_TRUE(motion.read(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size())) << motion.problem();
  EXPECT_THAT(motion_tool::describeChanges(motion, *robot_model::findRobotModel("ERS-7")),
              ::testing::MatchesRegex("an ERS-7 does not play it: it .*-Joint9.*"));
}

TEST(MotionCheckTest, findsJointsThatTheRobotDoesNotHave) {
  EXPECT_THAT(obstaclesOf("at 0 head_pan 0\n", "ERS-210"),
              ElementsAre(HasSubstr("an ERS-210 has no joint PRM:/r1/c1/c2-Joint2:12")));
}

}  // namespace
