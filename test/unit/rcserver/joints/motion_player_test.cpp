#include "rcserver/joints/MotionPlayer.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "motion_bytes.h"

namespace {

using protocol::version2::END_DONE;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StrEq;

constexpr int kFrame = robot_model::FRAME_MILLISECONDS;

// Longer than any motion here.
constexpr int kPatience = 100000;

// The greatest lag of a joint.
constexpr int kLag = 50;  // ms

double degrees(int microradians) {
  return microradians * 180e-6 / std::acos(-1.0);
}

class AMotion : public ::testing::Test {
 protected:
  int joint(const std::string& name) const { return findJointByName(robot_, name.c_str()); }
  double at(const std::string& name) const { return degrees(planner_.Position(joint(name))); }

  // The problem from Play(); empty if the motion is played.
  std::string play(const std::string& name, const std::string& bytes, int repetitions = 1) {
    unsigned char* const room = player_->FindRoom();
    if (room == nullptr) {
      return "no room";
    }
    std::memcpy(room, bytes.data(), bytes.size());
    protocol::MotionName motion_name;
    EXPECT_EQ(protocol::readMotionName(name.data(), name.size(), motion_name), nullptr);
    const bool commanded[robot_model::MAX_JOINTS] = {};
    const char* problem = player_->Play(motion_name, bytes.size(), repetitions, false, commanded, 1);
    return problem != nullptr ? problem : "";
  }

  void passFrame() {
    player_->NextFrame();
    planner_.NextFrame();
  }

  // The position of a joint at the end of each frame until no motion is played any more.
  std::vector<double> pathOf(const std::string& name) {
    std::vector<double> path;
    while (player_->IsPlaying() && path.size() < kPatience) {
      passFrame();
      path.push_back(at(name));
    }
    EXPECT_LT(path.size(), kPatience) << "the motion does not end";
    return path;
  }

  // The times in milliseconds at which an ear flicks until no motion is played any more.
  std::vector<int> flicksOf(const std::string& ear) {
    std::vector<int> times;
    for (int time = 0; player_->IsPlaying() && time < kPatience; time += kFrame) {
      passFrame();
      if (player_->TakeFlick(findEarByName(robot_, ear.c_str()))) {
        times.push_back(time);
      }
    }
    return times;
  }

  const robot_model::RobotModel& robot_ = *robot_model::findRobotModel("ERS-7");
  JointPlanner planner_{robot_};
  OrderBook orders_;
  std::unique_ptr<MotionPlayer> player_ = std::make_unique<MotionPlayer>(planner_, robot_, orders_);
};

double greatestStep(const std::vector<double>& path) {
  double greatest = 0;
  for (size_t i = 1; i < path.size(); ++i) {
    greatest = std::max(greatest, std::abs(path[i] - path[i - 1]));
  }
  return greatest;
}

// The smallest distance of a path, with one position per frame, from a position at that time or within kLag after it.
double distance(const std::vector<double>& path, int milliseconds, double position) {
  double nearest = 1e9;
  for (int time = milliseconds; time <= milliseconds + kLag + kFrame; time += kFrame) {
    const size_t frame = std::min(static_cast<size_t>(time / kFrame), path.size() - 1);
    nearest = std::min(nearest, std::abs(path[frame] - position));
  }
  return nearest;
}

TEST_F(AMotion, FollowsTheLineBetweenKeyFramesAndEndsAtTheLast) {
  ASSERT_EQ(play("A.MTN", motionBytes("at 0 tail_pan 0 head_pan 0\nat 800 head_pan 40\nat 1600 head_pan 10\n")), "");
  const std::vector<double> path = pathOf("head_pan");
  for (int time = kFrame; time <= 1600; time += kFrame) {
    const double line = time < 800 ? time * 40.0 / 800 : 40 - (time - 800) * 30.0 / 800;
    EXPECT_LT(distance(path, time - kFrame, line), 0.5) << time << " ms";
  }
  EXPECT_NEAR(at("head_pan"), 10, 1e-4);
  EXPECT_LT(path.size(), 215U) << "it ends soon after its last key frame";
}

TEST_F(AMotion, BeginsWhereTheJointsAreWithoutAJump) {
  planner_.SetPosition(joint("head_pan"), -1000000);
  ASSERT_EQ(play("A.MTN", motionBytes("at 0 head_pan 50 tail_pan 1\nat 80 head_pan 50\n")), "");
  const std::vector<double> path = pathOf("head_pan");
  EXPECT_NEAR(path.front(), degrees(-1000000), 0.5);
  // Somewhat faster than on average, as it speeds up and brakes.
  EXPECT_LT(greatestStep(path), 1.1 * degrees(PlayedMotion::APPROACH_SPEED) * kFrame / 1000);
  EXPECT_NEAR(at("head_pan"), 50, 1e-4);
}

TEST_F(AMotion, ThatEndsElsewhereReturnsToItsBeginningSlowly) {
  ASSERT_EQ(play("A.MTN", motionBytes("at 0 tail_pan 5 head_pan -40\nat 1600 head_pan 40\n"), 2), "");
  const std::vector<double> path = pathOf("head_pan");
  int passes = 0;  // upwards through zero
  for (size_t i = 1; i < path.size(); ++i) {
    passes += path[i - 1] < 0 && path[i] >= 0 ? 1 : 0;
  }
  EXPECT_EQ(passes, 2);
  EXPECT_LT(greatestStep(path), 1.1 * degrees(PlayedMotion::APPROACH_SPEED) * kFrame / 1000);
}

// A knee moves 302.5 degrees a second at most.
TEST_F(AMotion, TakesLongerIfAStepIsTooFast) {
  ASSERT_EQ(play("A.MTN", motionBytes("at 0 left_front_knee 0 head_pan 0\n"
                                      "at 160 left_front_knee 100 head_pan 10\n"
                                      "at 960 left_front_knee 100 head_pan 60\n")),
            "");
  const std::vector<double> path = pathOf("head_pan");
  EXPECT_LT(distance(path, 331 / kFrame * kFrame, 10), 0.5) << "the other joints wait for it";
  EXPECT_LT(distance(path, 731 / kFrame * kFrame, 35), 0.5);
  EXPECT_NEAR(static_cast<double>(path.size()) * kFrame, 1131, 80);
}

TEST_F(AMotion, IsRefusedWhileAnotherMovesItsJoint) {
  const std::string head = motionBytes("at 0 tail_pan 0 left_ear 0 head_pan 0\nat 1600 head_pan 40\n");
  ASSERT_EQ(play("A.MTN", head), "");
  EXPECT_THAT(play("B.MTN", motionBytes("at 0 mouth -10 head_pan 5\n")),
              StrEq("A.MTN is being played and moves head_pan, too; stop it first"));
  EXPECT_THAT(play("A.MTN", head), HasSubstr("A.MTN is being played"));
  EXPECT_EQ(play("C.MTN", motionBytes("at 0 mouth -10 left_ear 0\n")), "") << "an ear may be in several";
  pathOf("head_pan");
  EXPECT_EQ(play("B.MTN", motionBytes("at 0 head_pan 5\n")), "") << "it is over now";
}

TEST_F(AMotion, IsOneOfFourAtOnceAtMost) {
  const char* const joints[MotionPlayer::MAX_PLAYING] = {"head_pan", "tail_pan", "left_front_knee", "tail_tilt"};
  for (const std::string name : joints) {
    ASSERT_EQ(play("A.MTN", motionBytes("at 0 " + name + " 10\nat 800 " + name + " 20\n"), 1000), "");
  }
  EXPECT_EQ(player_->FindRoom(), nullptr);
  for (int i = 0; i < 3; ++i) {
    passFrame();
  }
  player_->EndRepetitions();
  EXPECT_LT(pathOf("head_pan").size(), 300U);
  EXPECT_NEAR(at("head_pan"), 20, 1e-4) << "at the end of its repetition";
  EXPECT_NE(player_->FindRoom(), nullptr);
}

TEST_F(AMotion, FlicksAnEarWhenItsValueChanges) {
  const std::string motion = motionBytes(
      "at 0 left_ear 0 right_ear 0\nat 400 left_ear 1\nat 800 right_ear 5\nat 1200 left_ear 0\nat 1600 left_ear 0\n");
  ASSERT_EQ(play("A.MTN", motion), "");
  EXPECT_THAT(player_->Changes(), StrEq(""));
  EXPECT_THAT(flicksOf("left_ear"), ElementsAre(400 - kFrame, 1200 - kFrame));
  EXPECT_TRUE(player_->TakeFlick(findEarByName(robot_, "right_ear"))) << "nobody has taken it yet";
  EXPECT_FALSE(player_->TakeFlick(findEarByName(robot_, "right_ear")));
}

}  // namespace
