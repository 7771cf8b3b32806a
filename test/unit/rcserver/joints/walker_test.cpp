#include "rcserver/joints/Walker.h"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "motion_bytes.h"
#include "rcserver/joints/JointControl.h"

namespace {

using protocol::version2::END_REFUSED;
using protocol::version2::Posture;
using protocol::version2::POSTURE_REST;
using protocol::version2::POSTURE_SIT;
using protocol::version2::POSTURE_STAND;
using protocol::version2::Velocity;
using protocol::version2::WalkLimits;
using robot_model::LegAngles;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::UnorderedElementsAre;

constexpr int kFramesASecond = 125;
constexpr double kFrame = 0.008;
constexpr double kGravity = 9.80665;
constexpr FallWatch::Reading kUpright = {0.05, -0.08, kGravity, {true, true, true, true}};
constexpr FallWatch::Reading kOnItsSide = {0, kGravity, 0, {true, true, true, true}};
constexpr FallWatch::Reading kOnItsBack = {0, 0, -kGravity, {}};
constexpr FallWatch::Reading kInTheAir = {0, 0, kGravity, {}};

class WalkerTest : public ::testing::Test {
 protected:
  WalkerTest() { take(POSTURE_STAND); }

  Walker& walker() { return joints_.Walking(); }
  int joint(const std::string& name) const { return findJointByName(robot_, name.c_str()); }
  int position(const std::string& name) { return joints_.Planner().Position(joint(name)); }

  // A motion with these key frames, by a client.
  void play(const std::string& key_frames, int repetitions = 1, const std::string& name = "HEAD.MTN") {
    protocol::MotionName motion_name;
    ASSERT_EQ(protocol::readMotionName(name.data(), name.size(), motion_name), nullptr);
    const std::string motion = motionBytes(key_frames);
    motion.copy(reinterpret_cast<char*>(joints_.Motions().FindRoom()), motion.size());
    ASSERT_EQ(joints_.Motions().Play(motion_name, motion.size(), repetitions, false, nullptr), nullptr);
    joints_.MotionHasBegun();
  }

  // A client commands a joint.
  void command(const std::string& name, int position) {
    protocol::version2::JointTargets targets = {0, 1, {{joints_.Identifier(joint(name)), position}}};
    joints_.SetTargets(&targets);
  }

  void pass(int frames) {
    for (int i = 0; i < frames; ++i) {
      const std::vector<int> before = positions();
      joints_.NextFrame();
      ++frame_;
      measured_ = holds_still_ ? measured_ : positions();
      if (++frames_since_report_ == 4) {
        report();
      }
      check(before);
    }
  }

  std::vector<int> positions() {
    std::vector<int> positions;
    for (int joint = 0; joint < robot_.number_of_joints; ++joint) {
      positions.push_back(joints_.Planner().Position(joint));
    }
    return positions;
  }

  LegAngles anglesOf(int leg) {
    const auto angle = [&](int number) {
      return joints_.Planner().Position(joints_.Find(legJointIdentifier(static_cast<robot_model::Leg>(leg), number))) *
             1e-6;
    };
    return {angle(0), angle(1), angle(2)};
  }

  double heightOfFoot(robot_model::Leg leg) { return findFoot(leg, anglesOf(leg)).z; }

  // The joints do what they are told, unless they hold still. The lowest feet are on the floor if there is one.
  void report() {
    frames_since_report_ = 0;
    FallWatch::Reading reading = reading_;
    double lowest = 0;
    for (int leg = 0; leg < robot_model::NUMBER_OF_LEGS; ++leg) {
      lowest = std::min(lowest, heightOfFoot(static_cast<robot_model::Leg>(leg)));
    }
    for (int leg = 0; leg < robot_model::NUMBER_OF_LEGS; ++leg) {
      reading.paws[leg] = reading.paws[leg] && heightOfFoot(static_cast<robot_model::Leg>(leg)) < lowest + 0.004;
    }
    walker().Measured(reading, measured_.data(), frame_);
    std::array<LegAngles, robot_model::NUMBER_OF_LEGS> legs = {anglesOf(0), anglesOf(1), anglesOf(2), anglesOf(3)};
    told_.Measured(legs.data(), reading.paws, frame_, 0);
  }

  // As a client does: again and again.
  void steer(const Velocity& velocity, int frames) {
    for (int passed = 0; passed < frames; passed += 12) {
      joints_.Steer(velocity);
      pass(std::min(12, frames - passed));
    }
  }

  int passUntilIdle(int most = 3000) {
    int frames = 0;
    while (walker().IsActive() && frames < most) {
      pass(1);
      ++frames;
      if (walker().WantsMotorsOff()) {
        joints_.MotorsGoOff();
      }
    }
    return frames;
  }

  bool goesSoft() {
    pass(4);
    if (walker().WantsMotorsOff()) {
      joints_.MotorsGoOff();
    }
    return walker().TakeSoftened();
  }

  void take(Posture posture) {
    joints_.Take(posture);
    passUntilIdle();
    ends();
  }

  void walk(const Velocity& velocity = {0.1, 0, 0}) { steer(velocity, 2 * kFramesASecond); }

  // "walk: left_front_knee was commanded"
  std::vector<std::string> ends(EndLog::Reader reader = EndLog::CLIENT) {
    std::vector<std::string> texts;
    for (EndLog::End end; joints_.Ends().Take(reader, &end);) {
      texts.push_back(std::string(end.name) + ": " + end.reason);
    }
    return texts;
  }

  // Checks what holds in every frame: limits, couplings, speeds.
  void check(const std::vector<int>& before) {
    const std::vector<int> now = positions();
    for (int joint = 0; joint < robot_.number_of_joints; ++joint) {
      const auto i = static_cast<std::size_t>(joint);
      ASSERT_GE(now[i], lowestPosition(robot_, joint, now.data())) << robot_.joints[joint].name;
      ASSERT_LE(now[i], robot_.joints[joint].highest) << robot_.joints[joint].name;
      ASSERT_LE(std::abs(now[i] - before[i]) * kFramesASecond, robot_.joints[joint].highest_speed);
      fastest_ = std::max(fastest_, std::abs(now[i] - before[i]) * kFramesASecond);
      if (walker().State() == protocol::version2::WALK_STATE_WALKS && walker().Moves(joint)) {
        const int lag = std::abs(joints_.Planner().Target(joint) - now[i]);
        farthest_lag_ = std::max(farthest_lag_, lag);
        steps_ += 1;
        late_steps_ += lag > kDegree ? 1 : 0;
      }
    }
  }

  // Rises, walks, turns and stands again: what the legs do in each frame, how fast they say that is, and how it ends.
  std::vector<std::string> traceOfAWalk() {
    std::vector<std::string> trace;
    const auto record = [&] {
      std::string now = std::to_string(walker().Phase());
      for (int joint = 0; joint < robot_.number_of_joints; ++joint) {
        now += walker().Moves(joint) ? " " + std::to_string(joints_.Planner().Position(joint)) : "";
      }
      trace.push_back(now + " forward " + std::to_string(walker().TakeVelocity().forward));
    };
    for (int i = 0; i < 3000 && walker().State() != protocol::version2::WALK_STATE_WALKS; ++i) {
      joints_.Steer({-0.05, 0, 0});
      walker().TakeVelocity();
      frames_since_report_ = 3;  // so that the walk begins with a report each time
      pass(1);
    }
    ends();
    record();
    for (int i = 0; i < 100; ++i) {
      joints_.Steer({-0.05, 0, i < 50 ? 0 : 0.3});
      pass(1);
      record();
    }
    for (int i = 0; i < 3000 && walker().IsActive(); ++i) {
      pass(1);
      record();
    }
    for (const std::string& end : ends()) {
      trace.push_back(end);
    }
    return trace;
  }

  bool isIn(Posture posture) {
    for (int leg = 0; leg < robot_model::NUMBER_OF_LEGS; ++leg) {
      const LegAngles& angles = postures_.Legs(posture)[leg];
      const double values[] = {angles.rotator, angles.elevator, angles.knee};
      for (int number = 0; number < robot_model::JOINTS_OF_A_LEG; ++number) {
        const int joint = joints_.Find(legJointIdentifier(static_cast<robot_model::Leg>(leg), number));
        if (std::abs(joints_.Planner().Position(joint) - values[number] * 1e6) > 1) {
          return false;
        }
      }
    }
    return true;
  }

  const robot_model::RobotModel& robot_ = *robot_model::findRobotModel("ERS-7");
  JointControl joints_{robot_};
  const Postures postures_{Gait()};
  FallWatch::Reading reading_ = kUpright;
  unsigned frame_ = 0xfffffc00;  // it overflows
  unsigned frames_since_report_ = 0;
  std::vector<int> measured_ = std::vector<int>(robot_model::MAX_JOINTS);
  bool holds_still_ = false;
  WalkedVelocity told_;                  // of legs that do as they are told
  int fastest_ = 0;                      // microradian/s
  static constexpr int kDegree = 17453;  // microradian
  int farthest_lag_ = 0;                 // microradian
  int steps_ = 0;                        // of all joints
  int late_steps_ = 0;                   // those that lag by more than a degree
};

// -------------------------------------------------------------------------------------------------------------- walk

TEST_F(WalkerTest, WalksWithTheVelocityItIsSteeredWithAndStandsInTheEnd) {
  walk({0.1, 0, 0.2});
  EXPECT_EQ(walker().State(), protocol::version2::WALK_STATE_WALKS);
  walker().TakeVelocity();
  steer({0.1, 0, 0.2}, 600);  // ten steps
  const Velocity velocity = walker().TakeVelocity();
  EXPECT_NEAR(velocity.forward, 0.1, 2e-3);
  EXPECT_NEAR(velocity.left, 0, 2e-3);
  EXPECT_NEAR(velocity.turn, 0.2, 5e-3);
  const Velocity none = joints_.Steer({0, 0, 0});
  EXPECT_TRUE(none.isZero());
  EXPECT_LT(passUntilIdle(), 1.2 * kFramesASecond);
  EXPECT_TRUE(isIn(POSTURE_STAND));
  EXPECT_THAT(ends(), ElementsAre("walk: "));
  walker().TakeVelocity();
  EXPECT_TRUE(walker().TakeVelocity().isZero());
  EXPECT_EQ(walker().State(), protocol::version2::WALK_STATE_NONE);
}

TEST_F(WalkerTest, LegsThatDoNotFollowAreToldToWalkFasterByPartOfTheHighestVelocity) {
  const WalkLimits& highest = walker().Parameters().highest;
  const Velocity asked[] = {{highest.forward / 4, 0, 0}, {0, highest.left / 4, 0}, {0, 0, -highest.turn / 4}};
  for (const Velocity& velocity : asked) {
    walk(velocity);
    holds_still_ = true;
    steer(velocity, 600);
    told_.Take(false);
    steer(velocity, 600);
    const Velocity told = told_.Take(false);
    const auto more = [](double part) { return part == 0 ? 0 : part * (1 + 0.3 / 0.25); };
    EXPECT_NEAR(told.forward, more(velocity.forward), 0.05 * highest.forward);
    EXPECT_NEAR(told.left, more(velocity.left), 0.05 * highest.left);
    EXPECT_NEAR(told.turn, more(velocity.turn), 0.1 * highest.turn);
    holds_still_ = false;
    joints_.Steer({0, 0, 0});
    passUntilIdle();
  }
}

TEST_F(WalkerTest, SaysTheVelocityInForce) {
  const GaitParameters& gait = walker().Parameters();
  walk();
  EXPECT_DOUBLE_EQ(joints_.Steer({9, 0, 0}).forward, gait.fastest);
  EXPECT_DOUBLE_EQ(joints_.Steer({9, 0, 0}, true).forward, gait.highest.forward) << "guarded";
  EXPECT_DOUBLE_EQ(joints_.Steer({-9, 0, 0}).forward, -gait.highest.back);
  EXPECT_DOUBLE_EQ(joints_.Steer({gait.highest.forward, 0, gait.highest.turn}).turn, gait.highest.turn / 2);
}

TEST_F(WalkerTest, WalksNoFasterThanItTrotsWhereTheGroundIsSteep) {
  for (const double lean : {0.01, 0.1, -0.1}) {
    // As far back as it leans at 250 mm/s, which is near to how it leans at 200 and at 300.
    reading_ = {0.124 * kGravity, lean * kGravity, kGravity, {true, true, true, true}};
    steer({0.3, 0, 0}, 700);
    walker().TakeVelocity();
    steer({0.3, 0, 0}, 125);
    EXPECT_NEAR(walker().TakeVelocity().forward, lean == 0.01 ? 0.3 : 0.2, 0.03) << lean;
  }
}

// The sum of what telemetry says is the way: what odometry needs.
TEST_F(WalkerTest, TellsTheWayOfTheFeet) {
  walker().TakeVelocity();
  double way = 0;
  double commanded = 0;
  for (int i = 0; i < 40; ++i) {
    steer({0.1, 0, 0}, 25);
    way += walker().TakeVelocity().forward * 25 * kFrame;
    commanded += 0.1 * 25 * kFrame;
  }
  EXPECT_NEAR(way, commanded - 0.028, 0.005) << "but for the time in which it speeds up";
  joints_.Steer({0, 0, 0});
  const int frames = passUntilIdle();
  way += walker().TakeVelocity().forward * frames * kFrame;
  EXPECT_NEAR(way, commanded, 0.01) << "and slows down";
}

// What a joint lags behind is what a foot slips. While the velocity changes a lot, a joint may be late for some frames.
TEST_F(WalkerTest, NoJointComesNearItsLimitsWhateverIsSteered) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int i = 0; i < 600 && !HasFatalFailure(); ++i) {
    Velocity velocity = {any(random) * 0.3, any(random) * 0.1, any(random) * 2};
    if (i % 10 == 9) {
      velocity = {0, 0, 0};
    } else if (i % 3 == 0) {
      velocity.left = velocity.turn = 0;
    }
    steer(velocity, 10 + static_cast<int>((any(random) + 1) * 100));
  }
  EXPECT_LT(farthest_lag_, 4 * kDegree);
  EXPECT_LT(late_steps_, steps_ / 20000);
}

TEST_F(WalkerTest, SharesTheLegsSpeedWhileTheVelocityChanges) {
  const GaitParameters& gait = walker().Parameters();
  walk({0, 0, gait.highest.turn});
  double highest = 0;
  for (int i = 0; i < 100; ++i) {
    joints_.Steer({gait.highest.forward / 2, gait.highest.left / 2, 0});
    walker().TakeVelocity();
    pass(4);
    const Velocity velocity = walker().TakeVelocity();
    highest = std::max(highest, velocity.forward / gait.highest.forward + velocity.left / gait.highest.left +
                                    velocity.turn / gait.highest.turn);
  }
  EXPECT_LT(highest, 1.25);
}

TEST_F(WalkerTest, EndsInTheStandIfItIsNotSteeredForHalfASecond) {
  walk();
  steer({0.1, 0, 0}, 300);
  joints_.Steer({0.1, 0, 0});
  walker().TakeVelocity();
  pass(62);
  EXPECT_NEAR(walker().TakeVelocity().forward, 0.1, 0.002);
  const int frames = passUntilIdle();
  EXPECT_GT(frames, 40);
  EXPECT_LT(frames, 1.2 * kFramesASecond);
  EXPECT_TRUE(isIn(POSTURE_STAND));
  EXPECT_THAT(ends(), ElementsAre("walk: it was not steered for 500 ms"));
}

TEST_F(WalkerTest, GoesOnIfItIsSteeredAgainBeforeItStands) {
  walk();
  joints_.Steer({0, 0, 0});
  pass(30);
  walk();
  EXPECT_EQ(walker().State(), protocol::version2::WALK_STATE_WALKS);
  EXPECT_THAT(ends(), IsEmpty());
}

TEST_F(WalkerTest, AVelocityOfZeroDoesNotMakeARobotMoveThatDoesNotWalk) {
  take(POSTURE_SIT);
  EXPECT_TRUE(joints_.Steer({0, 0, 0}).isZero());
  pass(100);
  EXPECT_TRUE(isIn(POSTURE_SIT));
  EXPECT_FALSE(walker().IsActive());
  play("at 0 left_front_knee 60\nat 800 left_front_knee 80\n");
  joints_.Steer({0, 0, 0});
  EXPECT_TRUE(joints_.Motions().IsPlaying()) << "and takes its legs from nobody";
  for (const std::string name : {"left_front_knee", "right_hind_knee"}) {
    joints_.Motions().StopAll();
    play("at 0 " + name + " 60\nat 800 " + name + " 80\n");
    joints_.Steer({0.1, 0, 0});
    EXPECT_FALSE(joints_.Motions().IsPlaying()) << name;
    joints_.StopAll();
  }
}

TEST_F(WalkerTest, RisesSlowlyBeforeItWalks) {
  for (const Posture posture : {POSTURE_SIT, POSTURE_REST}) {
    take(posture);
    fastest_ = 0;
    int frames = 0;
    while (joints_.Steer({0.1, 0, 0}), walker().State() != protocol::version2::WALK_STATE_WALKS) {
      ASSERT_EQ(walker().State(), protocol::version2::WALK_STATE_GETS_READY);
      ASSERT_LT(++frames, 1000);
      pass(1);
    }
    EXPECT_LT(fastest_, 1.2 * Walker::POSTURE_SPEED) << posture;
    joints_.Steer({0, 0, 0});
    passUntilIdle();
  }
}

TEST_F(WalkerTest, ARobotThatIsNotSteeredWhileItRisesStandsAndDoesNotWalk) {
  take(POSTURE_REST);
  joints_.Steer({0.1, 0, 0});
  passUntilIdle();
  EXPECT_TRUE(isIn(POSTURE_STAND));
  EXPECT_THAT(ends(), ElementsAre("walk: it was not steered for 500 ms"));
  take(POSTURE_REST);
  joints_.Steer({0.1, 0, 0});
  pass(12);
  joints_.Steer({0, 0, 0});
  passUntilIdle();
  EXPECT_TRUE(isIn(POSTURE_STAND));
  EXPECT_THAT(ends(), ElementsAre("walk: "));
  walk();
  passUntilIdle();  // it is not steered
  take(POSTURE_REST);
  steer({0.1, 0, 0}, 600);
  EXPECT_EQ(walker().State(), protocol::version2::WALK_STATE_WALKS) << "the time counts from when it is steered";
}

// ----------------------------------------------------------------------------------------------------- what ends them

TEST_F(WalkerTest, ACommandToALegEndsTheWalkAndOneToTheHeadDoesNot) {
  walk();
  command("head_pan", 500000);
  steer({0.1, 0, 0}, 100);
  EXPECT_TRUE(walker().IsActive());
  EXPECT_EQ(position("head_pan"), 500000);
  command("left_front_knee", 500000);
  EXPECT_FALSE(walker().IsActive());
  pass(100);
  EXPECT_EQ(position("left_front_knee"), 500000);
  EXPECT_FALSE(joints_.AreMoving()) << "the other legs hold";
  EXPECT_THAT(ends(), ElementsAre("walk: left_front_knee was commanded"));
  take(POSTURE_STAND);
  joints_.Take(POSTURE_SIT);
  pass(20);
  const int last = position("right_hind_knee");
  command("left_front_knee", 600000);
  pass(100);
  EXPECT_NEAR(position("right_hind_knee"), last, 50000) << "the other legs hold";
}

TEST_F(WalkerTest, HoldingEndsIt) {
  walk();
  joints_.Stop(joint("head_pan"));
  EXPECT_TRUE(walker().IsActive());
  joints_.Stop(joint("right_hind_knee"));
  EXPECT_FALSE(walker().IsActive());
  joints_.Take(POSTURE_SIT);
  pass(20);
  joints_.StopAll();
  pass(30);
  EXPECT_FALSE(joints_.AreMoving());
  EXPECT_THAT(ends(), ElementsAre("walk: right_hind_knee was told to hold", "sit: everything was told to hold"));
}

TEST_F(WalkerTest, MotorsThatGoOffEndIt) {
  walk();
  joints_.MotorsGoOff();
  EXPECT_FALSE(walker().IsActive());
  EXPECT_THAT(ends(), ElementsAre("walk: the motors were switched off"));
}

TEST_F(WalkerTest, AJointThatDoesNotFollowEndsIt) {
  walk();
  JointReading jammed = {position("left_hind_knee"), 0, FULL_DUTY};
  const int knee = joint("left_hind_knee");
  for (unsigned frame = 0; frame <= 2 * JointWatch::PATIENCE && walker().IsActive(); frame += 4) {
    jammed.reference = jammed.position + 400000;
    joints_.Measured(knee, jammed, frame, true);
    steer({0.1, 0, 0}, 4);
  }
  ASSERT_THAT(ends(), ::testing::Contains("walk: left_hind_knee does not follow"));
}

TEST_F(WalkerTest, APostureMakesTheClientLetGoOfAWalkThatGetsReady) {
  take(POSTURE_REST);
  joints_.MotorsGoOff();
  steer({0.1, 0, 0}, 12);
  ASSERT_EQ(walker().State(), protocol::version2::WALK_STATE_GETS_READY);
  joints_.Take(POSTURE_SIT);
  EXPECT_THAT(walker().ProblemOfWalk(true), HasSubstr("the robot was told to take a posture; let go first"));
}

TEST_F(WalkerTest, ASpeedLimitThatIsTooLowMakesTheClientLetGo) {
  for (const std::string name : {"left_front_rotator", "right_hind_knee"}) {
    walk();
    joints_.Planner().SetSpeedLimit(joint(name), 3000000);
    pass(1);
    EXPECT_THAT(walker().ProblemOfWalk(true), HasSubstr(name + " is too low for walking; let go first"));
    joints_.Steer({0, 0, 0});
  }
}

TEST_F(WalkerTest, ASpeedLimitThatIsTooLowEndsAWalkInTheStandAndTheNextOneSetsItBack) {
  walk();
  joints_.Planner().SetSpeedLimit(joint("right_hind_knee"), 3000000);
  passUntilIdle();
  pass(50);
  EXPECT_TRUE(isIn(POSTURE_STAND));
  EXPECT_THAT(ends(), ElementsAre("walk: the speed limit of right_hind_knee is too low for walking"));
  EXPECT_EQ(walker().Problem(POSTURE_SIT), nullptr) << "postures are slow";
  walk();
  EXPECT_EQ(walker().State(), protocol::version2::WALK_STATE_WALKS);
  joints_.Planner().SetSpeedLimit(joint("right_hind_knee"), 3000000);
  pass(1);
  joints_.Steer({0, 0, 0});
  walk();
  EXPECT_THAT(ends(), IsEmpty()) << "it was steered on before it stood";
}

// A client that steers on and on does not notice what has ended its walk.
TEST_F(WalkerTest, AClientWhoseWalkWasEndedHasToLetGo) {
  walk();
  EXPECT_EQ(walker().ProblemOfWalk(true), nullptr);
  command("left_front_knee", 500000);
  for (int i = 0; i < 20; ++i) {
    pass(40);
    EXPECT_STREQ(walker().ProblemOfWalk(true),
                 "left_front_knee was commanded; let go first: send zero velocities, or nothing for 500 ms");
  }
  pass(Walker::STEERING_FRAMES + 4);
  EXPECT_EQ(walker().ProblemOfWalk(true), nullptr) << "it has not steered for 500 ms";
  walk();
  EXPECT_EQ(walker().ProblemOfWalk(true), nullptr);
  joints_.StopAll();
  EXPECT_THAT(walker().ProblemOfWalk(true), HasSubstr("everything was told to hold; let go first"));
  joints_.Steer({0, 0, 0});
  EXPECT_EQ(walker().ProblemOfWalk(true), nullptr) << "it has steered with zeros";
  walk();
  joints_.Steer({0, 0, 0});
  joints_.StopAll();
  EXPECT_THAT(walker().ProblemOfWalk(true), HasSubstr("everything was told to hold; let go first")) << "zeros before";
}

TEST_F(WalkerTest, AClientWhoseWalkWasRefusedHasToLetGoToo) {
  pass(200);
  EXPECT_STREQ(walker().ProblemOfWalk(false), "the motors are off; switch them on first");
  pass(40);
  EXPECT_THAT(walker().ProblemOfWalk(true), HasSubstr("the motors were off; let go first"));
  reading_ = kOnItsSide;
  pass(100);
  EXPECT_THAT(walker().ProblemOfWalk(true), HasSubstr("the robot lies on its right side; let it stand up first"));
  reading_ = kUpright;
  for (int i = 0; i < 4; ++i) {
    pass(40);
    EXPECT_THAT(walker().ProblemOfWalk(true), HasSubstr("the robot lies on its right side"));
  }
  joints_.ClientGone();
  EXPECT_EQ(walker().ProblemOfWalk(true), nullptr) << "that is another client";
  walker().ProblemOfWalk(false);
  EXPECT_THAT(walker().ProblemOfWalk(true), HasSubstr("the motors were off; let go first"));
}

TEST_F(WalkerTest, AClientThatHasEndedItsWalkItselfMaySteerAtOnce) {
  walk();
  joints_.Steer({0, 0, 0});
  EXPECT_EQ(walker().ProblemOfWalk(true), nullptr);
  walk();
  passUntilIdle();
  EXPECT_THAT(ends(), ElementsAre("walk: it was not steered for 500 ms"));
  EXPECT_EQ(walker().ProblemOfWalk(true), nullptr);
  walk();
  joints_.Steer({0.1, 0, 0}, true);
  joints_.Steer({0, 0, 0});
  for (int i = 0; i < 3; ++i) {
    walker().HaveLooked({0.9, 2, 2, {}, {true, true, true, true}});  // no floor before its chest
  }
  EXPECT_EQ(walker().ProblemOfWalk(true), nullptr) << "what it sees while it slows down does not matter";
  joints_.Planner().SetSpeedLimit(joint("left_hind_knee"), 3000000);
  pass(1);
  EXPECT_EQ(walker().ProblemOfWalk(true), nullptr) << "nor a limit";
  joints_.Take(POSTURE_SIT);
  EXPECT_EQ(walker().ProblemOfWalk(true), nullptr) << "nor a posture";
}

TEST_F(WalkerTest, AWalkThatEndsForAPostureIsNotSteeredOn) {
  walk();
  joints_.Take(POSTURE_SIT);
  EXPECT_THAT(walker().ProblemOfWalk(true), HasSubstr("the robot was told to take a posture; let go first"));
  joints_.Steer({0, 0, 0});
  EXPECT_EQ(walker().ProblemOfWalk(true), nullptr);
}

// While it walks without the guard, nobody looks, and it may turn away from an edge.
TEST_F(WalkerTest, AfterAWalkWithoutTheGuardTheGuardKnowsNothing) {
  const Velocity ahead = {0.1, 0, 0};
  const Velocity turn = {0, 0, 0.5};
  walk();
  joints_.Steer(ahead, true);
  for (int i = 0; i < 3; ++i) {
    walker().HaveLooked({0.9, 2, 2, {}, {true, true, true, true}});  // no floor before its chest
  }
  EXPECT_THAT(walker().ProblemOfWalk(true, &turn), HasSubstr("the floor ends ahead: turn, or walk back; let go first"));
  passUntilIdle();
  EXPECT_THAT(ends(), ElementsAre(HasSubstr("the floor ends ahead")));
  joints_.Steer({0, 0, 0});
  EXPECT_STREQ(walker().ProblemOfWalk(true, &ahead), "the floor ends ahead: turn, or walk back");
  for (int i = 0; i < 3; ++i) {
    walker().HaveLooked({0.05, 2, 2, {}, {true, true, true, true}});
  }
  joints_.Steer({0, 0, 0});
  EXPECT_STREQ(walker().ProblemOfWalk(true, &ahead), "something is in the way ahead: turn, or walk back");
  EXPECT_STREQ(walker().ProblemOfWalk(true, &ahead),
               "something is in the way ahead: turn, or walk back; let go first: send zero velocities, or nothing for "
               "500 ms");
  joints_.Steer({0, 0, 0});
  const Velocity right = {0, -0.1, 0};
  const std::string longest = walker().ProblemOfWalk(true, &right);
  EXPECT_EQ(walker().ProblemOfWalk(true, &right),
            longest + "; let go first: send zero velocities, or nothing for 500 ms");
  joints_.Steer({0, 0, 0});
  walk(turn);
  joints_.Steer({0, 0, 0});
  passUntilIdle();
  EXPECT_EQ(walker().ProblemOfWalk(true, &ahead), nullptr);
  joints_.Steer(turn, true);
  walk(ahead);
  for (int i = 0; i < 3; ++i) {
    walker().HaveLooked({0.9, 2, 2, {}, {true, true, true, true}});
  }
  passUntilIdle();
  EXPECT_THAT(ends(), ElementsAre("walk: ", "walk: it was not steered for 500 ms")) << "nobody looks any more";
}

TEST_F(WalkerTest, ARobotWhosePawHasFoundNoFloorMayGoBackWhenItStands) {
  const Velocity back = {-0.05, 0, 0};
  WalkGuard::Reading reading = {0.223, 2, 2, {}, {true, true, true, true}};
  for (int i = 0; i < 200 && walker().ProblemOfWalk(true) == nullptr; ++i) {
    reading.paws[robot_model::LEFT_FRONT_LEG] = i < 150;
    joints_.Steer({0.1, 0, 0}, true);
    pass(4);
    walker().HaveLooked(reading);
  }
  EXPECT_THAT(walker().ProblemOfWalk(true, &back), HasSubstr("the left front paw finds no floor"));
  passUntilIdle();
  walker().HaveLooked(reading);
  joints_.Steer({0, 0, 0});
  EXPECT_EQ(walker().ProblemOfWalk(true, &back), nullptr);
}

TEST_F(WalkerTest, ARobotThatHasBeenSomewhereElseDoesNotKnowTheGroundAnyMore) {
  const WalkGuard::Reading no_floor = {0.9, 2, 2, {}, {true, true, true, true}};
  const Velocity ahead = {0.2, 0, 0};
  const std::pair<std::string, std::function<void()>> cases[] = {
      {"where it was", [] {}},
      {"lifted", [this] { reading_ = kInTheAir; }},
      {"fallen", [this] { reading_ = kOnItsSide; }},
      {"held", [this] { joints_.StopAll(); }},
      {"seated", [this] { take(POSTURE_SIT); }},
  };
  for (const auto& [name, change] : cases) {
    SCOPED_TRACE(name);
    walk();
    for (int i = 0; i < 3; ++i) {
      joints_.Steer(ahead, true);
      walker().HaveLooked(no_floor);
    }
    passUntilIdle();
    joints_.Steer({0, 0, 0});
    change();
    pass(80);
    walker().HaveLooked(no_floor);
    reading_ = kUpright;
    pass(80);
    take(POSTURE_STAND);
    EXPECT_EQ(walker().ProblemOfWalk(true, &ahead) != nullptr, name == "where it was");
    joints_.Steer({0, 0, 0});
  }
}

TEST_F(WalkerTest, ARestThatHasBegunIsFinishedWithoutTheClient) {
  command("head_pan", 500000);
  pass(100);
  joints_.Take(POSTURE_REST);
  pass(60);
  command("tail_tilt", 1000000);
  pass(5);
  joints_.ClientGone();
  bool wanted_motors_off = false;
  for (int i = 0; i < 1000 && walker().IsActive(); ++i) {
    pass(1);
    wanted_motors_off = walker().WantsMotorsOff();
    if (wanted_motors_off) {
      joints_.MotorsGoOff();
    }
  }
  EXPECT_TRUE(wanted_motors_off);
  EXPECT_TRUE(isIn(POSTURE_REST));
  EXPECT_EQ(position("head_pan"), 0) << "the head is level";
  EXPECT_LT(position("tail_tilt"), 500000) << "it stops at once";
  EXPECT_THAT(ends(), IsEmpty()) << "the next client has not asked for it";
  take(POSTURE_STAND);
  walk();
  joints_.Take(POSTURE_REST);
  joints_.ClientGone();
  passUntilIdle();
  EXPECT_TRUE(isIn(POSTURE_REST)) << "also after a walk";
  joints_.Take(POSTURE_STAND);
  passUntilIdle();
  EXPECT_THAT(ends(), ElementsAre("stand: ")) << "this is the next client's own";
}

TEST_F(WalkerTest, TheHeadIsLevelledForARestUnlessItIsCommandedLater) {
  command("head_pan", 500000);
  take(POSTURE_REST);
  EXPECT_EQ(position("head_pan"), 0);
  take(POSTURE_SIT);
  joints_.Take(POSTURE_REST);
  pass(10);  // it stands up first, and levels its head while it lies down
  command("head_pan", 500000);
  EXPECT_TRUE(walker().Levels(joint("head_tilt")));
  command("head_tilt", 100000);
  passUntilIdle();
  EXPECT_TRUE(isIn(POSTURE_REST));
  EXPECT_EQ(position("head_pan"), 500000);
  EXPECT_EQ(position("head_tilt"), 100000);
  EXPECT_EQ(position("neck_tilt"), -174533) << "it was not commanded, so it is levelled";
  joints_.Steer({0.1, 0, 0});
  EXPECT_FALSE(walker().Levels(joint("neck_tilt"))) << "the rest is over";
  take(POSTURE_STAND);
  walk();
  joints_.Take(POSTURE_REST);
  joints_.Steer({0.1, 0, 0});
  EXPECT_FALSE(walker().Levels(joint("neck_tilt"))) << "the rest does not follow the walk any more";
}

TEST_F(WalkerTest, TheHeadIsLeftAsALaterMotionOrHoldLeavesIt) {
  for (const auto& [name, degrees] :
       {std::pair("neck_tilt", -20), std::pair("head_pan", 20), std::pair("head_tilt", 10)}) {
    take(POSTURE_SIT);
    joints_.Take(POSTURE_REST);
    pass(10);  // it stands up first, and levels its head while it lies down
    const std::string angle = std::string(" ") + name + " " + std::to_string(degrees);
    play("at 0" + angle + "\nat 80" + angle + "\n");
    passUntilIdle();
    EXPECT_NEAR(position(name), degrees * kDegree, 100) << name;
    EXPECT_THAT(ends(), ElementsAre("HEAD.MTN: ", "rest: "));
    take(POSTURE_SIT);
    joints_.Take(POSTURE_REST);
    pass(10);
    joints_.Stop(joint(name));
    passUntilIdle();
    EXPECT_NEAR(position(name), degrees * kDegree, 100) << name << " was told to hold";
    ends();
  }
}

TEST_F(WalkerTest, APostureEndsAMotionOfTheHeadOnlyIfTheHeadHasToBeLevel) {
  const auto expectLevelHead = [this](bool is_level) {
    EXPECT_EQ(position("neck_tilt") == -174533, is_level);
    EXPECT_EQ(position("head_pan") == 0, is_level);
    EXPECT_EQ(position("head_tilt") == 0, is_level);
  };
  const std::string way = "at 0 head_pan 20 head_tilt 10\nat 800 head_pan 40 head_tilt 20\n";
  const std::string way_of_neck = "at 0 neck_tilt -20\nat 800 neck_tilt -30\n";
  play(way, 1000);
  play(way_of_neck, 1000, "NECK.MTN");
  play("at 0 tail_pan 0\nat 800 tail_pan 30\n", 1000, "TAIL.MTN");
  for (const Posture posture : {POSTURE_SIT, POSTURE_STAND}) {
    joints_.Take(posture);
    passUntilIdle();
    expectLevelHead(false);
  }
  EXPECT_THAT(ends(), ElementsAre("sit: ", "stand: "));
  joints_.Take(POSTURE_REST);
  passUntilIdle();
  expectLevelHead(true);
  const std::string replaced = ".MTN: the robot was told to walk or to take a posture";
  EXPECT_THAT(ends(), UnorderedElementsAre("HEAD" + replaced, "NECK" + replaced,
                                           "TAIL.MTN: the motors were switched off", "rest: "));
  reading_ = kOnItsSide;
  pass(100);
  play(way, 1000);
  play(way_of_neck, 1000, "NECK.MTN");
  pass(100);
  joints_.Take(POSTURE_STAND);
  pass(3 * kFramesASecond);
  expectLevelHead(true);
  EXPECT_THAT(ends(), UnorderedElementsAre("HEAD" + replaced, "NECK" + replaced)) << "it rolls over";
}

TEST_F(WalkerTest, SaysHowTheRobotIs) {
  using namespace protocol::version2;
  const auto now = [this] { return walker().Now(positions().data()); };
  EXPECT_EQ(now(), POSTURE_STAND);
  joints_.Take(POSTURE_SIT);
  bool was_unknown = false;
  for (int i = 0; i < 300; ++i) {
    pass(1);
    was_unknown = was_unknown || now() == POSTURE_UNKNOWN;
  }
  EXPECT_TRUE(was_unknown) << "on the way";
  passUntilIdle();
  EXPECT_EQ(now(), POSTURE_SIT);
  take(POSTURE_REST);
  EXPECT_EQ(now(), POSTURE_REST);
  take(POSTURE_STAND);
  walk();
  EXPECT_EQ(now(), POSTURE_WALK);
  reading_ = kInTheAir;
  pass(60);
  EXPECT_EQ(now(), POSTURE_CARRIED);
  reading_ = kOnItsSide;
  pass(80);
  EXPECT_EQ(now(), POSTURE_FALLEN);
}

TEST_F(WalkerTest, AClientThatGoesLeavesARobotThatStands) {
  walk();
  play("at 0 head_pan 0\nat 1600 head_pan 40\n");
  command("tail_tilt", 1000000);
  pass(5);
  joints_.ClientGone();
  EXPECT_TRUE(walker().IsActive());
  EXPECT_FALSE(joints_.Motions().IsPlaying());
  passUntilIdle();
  EXPECT_TRUE(isIn(POSTURE_STAND));
  EXPECT_LT(position("tail_tilt"), 500000) << "it stops at once";
  EXPECT_THAT(ends(), IsEmpty()) << "the next client has nothing to do with it";
  EXPECT_THAT(ends(EndLog::CONSOLE),
              ElementsAre("stand: ", "HEAD.MTN: the client stopped it", "walk: the client is gone"));
}

TEST_F(WalkerTest, TheNextClientHearsNothingOfTheOneBefore) {
  walk();
  joints_.Take(POSTURE_SIT);  // waits until the walk has ended
  joints_.ClientGone();
  passUntilIdle();
  EXPECT_TRUE(isIn(POSTURE_STAND)) << "the posture was the last client's";
  EXPECT_THAT(ends(), IsEmpty());
  walk();
  joints_.StopAll();  // ends it, and nobody asks for the end
  joints_.ClientGone();
  EXPECT_THAT(ends(), IsEmpty());
  walk();
  reading_ = kOnItsSide;
  pass(200);
  joints_.MotorsGoOff();
  joints_.ClientGone();
  EXPECT_FALSE(walker().TakeSoftened());
}

TEST_F(WalkerTest, TheNextClientHearsOfItsOwnOrdersAfterTheOneBeforeHasLaidTheRobotDown) {
  walk();
  joints_.Take(POSTURE_REST);  // waits until the walk has ended
  joints_.ClientGone();
  joints_.Take(POSTURE_SIT);
  passUntilIdle();
  EXPECT_TRUE(isIn(POSTURE_SIT));
  EXPECT_THAT(ends(), ElementsAre("sit: "));
  walk();
  joints_.Take(POSTURE_REST);
  joints_.ClientGone();
  steer({0.1, 0, 0}, 60);  // goes on with the walk
  joints_.StopAll();
  EXPECT_THAT(ends(), ElementsAre("walk: everything was told to hold"));
}

TEST_F(WalkerTest, AClientThatGoesEndsAPosture) {
  joints_.Take(POSTURE_SIT);
  pass(50);
  joints_.ClientGone();
  EXPECT_FALSE(walker().IsActive());
  pass(30);
  EXPECT_FALSE(joints_.AreMoving());
}

// Whatever has ended a walk, and however the legs were then, the next one is like the first.
TEST_F(WalkerTest, WalksAfterEveryEndLikeTheFirstTime) {
  const std::vector<std::string> first = traceOfAWalk();
  const std::pair<const char*, std::function<void()>> ends_of_a_walk[] = {
      {"held", [this] { joints_.StopAll(); }},
      {"a leg held", [this] { joints_.Stop(joint("left_front_knee")); }},
      {"a leg commanded", [this] { command("left_front_knee", 500000); }},
      {"motors off", [this] { joints_.MotorsGoOff(); }},
      {"a leg failed", [this] { walker().Stop(EndReason::Of(END_REFUSED, "%s does not follow", "left_front_knee")); }},
      {"fallen",
       [this] {
         reading_ = kOnItsSide;
         steer({0.15, 0, 0}, 60);
         reading_ = kUpright;
         pass(60);
       }},
      {"client gone", [this] { joints_.ClientGone(); }},
      {"client gone, and it stands",
       [this] {
         joints_.ClientGone();
         passUntilIdle();
       }},
      {"posture", [this] { joints_.Take(POSTURE_SIT); }},
      {"posture, and held in it",
       [this] {
         joints_.Take(POSTURE_SIT);
         pass(100);
         joints_.StopAll();
       }},
      {"not steered", [this] { passUntilIdle(); }},
      {"slow joint",
       [this] {
         joints_.Planner().SetSpeedLimit(joint("left_front_knee"), 3000000);
         passUntilIdle();
         joints_.Planner().SetSpeedLimit(joint("left_front_knee"),
                                         robot_.joints[joint("left_front_knee")].highest_speed);
       }},
  };
  for (const auto& [name, end] : ends_of_a_walk) {
    SCOPED_TRACE(name);
    walk({0.15, 0, 0});
    end();
    if (walker().State() == protocol::version2::WALK_STATE_WALKS) {
      steer({0, 0, 0}, 1);
      passUntilIdle();  // brakes; a walk that is steered again goes on
    }
    EXPECT_EQ(traceOfAWalk(), first);
  }
}

// It rises first, as before its first walk: the feet never move as fast as those of the walk before.
TEST_F(WalkerTest, AWalkAfterAStopBeginsWithoutTheOldVelocity) {
  walk({0.15, 0, 0});
  joints_.StopAll();
  pass(30);
  walker().TakeVelocity();
  for (int i = 0; i < 2 * kFramesASecond; ++i) {
    joints_.Steer({-0.05, 0, 0});
    pass(1);
    ASSERT_LT(walker().TakeVelocity().forward, 0.02) << i << " frames after it was steered backward";
  }
}

// ----------------------------------------------------------------------------------------------------------- postures

TEST_F(WalkerTest, TakesEveryPostureFromEveryOtherSlowly) {
  fastest_ = 0;
  for (const Posture from : {POSTURE_STAND, POSTURE_SIT, POSTURE_REST}) {
    for (const Posture to : {POSTURE_STAND, POSTURE_SIT, POSTURE_REST}) {
      take(from);
      joints_.Take(to);
      passUntilIdle();
      EXPECT_TRUE(isIn(to)) << from << " to " << to;
      EXPECT_THAT(ends(), ElementsAre(std::string(postureName(to)) + ": "));
    }
  }
  EXPECT_LT(fastest_, 1.2 * Walker::POSTURE_SPEED);
}

TEST_F(WalkerTest, RestsWithTheHeadLevelAndThenWantsTheMotorsOff) {
  command("neck_tilt", -1200000);
  pass(200);
  joints_.Take(POSTURE_REST);
  while (!isIn(POSTURE_REST)) {
    EXPECT_FALSE(walker().WantsMotorsOff());
    pass(1);
  }
  pass(4);
  EXPECT_FALSE(walker().WantsMotorsOff()) << "the joints have not followed yet";
  pass(40);
  EXPECT_TRUE(walker().WantsMotorsOff());
  EXPECT_FALSE(joints_.AreMoving());
  EXPECT_THAT(ends(), IsEmpty());
  joints_.MotorsGoOff();
  EXPECT_FALSE(walker().WantsMotorsOff());
  EXPECT_THAT(ends(), ElementsAre("rest: "));
  EXPECT_EQ(position("neck_tilt"), -174533);
}

TEST_F(WalkerTest, AWalkEndsInTheStandBeforeAPostureIsTaken) {
  walk();
  joints_.Take(POSTURE_SIT);
  while (walker().State() == protocol::version2::WALK_STATE_WALKS) {
    pass(1);
  }
  EXPECT_THAT(ends(), ElementsAre("walk: the robot was told to take a posture"));
  passUntilIdle();
  EXPECT_TRUE(isIn(POSTURE_SIT));
  EXPECT_THAT(ends(), ElementsAre("sit: "));
  walk();
  joints_.StopAll();
  EXPECT_THAT(ends(), ElementsAre("walk: everything was told to hold")) << "the posture is long over";
}

TEST_F(WalkerTest, AStopAlsoEndsAPostureThatWaitsForTheEndOfAWalk) {
  walk();
  joints_.Take(POSTURE_SIT);
  joints_.StopAll();
  EXPECT_THAT(ends(), ElementsAre("sit: everything was told to hold", "walk: everything was told to hold"));
  walk();
  joints_.Steer({0, 0, 0});
  passUntilIdle();
  EXPECT_TRUE(isIn(POSTURE_STAND));
  EXPECT_THAT(ends(), ElementsAre("walk: "));
}

TEST_F(WalkerTest, APostureThatWasReplacedIsNotTakenAfterTheNextWalk) {
  walk();
  joints_.Take(POSTURE_SIT);
  walk();
  EXPECT_THAT(ends(), ElementsAre("sit: the robot was told to walk"));
  joints_.Steer({0, 0, 0});
  passUntilIdle();
  EXPECT_TRUE(isIn(POSTURE_STAND));
  EXPECT_THAT(ends(), ElementsAre("walk: "));
}

TEST_F(WalkerTest, SteeringReplacesAPostureAndOneThatWaitsForTheWalkToEnd) {
  joints_.Take(POSTURE_SIT);
  pass(20);
  walk();
  joints_.Take(POSTURE_REST);
  pass(10);
  walk();
  EXPECT_THAT(ends(), ElementsAre("sit: the robot was told to walk", "rest: the robot was told to walk"));
  EXPECT_EQ(walker().State(), protocol::version2::WALK_STATE_WALKS);
}

TEST_F(WalkerTest, APostureReplacesAnother) {
  walk();
  joints_.Take(POSTURE_SIT);
  joints_.Take(POSTURE_STAND);
  EXPECT_THAT(ends(), ElementsAre("sit: the robot was told to take a posture")) << "one that waits, too";
  take(POSTURE_STAND);
  joints_.Take(POSTURE_SIT);
  pass(20);
  joints_.Take(POSTURE_REST);
  EXPECT_THAT(ends(), ElementsAre("sit: the robot was told to take a posture"));
}

// -------------------------------------------------------------------------------------------------------------- falls

TEST_F(WalkerTest, AFallStopsItAndTheLegsGoSoftAfterASecond) {
  walk();
  reading_ = kOnItsSide;
  steer({0.1, 0, 0}, 24);
  EXPECT_TRUE(walker().IsActive()) << "a knock";
  pass(52);
  EXPECT_FALSE(walker().IsActive());
  EXPECT_THAT(ends(), ElementsAre("walk: the robot lies on its right side"));
  EXPECT_THAT(walker().Problem(POSTURE_SIT), HasSubstr("the robot lies on its right side"));
  pass(48);
  EXPECT_FALSE(walker().GoesSoft());
  pass(24);
  EXPECT_TRUE(walker().WantsMotorsOff());
  joints_.MotorsGoOff();
  EXPECT_FALSE(walker().WantsMotorsOff());
  joints_.MotorsGoOff();
  EXPECT_TRUE(walker().TakeSoftened());
  EXPECT_FALSE(walker().TakeSoftened());
}

TEST_F(WalkerTest, LegsThatSomebodyElseHasMovedDoNotGoSoft) {
  for (const bool stands : {false, true}) {
    for (const bool moves : {false, true}) {
      walk();
      passUntilIdle(stands ? 3000 : 0);
      moves ? play("at 0 left_front_knee 60\nat 80 left_front_knee 80\n") : command("left_front_knee", 500000);
      reading_ = kOnItsSide;
      pass(400);
      EXPECT_FALSE(walker().WantsMotorsOff()) << stands << moves;
      reading_ = kUpright;
      pass(100);
    }
  }
  walk();
  reading_ = kOnItsSide;
  pass(200);
  EXPECT_TRUE(walker().WantsMotorsOff()) << "it has walked since";
}

TEST_F(WalkerTest, ARobotThatMovesAgainHasNotGoneSoft) {
  walk();
  reading_ = kOnItsSide;
  pass(200);
  joints_.MotorsGoOff();
  reading_ = kUpright;
  pass(100);
  walk();
  EXPECT_FALSE(walker().TakeSoftened()) << "nobody has asked until now";
}

TEST_F(WalkerTest, ARobotThatIsLiftedStopsAndWalksAgainOnTheFloor) {
  walk();
  reading_ = kInTheAir;
  steer({0.1, 0, 0}, 36);
  pass(30);
  EXPECT_FALSE(walker().IsActive());
  EXPECT_THAT(ends(), ElementsAre(HasSubstr("walk: the robot is carried")));
  pass(400);
  EXPECT_FALSE(walker().WantsMotorsOff());
  EXPECT_THAT(walker().Problem(POSTURE_STAND), HasSubstr("carried"));
  reading_ = kUpright;
  pass(60);
  EXPECT_EQ(walker().Problem(POSTURE_SIT), nullptr);
  walk();
  EXPECT_EQ(walker().State(), protocol::version2::WALK_STATE_WALKS);
}

// The physics tells if it gets up from that; this shows what it tries.
TEST_F(WalkerTest, ARobotThatLiesRollsOntoItsBellyAndStandsUp) {
  reading_ = kOnItsBack;
  pass(100);
  EXPECT_EQ(walker().Problem(POSTURE_STAND), nullptr);
  joints_.Take(POSTURE_STAND);
  while (joints_.Planner().Position(joint("left_front_rotator")) < 1900000) {  // it reaches past its back
    pass(1);
    ASSERT_TRUE(walker().IsActive());
  }
  reading_ = kOnItsSide;
  while (joints_.Planner().Position(joint("right_front_elevator")) < 1400000) {  // it pushes with the legs below
    pass(1);
    ASSERT_TRUE(walker().IsActive());
  }
  EXPECT_THAT(ends(), IsEmpty());
  EXPECT_TRUE(walker().TriesAnotherWay(joint("right_front_knee")));
  report();
  pass(1);
  EXPECT_LT(joints_.Planner().Target(joint("right_front_elevator")), 100000) << "it reaches out again";
  reading_ = kUpright;
  passUntilIdle();
  EXPECT_TRUE(isIn(POSTURE_STAND));
  EXPECT_THAT(ends(), ElementsAre("stand: "));
}

TEST_F(WalkerTest, ARobotThatCannotGetUpGivesUpAndGoesSoft) {
  reading_ = kOnItsSide;
  pass(100);
  joints_.Take(POSTURE_STAND);
  int frames = 0;
  int frames_still = 0;
  int most_still = 0;
  for (; walker().IsActive() && frames < 3000; ++frames) {
    const std::vector<int> before = positions();
    pass(1);
    frames_still = positions() == before ? frames_still + 1 : 0;
    most_still = std::max(most_still, frames_still);
  }
  EXPECT_GT(frames, 6 * kFramesASecond);
  EXPECT_NEAR(most_still, 45, 5) << "after it has rolled over, it lies still";
  EXPECT_THAT(ends(), ElementsAre("stand: the robot lies on its right side"));
  EXPECT_TRUE(goesSoft());
}

TEST_F(WalkerTest, ARobotThatFallsAgainWhileItStandsUpTriesAgain) {
  const auto standUp = [this](int knock, int until_knock) {
    reading_ = kOnItsSide;
    pass(100);
    joints_.Take(POSTURE_STAND);
    pass(200);
    reading_ = kUpright;
    pass(until_knock);
    reading_ = knock > 0 ? kOnItsSide : kUpright;
    pass(knock);
    reading_ = kUpright;
    return knock + until_knock + passUntilIdle();
  };
  const int frames = standUp(0, 0);
  EXPECT_THAT(ends(), ElementsAre("stand: "));
  EXPECT_EQ(standUp(24, frames - 100), frames) << "a knock";
  EXPECT_THAT(ends(), ElementsAre("stand: "));
  EXPECT_GT(standUp(80, frames - 100), frames + 100) << "a fall";
  EXPECT_THAT(ends(), ElementsAre("stand: "));
  EXPECT_TRUE(isIn(POSTURE_STAND));
  reading_ = kOnItsSide;
  pass(100);
  joints_.Take(POSTURE_STAND);
  pass(200);
  reading_ = kUpright;
  pass(frames - 300);
  while (walker().TriesAnotherWay(joint("left_hind_knee"))) {
    pass(4);
  }
  reading_ = kOnItsSide;
  EXPECT_LT(passUntilIdle(), 80) << "that was its last attempt";
  EXPECT_THAT(ends(), ElementsAre("stand: the robot lies on its right side"));
}

TEST_F(WalkerTest, ARobotThatGetsOntoItsBellyAtTheLastAttemptStandsUp) {
  reading_ = kOnItsSide;
  pass(100);
  int frames = 0;
  for (int i = 0; i < 2; ++i) {  // the second time begins as the third one will
    joints_.Take(POSTURE_STAND);
    frames = passUntilIdle();
  }
  ends();
  joints_.Take(POSTURE_STAND);
  pass(frames - 30);
  reading_ = kUpright;
  passUntilIdle();
  EXPECT_THAT(ends(), ElementsAre("stand: "));
  EXPECT_TRUE(isIn(POSTURE_STAND));
}

TEST_F(WalkerTest, AFallOnTheWayToAPostureThatBeganUprightEndsIt) {
  joints_.Take(POSTURE_SIT);
  pass(20);
  reading_ = kOnItsSide;
  pass(100);
  EXPECT_THAT(ends(), ElementsAre("sit: the robot lies on its right side"));
}

TEST_F(WalkerTest, AJointThatDoesNotFollowOnTheWayToAPostureGivesWayAFewTimes) {
  take(POSTURE_REST);
  joints_.MotorsGoOff();
  joints_.Take(POSTURE_STAND);
  pass(20);
  const int knee = joint("left_hind_knee");
  EXPECT_TRUE(walker().TriesAnotherWay(knee));
  EXPECT_FALSE(walker().TriesAnotherWay(joint("head_pan")));
  pass(2);
  EXPECT_GT(joints_.Planner().Target(joint("right_front_elevator")), 1400000) << "it spreads its legs";
  passUntilIdle();
  EXPECT_TRUE(isIn(POSTURE_STAND));
  joints_.Take(POSTURE_SIT);
  for (int i = 1; i < Walker::ATTEMPTS; ++i) {
    EXPECT_TRUE(walker().TriesAnotherWay(knee));
    pass(4);
  }
  EXPECT_FALSE(walker().TriesAnotherWay(knee));
  take(POSTURE_STAND);
  joints_.Take(POSTURE_REST);
  while (!isIn(POSTURE_REST)) {
    pass(1);
  }
  pass(4);
  EXPECT_FALSE(walker().TriesAnotherWay(knee)) << "it lies already";
  ends();
  joints_.Take(POSTURE_STAND);  // before the motors go off
  pass(80);
  const JointReading stuck = {position("left_hind_knee") + 300000, position("left_hind_knee"), -FULL_DUTY};
  for (const unsigned frame : {1000, 2000}) {
    joints_.Measured(knee, stuck, frame, true);
  }
  EXPECT_EQ(position("left_hind_knee"), stuck.position) << "it gives way";
  passUntilIdle();
  EXPECT_TRUE(isIn(POSTURE_STAND));
  EXPECT_THAT(ends(), ElementsAre("rest: the robot was told to take a posture", "stand: "));
}

TEST(WalkerOfAnotherRobotTest, CannotWalk) {
  JointControl joints(*robot_model::findRobotModel("ERS-210"));
  EXPECT_FALSE(joints.Walking().CanWalk());
  joints.NextFrame();
  EXPECT_FALSE(joints.Walking().Moves(4));
}

}  // namespace
