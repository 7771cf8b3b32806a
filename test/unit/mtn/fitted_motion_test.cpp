#include "mtn/fitted_motion.h"

#include <gmock/gmock.h>

#include <cmath>

#include "motion_tool/motion_tool.h"

namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StrEq;

int microradians(double degrees) {
  return static_cast<int>(std::lround(degrees * std::acos(-1.0) / 180e-6));
}

class FittedMotionOfAnErs7 : public ::testing::Test {
 protected:
  FittedMotionOfAnErs7() {
    for (int i = 0; i < robot_.number_of_joints; ++i) {
      speed_limits_.push_back(robot_.joints[i].highest_speed);
    }
  }

  /// Fits a motion in text form to an ERS-7.
  bool fit(const std::string& key_frames, bool leave_out = false, const std::string& robot = "ERS-7") {
    std::istringstream text("robot " + robot + "\n" + key_frames);
    bytes_ = motion_tool::encodeMtn(motion_tool::parseTextForm(text));
    EXPECT_TRUE(motion_.read(reinterpret_cast<const unsigned char*>(bytes_.data()), bytes_.size()))
        << motion_.problem();
    return fitted_.fit(motion_, robot_, leave_out);
  }

  std::vector<int> posture(int key_frame) const {
    std::vector<int> positions(static_cast<std::size_t>(fitted_.numberOfJoints()) + 2, INT_MIN);
    fitted_.posture(key_frame, &positions[1]);
    EXPECT_EQ(positions.front(), INT_MIN) << "only the motion's joints are written";
    EXPECT_EQ(positions.back(), INT_MIN);
    return {positions.begin() + 1, positions.end() - 1};
  }

  std::string description() const {
    char text[mtn::FittedMotion::MAX_DESCRIPTION_SIZE];
    fitted_.describe(speed_limits_.data(), text);
    return text;
  }

  const robot_model::RobotModel& robot_ = *robot_model::findRobotModel("ERS-7");
  std::vector<int> speed_limits_;
  std::string bytes_;
  mtn::Motion motion_;
  mtn::FittedMotion fitted_;
};

TEST_F(FittedMotionOfAnErs7, IsUnchangedIfTheRobotCanDoAllOfIt) {
  ASSERT_TRUE(fit("at 0 head_pan 0 tail_pan 45\nat 1600 head_pan -88\n"));
  EXPECT_THAT(posture(1), ElementsAre(microradians(-88), microradians(45)));
  EXPECT_EQ(fitted_.milliseconds(1, speed_limits_.data()), 1600);
  EXPECT_EQ(description(), "");
}

TEST_F(FittedMotionOfAnErs7, PositionsAtALimitToAThousandthOfADegreeAreInIt) {
  ASSERT_TRUE(fit("at 0 head_pan 88.0009 neck_tilt -60 head_tilt 4.9991\nat 1600\n"));
  EXPECT_EQ(fitted_.changes().clipped, 0);
  EXPECT_EQ(description(), "");
  EXPECT_THAT(posture(0), ElementsAre(microradians(88), microradians(-60), microradians(5))) << "to the last digit";
  ASSERT_TRUE(fit("at 0 head_pan 88.0011\n"));
  EXPECT_EQ(fitted_.changes().clipped, 1);
}

TEST_F(FittedMotionOfAnErs7, PositionsBeyondALimitByAFewDegreesAreClippedAndDescribedInOneLine) {
  ASSERT_TRUE(fit("at 0 left_front_knee 122 head_pan 0\nat 1600 left_front_knee 125 head_pan 89\nat 3200\n"));
  EXPECT_THAT(posture(1), ElementsAre(microradians(122), microradians(88)));
  EXPECT_EQ(description(), "4 positions are clipped, by up to 3.0 degrees (left_front_knee at 1600 ms)");
  ASSERT_TRUE(fit("at 0 head_pan 90.04\n"));
  EXPECT_EQ(description(), "1 position is clipped, by up to 2.0 degrees (head_pan at 0 ms)");
}

TEST_F(FittedMotionOfAnErs7, JointsInEachOthersWayAreClipped) {
  // Model Information ERS-7, 2.1.2: with the rotator at -22 degrees, the elevator is not below -7.
  ASSERT_TRUE(fit("at 0 right_front_rotator -22 right_front_elevator -9.5\n"));
  EXPECT_THAT(posture(0), ElementsAre(microradians(-22), microradians(-7)));
  EXPECT_EQ(description(), "1 position is clipped, by up to 2.5 degrees (right_front_elevator at 0 ms)");
}

TEST_F(FittedMotionOfAnErs7, JointsThatAreNotInTheMotionAreOutOfTheWay) {
  ASSERT_TRUE(fit("at 0 head_tilt -15\n"));
  EXPECT_EQ(fitted_.changes().clipped, 0);
  EXPECT_THAT(posture(0), ElementsAre(microradians(-15)));
  ASSERT_TRUE(fit("at 0 neck_tilt -60\n"));
  EXPECT_THAT(posture(0), ElementsAre(microradians(-60)));
}

TEST_F(FittedMotionOfAnErs7, PositionsFurtherOffAreRefusedWithTheWorst) {
  EXPECT_TRUE(fit("at 0 head_pan 93\n"));
  EXPECT_FALSE(fit("at 0 tail_pan 52 head_pan 0\nat 1600 head_pan 93.1\nat 3200 head_pan -110\nat 4800\n"));
  EXPECT_THAT(fitted_.problem(), StrEq("moves head_pan to -110.0 degrees at 3200 ms, 22.0 beyond what it can do there; "
                                       "up to 5.0 are clipped"));
  EXPECT_EQ(fitted_.numberOfJoints(), 0);
  EXPECT_EQ(fitted_.numberOfKeyFrames(), 0);
  EXPECT_FALSE(fit("at 0 left_ear 0 head_pan -110\n"));
  EXPECT_THAT(fitted_.problem(), HasSubstr("moves head_pan to -110.0 degrees")) << "behind what is not a joint";
  EXPECT_FALSE(fit("at 0 neck_tilt -60 head_tilt -1\n"));
  EXPECT_THAT(fitted_.problem(), HasSubstr("moves head_tilt to -1.0 degrees at 0 ms, 6.0 beyond"));
}

TEST_F(FittedMotionOfAnErs7, AStepThatIsTooFastTakesLongerAndTheOthersDoNot) {
  // A knee moves at 5.279621 rad/s, 302.5 degrees a second, at most: 30 degrees take 99.2 ms.
  ASSERT_TRUE(
      fit("at 0 left_front_knee 0 head_pan 0\nat 16 left_front_knee 30 head_pan 2\nat 176 left_front_knee 60\n"
          "at 192 head_pan 4\n"));
  EXPECT_EQ(fitted_.milliseconds(1, speed_limits_.data()), 100);
  EXPECT_EQ(fitted_.milliseconds(2, speed_limits_.data()), 160);
  EXPECT_EQ(fitted_.milliseconds(3, speed_limits_.data()), 16);
  EXPECT_EQ(description(), "1 step is too fast, so it takes 0.28 s, which is 0.08 s longer");
}

TEST_F(FittedMotionOfAnErs7, TheSpeedLimitsInForceDecide) {
  ASSERT_TRUE(fit("at 0 head_pan 0\nat 800 head_pan 80\nat 1600 head_pan 0\n"));
  EXPECT_EQ(description(), "");
  speed_limits_[static_cast<std::size_t>(findJointByName(robot_, "head_pan"))] = microradians(40);
  EXPECT_EQ(fitted_.milliseconds(1, speed_limits_.data()), 2000);
  EXPECT_EQ(description(), "2 steps are too fast, so it takes 4.00 s, which is 2.40 s longer");
}

TEST_F(FittedMotionOfAnErs7, HasTheRobotsEarsApartFromItsJoints) {
  ASSERT_TRUE(
      fit("at 0 head_pan 0 left_ear 0 right_ear 0\nat 160 left_ear 1\nat 320 left_ear 0 right_ear 7\nat 480\n"));
  EXPECT_EQ(fitted_.numberOfJoints(), 1);
  EXPECT_TRUE(fitted_.moves(findJointByName(robot_, "head_pan")));
  EXPECT_FALSE(fitted_.moves(findJointByName(robot_, "mouth")));
  EXPECT_EQ(fitted_.changes().left_out, 0);
  const int left = findEarByName(robot_, "left_ear");
  const int right = findEarByName(robot_, "right_ear");
  EXPECT_TRUE(fitted_.flicks(1, left));
  EXPECT_FALSE(fitted_.flicks(1, right));
  EXPECT_TRUE(fitted_.flicks(2, left));
  EXPECT_TRUE(fitted_.flicks(2, right));
  EXPECT_FALSE(fitted_.flicks(3, left));
  EXPECT_FALSE(fitted_.flicks(3, right));
}

TEST_F(FittedMotionOfAnErs7, JointsThatTheRobotDoesNotHaveAreRefusedUnlessTheyAreLeftOut) {
  const std::string text =
      "at 0 head_pan 0 PRM:/r9/c1-Joint2:91 0 PRM:/r9/c2-Joint2:92 300 tail_pan 0\n"
      "at 1600 PRM:/r9/c1-Joint2:91 90 tail_pan 20\n";
  EXPECT_FALSE(fit(text));
  EXPECT_THAT(fitted_.problem(), StrEq("moves the joint PRM:/r9/c1-Joint2:91, which this robot does not have"));
  ASSERT_TRUE(fit(text, true));
  EXPECT_THAT(posture(1), ElementsAre(0, microradians(20)));
  EXPECT_EQ(description(), "2 joints that this robot does not have are left out");
}

TEST_F(FittedMotionOfAnErs7, AMotionOfNoneOfTheRobotsJointsIsRefusedInAnyCase) {
  EXPECT_FALSE(fit("at 0 head_roll 0 tail_tilt 1\n", true, "ERS-210"));
  EXPECT_THAT(fitted_.problem(), StrEq("moves no joint that this robot has"));
}

}  // namespace
