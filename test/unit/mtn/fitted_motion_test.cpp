#include "mtn/fitted_motion.h"

#include <gmock/gmock.h>

#include <cmath>

#include "motion_tool/motion_tool.h"

namespace {

using ::testing::ElementsAre;
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
    bytes_ = motion_tool::encodeMtn(motion_tool::parseTextForm("robot " + robot + "\n" + key_frames));
    EXPECT_TRUE(motion_.read(reinterpret_cast<const unsigned char*>(bytes_.data()), bytes_.size()))
        << motion_.problem();
    return fitted_.fit(motion_, robot_, leave_out);
  }

  std::vector<int> posture(int key_frame) const {
    std::vector<int> positions(static_cast<std::size_t>(fitted_.numberOfJoints()));
    fitted_.posture(key_frame, positions.data());
    return positions;
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

TEST_F(FittedMotionOfAnErs7, PositionsAtALimitToAThousandthOfADegreeAreInIt) {
  ASSERT_TRUE(fit("at 0 head_pan 88.0009 neck_tilt -60 head_tilt 4.9991\nat 1600\n"));
  EXPECT_EQ(description(), "");
  EXPECT_THAT(posture(0), ElementsAre(microradians(88), microradians(-60), microradians(5))) << "to the last digit";
  ASSERT_TRUE(fit("at 0 head_pan 88.0011\n"));
  EXPECT_EQ(description(), "head_pan is clipped by up to 0.0 degrees (at 0 ms)");
}

// A motion of the robot's joints is never refused, however far it goes. The couplings are those of Model Information
// ERS-7, 2.1.2: for example, with a front rotator at -22 degrees, the elevator is not below -7.
TEST_F(FittedMotionOfAnErs7, ClipsWhatItMustAndSaysByHowMuch) {
  const struct {
    const char* motion;
    std::vector<double> end;  // the last posture, in degrees
    const char* description;
  } rows[] = {
      {"at 0 tail_pan 0\nat 800 tail_pan 50\n", {45}, "tail_pan is clipped by up to 5.0 degrees (at 800 ms)"},
      {"at 0 left_ear 0 head_pan -110\n", {-88}, "head_pan is clipped by up to 22.0 degrees (at 0 ms)"},
      {"at 0 tail_pan 300 head_pan 0\nat 1600 tail_pan 0 head_pan 89\n",
       {0, 88},
       "tail_pan is clipped by up to 255.0 degrees (at 0 ms), head_pan by up to 1.0 (at 1600 ms)"},
      {"at 0 mouth 0 head_pan 90 tail_tilt 0 neck_tilt 1 tail_pan 49\n",
       {-3, 88, 5, 0, 45},
       "tail_tilt is clipped by up to 5.0 degrees (at 0 ms), tail_pan by up to 4.0 (at 0 ms), mouth by up to 3.0 (at 0 "
       "ms), and 2 more joints"},
      // Joints in each other's way.
      {"at 0 neck_tilt -40 head_tilt 5\nat 800 head_tilt -10\n",
       {-40, 5},
       "head_tilt is clipped by up to 15.0 degrees (at 800 ms)"},
      {"at 0 right_front_rotator -22 right_front_elevator -9.5\n",
       {-22, -7},
       "right_front_elevator is clipped by up to 2.5 degrees (at 0 ms)"},
      // Joints that get into each other's way between key frames.
      {"at 0 neck_tilt 0 head_tilt -5\nat 1600 neck_tilt -75 head_tilt 5\n",
       {-75, 5},
       "head_tilt is clipped by up to 4.8 degrees (at 832 ms)"},
      {"at 0 head_tilt 5 neck_tilt -75\nat 1600 head_tilt -5 neck_tilt 0\n",
       {-5, 0},
       "head_tilt is clipped by up to 4.8 degrees (at 768 ms)"},
      {"at 0 mouth -3 head_tilt -5\nat 480 mouth -55 head_tilt 5\n",
       {-55, 5},
       "head_tilt is clipped by up to 4.8 degrees (at 249 ms)"},
      // Joints that are not in the motion are out of the way.
      {"at 0 head_tilt -15\n", {-15}, ""},
      {"at 0 neck_tilt -60 head_tilt 5\nat 800 neck_tilt -40\n", {-40, 5}, ""},
  };
  for (const auto& row : rows) {
    ASSERT_TRUE(fit(row.motion)) << row.motion << fitted_.problem();
    EXPECT_EQ(description(), row.description) << row.motion;
    std::vector<int> end;
    std::transform(row.end.begin(), row.end.end(), std::back_inserter(end), microradians);
    EXPECT_EQ(posture(fitted_.numberOfKeyFrames() - 1), end) << row.motion;
  }
}

TEST_F(FittedMotionOfAnErs7, AStepThatIsTooFastTakesLongerAndTheOthersDoNot) {
  // A knee moves at 5.279621 rad/s, 302.5 degrees a second, at most: 30 degrees take 99.2 ms.
  ASSERT_TRUE(
      fit("at 0 left_front_knee 0 head_pan 0\nat 16 left_front_knee 30 head_pan 2\nat 176 left_front_knee 60\n"
          "at 192 head_pan 4\n"));
  EXPECT_EQ(fitted_.milliseconds(1, speed_limits_.data()), 100);
  EXPECT_EQ(fitted_.milliseconds(2, speed_limits_.data()), 160);
  EXPECT_EQ(fitted_.milliseconds(3, speed_limits_.data()), 16);
  EXPECT_EQ(description(), "1 step is too fast (left_front_knee at 16 ms), so it takes 0.28 s, which is 0.08 s longer");
}

TEST_F(FittedMotionOfAnErs7, EverythingIsSaidInOneLine) {
  ASSERT_TRUE(fit("at 0 left_front_knee 0 tail_pan 50\nat 16 left_front_knee 30\n"));
  EXPECT_EQ(description(),
            "tail_pan is clipped by up to 5.0 degrees (at 0 ms); 1 step is too fast (left_front_knee at 16 ms), so it "
            "takes 0.10 s, which is 0.08 s longer");
}

TEST_F(FittedMotionOfAnErs7, TheSpeedLimitsInForceDecide) {
  ASSERT_TRUE(fit("at 0 head_pan 0\nat 800 head_pan 80\nat 1600 head_pan 0\n"));
  EXPECT_EQ(description(), "");
  speed_limits_[static_cast<std::size_t>(findJointByName(robot_, "head_pan"))] = microradians(40);
  EXPECT_EQ(fitted_.milliseconds(1, speed_limits_.data()), 2000);
  EXPECT_EQ(description(),
            "2 steps are too fast (most of all head_pan at 800 ms), so it takes 4.00 s, which is 2.40 s longer");
}

TEST_F(FittedMotionOfAnErs7, JointsThatTheRobotDoesNotHaveAreRefusedUnlessTheyAreLeftOut) {
  const char* const kNone = "moves no joint that this robot has";
  const struct {
    const char* robot;
    const char* motion;
    const char* problem;
    const char* description;  // if they are left out; null if it is refused even so
  } rows[] = {
      {"ERS-7", "at 0 head_pan 0 PRM:/r9/c1-Joint2:91 0 PRM:/r9/c2-Joint2:92 300\nat 1600 PRM:/r9/c1-Joint2:91 90\n",
       "moves the joint PRM:/r9/c1-Joint2:91, which this robot does not have",
       "2 joints that this robot does not have are left out"},
      {"ERS-210", "at 0 head_roll 0 tail_tilt 1\n",
       "moves the joint PRM:/r1/c1/c2/c3-Joint2:j3, which this robot does not have", nullptr},
      {"ERS-210", "at 0 left_ear 0\n", "moves the joint PRM:/r1/c1/c2/c3/e1-Joint3:j5, which this robot does not have",
       nullptr},
  };
  for (const auto& row : rows) {
    EXPECT_FALSE(fit(row.motion, false, row.robot)) << row.motion;
    EXPECT_THAT(fitted_.problem(), StrEq(row.problem));
    EXPECT_EQ(fitted_.numberOfJoints(), 0);
    EXPECT_EQ(fitted_.numberOfKeyFrames(), 0);
    EXPECT_EQ(fit(row.motion, true, row.robot), row.description != nullptr) << row.motion;
    EXPECT_THAT(fitted_.problem(), StrEq(row.description == nullptr ? kNone : ""));
    EXPECT_EQ(row.description == nullptr ? "" : description(), row.description == nullptr ? "" : row.description);
  }
}

}  // namespace
