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
using ::testing::AnyOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::StrEq;

constexpr int kFrame = robot_model::FRAME_MILLISECONDS;

// Longer than any motion here.
constexpr int kPatience = 100000;

// The greatest lag of a joint.
constexpr int kLag = 50;  // ms

double degrees(int microradians) {
  return microradians * 180e-6 / std::acos(-1.0);
}

class MotionPlayerTest : public ::testing::Test {
 protected:
  int joint(const std::string& name) const { return findJointByName(robot_, name.c_str()); }
  double at(const std::string& name) const { return degrees(planner_.Position(joint(name))); }

  // The problem from Play(); empty if the motion is played.
  std::string play(const std::string& name, const std::string& bytes, int repetitions = 1, bool leave_out = false,
                   const bool* commanded = nullptr) {
    unsigned char* const room = player_->FindRoom();
    if (room == nullptr) {
      return "no room";
    }
    std::memcpy(room, bytes.data(), bytes.size());
    protocol::MotionName motion_name;
    EXPECT_EQ(protocol::readMotionName(name.data(), name.size(), motion_name), nullptr);
    const char* problem = player_->Play(motion_name, bytes.size(), repetitions, leave_out, commanded);
    return problem != nullptr ? problem : "";
  }

  void stop(const std::string& name) {
    protocol::MotionName motion_name;
    EXPECT_EQ(protocol::readMotionName(name.data(), name.size(), motion_name), nullptr);
    player_->Stop(motion_name);
  }

  void passFrame() {
    player_->NextFrame();
    planner_.NextFrame();
  }

  void passFrames(int count) {
    for (int i = 0; i < count; ++i) {
      passFrame();
    }
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

  const robot_model::RobotModel& robot_ = *robot_model::findRobotModel("ERS-7");
  MotionPlanner planner_{robot_};
  EndLog ends_;
  std::unique_ptr<MotionPlayer> player_ = std::make_unique<MotionPlayer>(planner_, robot_, ends_);
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

// How often a path goes up through zero.
int countPasses(const std::vector<double>& path) {
  int passes = 0;
  for (size_t i = 1; i < path.size(); ++i) {
    passes += path[i - 1] < 0 && path[i] >= 0 ? 1 : 0;
  }
  return passes;
}

TEST_F(MotionPlayerTest, followsTheLineBetweenKeyFramesAndEndsAtTheLast) {
  ASSERT_EQ(play("A.MTN", motionBytes("at 0 tail_pan 0 head_pan 0\nat 800 head_pan 40\nat 1600 head_pan 10\n")), "");
  const std::vector<double> path = pathOf("head_pan");
  for (int time = kFrame; time <= 1600; time += kFrame) {
    const double line = time < 800 ? time * 40.0 / 800 : 40 - (time - 800) * 30.0 / 800;
    EXPECT_LT(distance(path, time - kFrame, line), 0.5) << time << " ms";
  }
  EXPECT_NEAR(at("head_pan"), 10, 1e-4);
  EXPECT_LT(path.size(), 215U) << "it ends soon after its last key frame";
}

// Its key frames need not be in the frames of 8 ms: what is left of a frame counts for the next step.
TEST_F(MotionPlayerTest, keepsTheTimeOfStepsThatAreNotWholeFrames) {
  std::string text = "frame 12\nat 0 head_pan 0\n";
  for (int i = 1; i <= 80; ++i) {
    text += "at " + std::to_string(12 * i) + " head_pan " + std::to_string(i % 2) + "\n";
  }
  ASSERT_EQ(play("A.MTN", motionBytes(text)), "");
  const auto frames = static_cast<int>(pathOf("head_pan").size());
  EXPECT_NEAR(frames, 80 * 12 / kFrame, kLag / kFrame + 2);
}

// Wherever it was stopped in the middle.
TEST_F(MotionPlayerTest, playsAfterAStopLikeTheFirstTime) {
  const std::string motion =
      motionBytes("at 0 head_pan 0\nat 400 head_pan 20\nat 800 head_pan -20\nat 1200 head_pan 0\n");
  std::vector<double> first;
  for (int frames = 0; frames < 200; frames += 13) {
    SCOPED_TRACE(frames);
    planner_.SetPosition(joint("head_pan"), 0);
    ASSERT_EQ(play("A.MTN", motion, 2), "");
    const std::vector<double> path = pathOf("head_pan");
    first = first.empty() ? path : first;
    EXPECT_EQ(path, first);
    ASSERT_EQ(play("A.MTN", motion, 2), "");
    passFrames(frames);
    stop("A.MTN");
  }
}

TEST_F(MotionPlayerTest, beginsWhereTheJointsAreWithoutAJump) {
  planner_.SetPosition(joint("head_pan"), -1000000);
  ASSERT_EQ(play("A.MTN", motionBytes("at 0 head_pan 50 tail_pan 1\nat 80 head_pan 50\n")), "");
  const std::vector<double> path = pathOf("head_pan");
  EXPECT_NEAR(path.front(), degrees(-1000000), 0.5);
  // Somewhat faster than on average, as it speeds up and brakes.
  EXPECT_LT(greatestStep(path), 1.1 * degrees(PlayedMotion::APPROACH_SPEED) * kFrame / 1000);
  EXPECT_NEAR(at("head_pan"), 50, 1e-4);
}

TEST_F(MotionPlayerTest, beginsWhereItShouldEvenIfASpeedLimitIsLoweredOnTheWay) {
  planner_.SetPosition(joint("head_pan"), -1000000);
  ASSERT_EQ(play("A.MTN", motionBytes("at 0 head_pan 50\nat 800 head_pan 40\n")), "");
  passFrames(10);
  planner_.SetSpeedLimit(joint("head_pan"), 349066);
  const std::vector<double> path = pathOf("head_pan");
  EXPECT_NEAR(*std::max_element(path.begin(), path.end()), 50, 1e-4);
}

TEST_F(MotionPlayerTest, stopsOnTheWayToItsBeginning) {
  ASSERT_EQ(play("A.MTN", motionBytes("at 0 head_pan 60 tail_pan 40\nat 80 head_pan 60 tail_pan 40\n")), "");
  passFrames(40);
  stop("A.MTN");
  passFrames(500);
  EXPECT_LT(at("head_pan"), 50);
  EXPECT_LT(at("tail_pan"), 30);
}

TEST_F(MotionPlayerTest, aStopAfterItsEndIsNoSecondEnd) {
  ASSERT_EQ(play("A.MTN", motionBytes("at 0 head_pan 10\nat 80 head_pan 20\n")), "");
  pathOf("head_pan");
  stop("A.MTN");
  player_->StopAll();
  EndLog::End end;
  ASSERT_TRUE(ends_.Take(EndLog::CLIENT, &end));
  EXPECT_EQ(end.how, END_DONE);
  EXPECT_FALSE(ends_.Take(EndLog::CLIENT, &end));
}

TEST_F(MotionPlayerTest, playsAsOftenAsItIsTold) {
  const std::string there_and_back = motionBytes("at 0 head_pan -10\nat 320 head_pan 10\nat 640 head_pan -10\n");
  for (const int repetitions : {1, 2, 5}) {
    ASSERT_EQ(play("A.MTN", there_and_back, repetitions), "");
    const std::vector<double> path = pathOf("head_pan");
    EXPECT_EQ(countPasses(path), repetitions);
  }
}

TEST_F(MotionPlayerTest, aMotionThatEndsWhereItBeganRepeatsWithoutAStop) {
  planner_.SetPosition(joint("head_pan"), 0);
  ASSERT_EQ(play("A.MTN", motionBytes("at 0 head_pan 0\nat 160 head_pan 10\nat 320 head_pan 0\n"), 10), "");
  EXPECT_NEAR(static_cast<double>(pathOf("head_pan").size()), 10 * 320.0 / kFrame, 5);
}

TEST_F(MotionPlayerTest, aMotionThatEndsElsewhereReturnsToItsBeginningSlowly) {
  ASSERT_EQ(play("A.MTN", motionBytes("at 0 tail_pan 5 head_pan -40\nat 1600 head_pan 40\n"), 2), "");
  const std::vector<double> path = pathOf("head_pan");
  EXPECT_EQ(countPasses(path), 2);
  EXPECT_LT(greatestStep(path), 1.1 * degrees(PlayedMotion::APPROACH_SPEED) * kFrame / 1000);
}

TEST_F(MotionPlayerTest, aSingleKeyFrameIsAPosture) {
  ASSERT_EQ(play("A.MTN", motionBytes("at 0 head_pan 30 tail_pan -20\n"), 3), "");
  pathOf("head_pan");
  EXPECT_NEAR(at("head_pan"), 30, 1e-4);
  EXPECT_NEAR(at("tail_pan"), -20, 1e-4);
}

TEST_F(MotionPlayerTest, positionsALittleBeyondALimitAreClipped) {
  ASSERT_EQ(play("A.MTN", motionBytes("at 0 head_pan 0 neck_tilt 0 head_tilt 0\n"
                                      "at 1600 head_pan 92 neck_tilt -79 head_tilt 1\n"
                                      "at 2000\n")),
            "");
  EXPECT_THAT(player_->Changes(), StrEq("6 positions are clipped, by up to 4.0 degrees (head_pan at 1600 ms)"));
  const std::vector<double> path = pathOf("head_pan");
  EXPECT_LE(*std::max_element(path.begin(), path.end()), 88 + 1e-4);
  EXPECT_NEAR(at("head_pan"), 88, 1e-4);
  EXPECT_NEAR(at("neck_tilt"), -75, 1e-4);
  EXPECT_NEAR(at("head_tilt"), 5, 1e-4) << "its limit for this neck";
}

TEST_F(MotionPlayerTest, aJointOutsideOfTheMotionStillRestrictsIt) {
  planner_.SetPosition(joint("neck_tilt"), robot_.joints[joint("neck_tilt")].lowest);
  ASSERT_EQ(play("A.MTN", motionBytes("at 0 head_tilt 20\nat 800 head_tilt -10\n")), "");
  pathOf("head_tilt");
  EXPECT_NEAR(at("head_tilt"), 5, 1e-4) << "its limit for this neck";
}

// A knee moves 302.5 degrees a second at most.
TEST_F(MotionPlayerTest, aStepThatIsTooFastTakesLongerAndTheNextOneKeepsItsTime) {
  ASSERT_EQ(play("A.MTN", motionBytes("at 0 left_front_knee 0 head_pan 0\n"
                                      "at 160 left_front_knee 100 head_pan 10\n"
                                      "at 960 left_front_knee 100 head_pan 60\n")),
            "");
  EXPECT_THAT(player_->Changes(), StrEq("1 step is too fast, so it takes 1.13 s, which is 0.17 s longer"));
  const std::vector<double> path = pathOf("head_pan");
  EXPECT_LT(distance(path, 331 / kFrame * kFrame, 10), 0.5) << "the other joints wait for it";
  EXPECT_LT(distance(path, 731 / kFrame * kFrame, 35), 0.5);
  EXPECT_NEAR(static_cast<double>(path.size()) * kFrame, 1131, 80);
}

TEST_F(MotionPlayerTest, aLowerSpeedLimitMakesItLongerFromTheNextStepOn) {
  ASSERT_EQ(play("A.MTN", motionBytes("at 0 head_pan 0\nat 800 head_pan 40\nat 1600 head_pan 0\n"), 2), "");
  EXPECT_THAT(player_->Changes(), StrEq(""));
  planner_.SetSpeedLimit(joint("head_pan"), 349066);  // 20 degrees a second: 2 s for each step
  const double seconds = static_cast<double>(pathOf("head_pan").size()) * kFrame / 1000;
  EXPECT_NEAR(seconds, 8, 0.2);
}

TEST_F(MotionPlayerTest, tellsHowMuchLongerItTookBecauseTheProgramWasHeldUp) {
  unsigned now = 0xffffff00;  // it overflows
  const auto endOf = [&](unsigned held_up_ms) {
    planner_.SetPosition(joint("head_pan"), 0);
    EXPECT_EQ(play("A.MTN", motionBytes("at 0 head_pan 0\nat 800 head_pan 40\n")), "");
    for (int frame = 0; player_->IsPlaying() && frame < kPatience; ++frame) {
      player_->SetTime(now += kFrame + (frame == 50 ? held_up_ms : 0));
      passFrame();
    }
    EndLog::End end = {};
    EXPECT_TRUE(ends_.Take(EndLog::CLIENT, &end));
    EXPECT_EQ(end.how, END_DONE);
    return std::string(end.reason);
  };
  EXPECT_EQ(endOf(64), "");
  EXPECT_EQ(endOf(970), "the robot's program was held up, so it took 1.78 s instead of 0.82 s");
  EXPECT_EQ(endOf(0), "") << "the next one is in time";
}

TEST_F(MotionPlayerTest, playsAMotionThatEndsWhereItBeganOnceClipped) {
  ASSERT_EQ(play("A.MTN", motionBytes("at 0 head_pan 89\nat 800 head_pan 0\nat 1600 head_pan 90\n"), 2), "");
  planner_.SetPosition(joint("head_pan"), robot_.joints[joint("head_pan")].highest);
  EXPECT_NEAR(static_cast<double>(pathOf("head_pan").size()) * kFrame, 3200, 60) << "without a stop";
}

TEST_F(MotionPlayerTest, playsMotionsOfOtherJointsAtOnce) {
  for (const char* const slow : {"left_front_knee", "tail_tilt"}) {
    planner_.SetAccelerationLimit(joint(slow), 200000);
  }
  ASSERT_EQ(play("A.MTN", motionBytes("at 0 head_pan 0 left_front_knee 0\nat 1600 head_pan 40 left_front_knee 30\n")),
            "");
  passFrames(50);
  ASSERT_EQ(play("B.MTN", motionBytes("at 0 tail_pan 0 tail_tilt 5\nat 1600 tail_pan 30 tail_tilt 50\n")), "");
  pathOf("head_pan");
  EXPECT_NEAR(at("head_pan"), 40, 1e-4);
  EXPECT_NEAR(at("left_front_knee"), 30, 1e-4) << "it arrives later";
  EXPECT_NEAR(at("tail_pan"), 30, 1e-4);
  EXPECT_NEAR(at("tail_tilt"), 50, 1e-4);
}

TEST_F(MotionPlayerTest, refusesAMotionOfAJointThatIsMovedAlready) {
  const std::string head = motionBytes("at 0 tail_pan 0 head_pan 0\nat 1600 head_pan 40\n");
  ASSERT_EQ(play("A.MTN", head), "");
  EXPECT_THAT(play("B.MTN", motionBytes("at 0 mouth -10 head_pan 5\n")),
              StrEq("A.MTN is being played and moves head_pan, too; stop it first"));
  EXPECT_THAT(play("A.MTN", head), HasSubstr("A.MTN is being played"));
  pathOf("head_pan");
  EXPECT_EQ(play("B.MTN", motionBytes("at 0 head_pan 5\n")), "") << "it is over now";
}

// The last of them, which moves the last joint, is like the others.
TEST_F(MotionPlayerTest, playsUpToItsMaximumAtOnce) {
  const char* const joints[MotionPlayer::MAX_PLAYING] = {"head_pan", "tail_pan", "left_front_knee", "tail_tilt"};
  const auto name = [](int i) { return std::to_string(i) + ".MTN"; };
  const auto play_all = [&](int repetitions) {
    for (int i = 0; i < MotionPlayer::MAX_PLAYING; ++i) {
      const std::string moved = joints[i];
      const std::string ear = i + 1 == MotionPlayer::MAX_PLAYING ? " left_ear " : "";
      ASSERT_EQ(play(name(i),
                     motionBytes("at 0 " + moved + " 10" + (ear.empty() ? "" : ear + "0") + "\nat 800 " + moved +
                                 " 20" + (ear.empty() ? "" : ear + "1") + "\n"),
                     repetitions),
                "");
    }
    EXPECT_EQ(player_->FindRoom(), nullptr);
  };
  play_all(1000);
  passFrames(3);
  player_->EndRepetitions();
  EXPECT_LT(pathOf("head_pan").size(), 300U);
  EXPECT_NE(player_->FindRoom(), nullptr);
  EXPECT_TRUE(player_->TakeFlick(findEarByName(robot_, "left_ear")));
  play_all(1);
  player_->StopAll();
  EXPECT_FALSE(player_->IsPlaying());
  play_all(1);
  for (int i = 0; i < MotionPlayer::MAX_PLAYING; ++i) {
    EXPECT_TRUE(player_->IsPlaying());
    EXPECT_THAT(play("A.MTN", motionBytes("at 0 tail_tilt 10\n")),
                AnyOf("no room", HasSubstr("3.MTN is being played")));
    stop(name(i));
  }
  EXPECT_FALSE(player_->IsPlaying());
  bool commanded[robot_model::MAX_JOINTS] = {};
  commanded[joint("tail_tilt")] = true;
  EXPECT_THAT(play("A.MTN", motionBytes("at 0 tail_tilt 10\n"), 1, false, commanded),
              HasSubstr("tail_tilt was commanded"));
}

TEST_F(MotionPlayerTest, refusesAFileThatIsNotAMotion) {
  EXPECT_THAT(play("A.MTN", "OMTN"), StrEq("A.MTN is not a motion file: it ends before section 0"));
  EXPECT_THAT(play("B.MTN", ""), StrEq("B.MTN is not a motion file: it does not begin with OMTN"));
  EXPECT_FALSE(player_->IsPlaying());
}

TEST_F(MotionPlayerTest, leavesOutJointsOfAnotherRobotIfItIsTold) {
  const std::string motion = motionBytes("at 0 PRM:/r1/c1/c2/c3-Joint2:j3 0 head_pan 0\nat 800 head_pan 20\n");
  EXPECT_THAT(play("A.MTN", motion),
              StrEq("A.MTN moves the joint PRM:/r1/c1/c2/c3-Joint2:j3, which this robot does not have"));
  ASSERT_EQ(play("A.MTN", motion, 1, true), "");
  EXPECT_THAT(player_->Changes(), StrEq("1 joint that this robot does not have is left out"));
  pathOf("head_pan");
  EXPECT_NEAR(at("head_pan"), 20, 1e-4);
  ASSERT_EQ(play("B.MTN", motionBytes("at 0 head_pan 5\n")), "");
  EXPECT_THAT(player_->Changes(), StrEq("")) << "of the motion before";
}

// ----------------------------------------------------------------------------------------------------------- ears

class MotionOfEarsTest : public MotionPlayerTest {
 protected:
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
};

TEST_F(MotionOfEarsTest, earsFlickWhenTheirValuesChange) {
  const std::string motion = motionBytes(
      "at 0 left_ear 0 right_ear 0\nat 400 left_ear 1\nat 800 right_ear 5\nat 1200 left_ear 0\nat 1600 left_ear 0\n");
  ASSERT_EQ(play("A.MTN", motion), "");
  EXPECT_THAT(player_->Changes(), StrEq(""));
  EXPECT_THAT(flicksOf("left_ear"), ElementsAre(400 - kFrame, 1200 - kFrame));
  EXPECT_TRUE(player_->TakeFlick(findEarByName(robot_, "right_ear"))) << "nobody has taken it yet";
  EXPECT_FALSE(player_->TakeFlick(findEarByName(robot_, "right_ear")));
}

TEST_F(MotionOfEarsTest, earsFlickInEachRepetitionAndOnlyWhereTheFileSays) {
  const std::string motion = motionBytes("at 0 head_pan 0 left_ear 7\nat 400 left_ear 8\nat 800\n");
  ASSERT_EQ(play("A.MTN", motion, 3), "");
  EXPECT_THAT(flicksOf("left_ear"), SizeIs(3));
}

TEST_F(MotionOfEarsTest, severalMotionsMayHaveEars) {
  ASSERT_EQ(play("A.MTN", motionBytes("at 0 head_pan 0 left_ear 0\nat 400 left_ear 1\n")), "");
  ASSERT_EQ(play("B.MTN", motionBytes("at 0 tail_pan 0 left_ear 0\nat 800 left_ear 1\n")), "");
  EXPECT_THAT(flicksOf("left_ear"), SizeIs(2));
  ASSERT_EQ(play("A.MTN", motionBytes("at 0 head_pan 0 left_ear 0\nat 400 left_ear 1\n")), "");
  ASSERT_EQ(play("B.MTN", motionBytes("at 0 head_tilt 0 left_ear 0\nat 400 left_ear 1\n")), "");
  EXPECT_THAT(flicksOf("left_ear"), SizeIs(1)) << "both at the same time";
}

TEST_F(MotionOfEarsTest, earsOfAStoppedMotionDoNotFlick) {
  ASSERT_EQ(play("A.MTN", motionBytes("frame 8\nat 0 left_ear 0\nat 8 left_ear 1\nat 16 left_ear 0\n")), "");
  passFrames(2);
  player_->StopAll();
  EXPECT_THAT(flicksOf("left_ear"), IsEmpty());
  EXPECT_FALSE(player_->TakeFlick(findEarByName(robot_, "left_ear")));
}

// -------------------------------------------------------------------------------------------------- stopped early

class StoppedMotionTest : public MotionPlayerTest {
 protected:
  void SetUp() override {
    ASSERT_EQ(play("A.MTN", motionBytes("at 0 head_pan 0 head_tilt 0\nat 1600 head_pan 60 head_tilt 30\n")), "");
    ASSERT_EQ(play("B.MTN", motionBytes("at 0 tail_pan 0\nat 1600 tail_pan 40\n")), "");
    passFrames(100);
    EXPECT_GT(planner_.Speed(joint("head_pan")), 0);
  }

  const EndReason kMotorsOff = {protocol::version2::END_STOPPED, "the motors were switched off", ""};
  const EndReason kCommanded = {protocol::version2::END_REPLACED, "%s was commanded", "head_tilt"};
  const EndReason kFailed = {protocol::version2::END_REFUSED, "%s does not follow", "head_tilt"};

  // The ends that have not been taken.
  std::vector<std::string> ends() {
    std::vector<std::string> all;
    for (EndLog::End taken; ends_.Take(EndLog::CLIENT, &taken);) {
      all.push_back(std::string(taken.name) + " " + std::to_string(taken.how) + " " + taken.reason);
    }
    return all;
  }

  // The joints of A.MTN brake and stop.
  void expectStopped() {
    const double at_first = at("head_pan");
    const double highest = robot_.joints[joint("head_pan")].highest_speed;
    const double way = degrees(static_cast<int>(std::pow(planner_.Speed(joint("head_pan")), 2) / (2 * 10 * highest)));
    passFrames(100);
    EXPECT_LE(at("head_pan") - at_first, way + 0.1);
    EXPECT_EQ(planner_.Speed(joint("head_pan")), 0);
    EXPECT_EQ(planner_.Speed(joint("head_tilt")), 0);
  }
};

TEST_F(StoppedMotionTest, isStoppedByItsName) {
  stop("A.MTN");
  expectStopped();
  EXPECT_TRUE(player_->IsPlaying()) << "the other one goes on";
  pathOf("tail_pan");
  EXPECT_NEAR(at("tail_pan"), 40, 1e-4);
}

TEST_F(StoppedMotionTest, allAreStoppedAtOnce) {
  player_->StopAll(kMotorsOff);
  EXPECT_FALSE(player_->IsPlaying());
  expectStopped();
}

TEST_F(StoppedMotionTest, commandingAJointEndsItsMotion) {
  player_->StopMotionOf(joint("head_tilt"), kCommanded);
  planner_.Aim(joint("head_tilt"), 0);
  planner_.Go(0);
  passFrames(200);
  EXPECT_NEAR(at("head_tilt"), 0, 1e-4);
  EXPECT_LT(at("head_pan"), 45);
  EXPECT_NEAR(at("tail_pan"), 40, 1e-4) << "the other one has gone on";
}

TEST_F(StoppedMotionTest, endsWhenOneOfItsJointsFails) {
  player_->StopMotionOf(joint("head_tilt"), kFailed);
  expectStopped();
  EXPECT_THAT(ends(), ElementsAre("A.MTN 3 head_tilt does not follow"));
  EXPECT_THAT(ends(), ElementsAre()) << "reported once";
  EXPECT_TRUE(player_->IsPlaying());
}

TEST_F(StoppedMotionTest, reportsAnEndByNameEvenIfAnotherMotionIsPlayedMeanwhile) {
  player_->StopMotionOf(joint("head_tilt"), kFailed);
  ASSERT_EQ(play("C.MTN", motionBytes("at 0 mouth -10\n")), "");
  EXPECT_THAT(ends(), ElementsAre("A.MTN 3 head_tilt does not follow"));
}

TEST_F(StoppedMotionTest, aJointOfNoMotionFailsWithoutConsequences) {
  player_->StopMotionOf(joint("mouth"), kFailed);
  EXPECT_THAT(ends(), ElementsAre());
}

TEST_F(StoppedMotionTest, everyEndIsReportedWithItsCauseTheOldestFirst) {
  stop("B.MTN");
  player_->StopAll(kMotorsOff);
  ASSERT_EQ(play("C.MTN", motionBytes("at 0 mouth -10\n")), "");
  pathOf("mouth");
  EXPECT_THAT(ends(), ElementsAre("B.MTN 2 the client stopped it", "A.MTN 2 the motors were switched off", "C.MTN 0 "));
}

TEST_F(StoppedMotionTest, whatIsNotTakenIsForgottenAfterAWhileTheOldestFirst) {
  player_->StopAll();
  ends_.ClientGone();
  EXPECT_THAT(ends(), ElementsAre()) << "the next client hears nothing of it";
  for (unsigned i = 0; i < EndLog::MAX_ENDS + 2; ++i) {
    ASSERT_EQ(play(std::to_string(i) + ".MTN", motionBytes("at 0 mouth -10\n")), "");
    player_->StopAll();
  }
  const std::vector<std::string> kept = ends();
  ASSERT_EQ(kept.size(), EndLog::MAX_ENDS);
  EXPECT_EQ(kept.front(), "2.MTN 2 the client stopped it");
  EXPECT_EQ(kept.back(), std::to_string(EndLog::MAX_ENDS + 1) + ".MTN 2 the client stopped it");
}

// ------------------------------------------------------------------------------------------------ shipped motions

class ShippedMotionsPlayedTest : public MotionPlayerTest, public ::testing::WithParamInterface<const char*> {
 protected:
  void SetUp() override {
    bytes_ = fileContent(std::string(MEMORY_STICK "/OPEN-R/MW/DATA/P/") + GetParam() + ".MTN");
    ASSERT_TRUE(motion_.read(reinterpret_cast<const unsigned char*>(bytes_.data()), bytes_.size()))
        << motion_.problem();
    ASSERT_EQ(play(std::string(GetParam()) + ".MTN", bytes_), "");
  }

  int robotsJoint(int i) const { return findJointByLocator(robot_, motion_.locator(i)); }

  bool isAtFirstKeyFrame() const {
    for (int i = 0; i < motion_.numberOfJoints(); ++i) {
      if (planner_.Position(robotsJoint(i)) != motion_.position(0, i)) {
        return false;
      }
    }
    return true;
  }

  // The distance a joint needs to stop from its speed at a key frame.
  double roundingAt(int key_frame, int i) const {
    const double way = degrees(motion_.position(key_frame, i) - motion_.position(key_frame - 1, i));
    const double speed = way * 1000 / motion_.milliseconds(key_frame);
    return speed * speed / (2 * degrees(planner_.AccelerationLimit(robotsJoint(i))));
  }

  std::string bytes_;
  mtn::Motion motion_;
};

TEST_P(ShippedMotionsPlayedTest, passesThroughAllKeyFrames) {
  for (int frame = 0; frame < kPatience && !isAtFirstKeyFrame(); ++frame) {
    passFrame();
  }
  std::vector<std::vector<double>> paths(static_cast<size_t>(motion_.numberOfJoints()));
  while (player_->IsPlaying() && paths[0].size() < kPatience) {
    for (int i = 0; i < motion_.numberOfJoints(); ++i) {
      paths[static_cast<size_t>(i)].push_back(degrees(planner_.Position(robotsJoint(i))));
    }
    passFrame();
  }
  int milliseconds = 0;
  for (int key_frame = 1; key_frame < motion_.numberOfKeyFrames(); ++key_frame) {
    milliseconds += motion_.milliseconds(key_frame);
    for (int i = 0; i < motion_.numberOfJoints(); ++i) {
      const std::vector<double>& path = paths[static_cast<size_t>(i)];
      EXPECT_LT(distance(path, milliseconds, degrees(motion_.position(key_frame, i))), roundingAt(key_frame, i) + 0.5)
          << robot_.joints[robotsJoint(i)].name << " at key frame " << key_frame;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Motions, ShippedMotionsPlayedTest, ::testing::Values("LIE", "NOD", "WAG", "SIT"));

}  // namespace
