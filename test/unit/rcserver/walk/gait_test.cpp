#include "rcserver/walk/Gait.h"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <vector>

#include "rcserver/walk/WalkPace.h"
#include "rcserver/walk/WalkedVelocity.h"
#include "robot_model/robot_model.h"

namespace {

using protocol::version2::Velocity;
using robot_model::Leg;
using robot_model::LegAngles;

constexpr double kFrame = 0.008;  // s
constexpr Leg kLegs[] = {robot_model::LEFT_FRONT_LEG, robot_model::LEFT_HIND_LEG, robot_model::RIGHT_FRONT_LEG,
                         robot_model::RIGHT_HIND_LEG};

using Legs = std::array<LegAngles, robot_model::NUMBER_OF_LEGS>;

double angleOf(const LegAngles& angles, int number) {
  return number == 0 ? angles.rotator : number == 1 ? angles.elevator : angles.knee;
}

class GaitTest : public ::testing::Test {
 protected:
  Legs legs(double phase, const Velocity& velocity) const {
    Legs angles;
    gait_.FindPosture(phase - std::floor(phase), velocity, 1, angles.data());
    return angles;
  }

  // Velocities all around the limits, where they are farthest from 0, and within them.
  std::vector<Velocity> allowed() const {
    std::vector<Velocity> velocities;
    for (int forward = -4; forward <= 4; ++forward) {
      for (int left = -4; left <= 4; ++left) {
        for (int turn = -4; turn <= 4; ++turn) {
          const Velocity wanted = {forward * 0.085, left * 0.035, turn * 0.6};
          velocities.push_back(gait_.LimitedForLegs(wanted, wanted.forward));
        }
      }
    }
    return velocities;
  }

  const Gait gait_;
  const robot_model::RobotModel& robot_ = *robot_model::findRobotModel("ERS-7");
};

TEST_F(GaitTest, SharesTheSpeedOfTheLegsAndKeepsTheDirection) {
  const GaitParameters& gait = gait_.Parameters();
  const protocol::version2::WalkLimits& highest = gait.highest;
  const struct {
    Velocity wanted;
    Velocity limited;
  } rows[] = {
      {{1, 0, 0}, {gait.fastest, 0, 0}},
      {{-1, 0, 0}, {-highest.back, 0, 0}},
      {{0, 1, 0}, {0, highest.left, 0}},
      {{0, -1, 0}, {0, -highest.left, 0}},
      {{0, 0, 9}, {0, 0, highest.turn}},
      {{0, 0, -9}, {0, 0, -highest.turn}},
      {{0.01, -0.01, 0.1}, {0.01, -0.01, 0.1}},
      {{highest.forward, highest.left, 2 * highest.turn}, {highest.forward / 4, highest.left / 4, highest.turn / 2}},
  };
  for (const auto& row : rows) {
    const Velocity limited = gait_.Limited(row.wanted);
    EXPECT_DOUBLE_EQ(limited.forward, row.limited.forward);
    EXPECT_DOUBLE_EQ(limited.left, row.limited.left);
    EXPECT_DOUBLE_EQ(limited.turn, row.limited.turn);
  }
}

// The margin of speed is for what Walker adds when the velocity changes.
TEST_F(GaitTest, AsksNoJointForMoreThanItsLimitsInAnyAllowedWalk) {
  for (const Velocity& velocity : allowed()) {
    const double phase_of_frame = kFrame / gait_.StepAt(velocity).period;
    for (double phase = 0; phase < 1; phase += 0.004) {
      const Legs here = legs(phase, velocity);
      const Legs next = legs(phase + phase_of_frame, velocity);
      for (const Leg leg : kLegs) {
        const std::size_t i = static_cast<std::size_t>(leg);
        for (int number = 0; number < robot_model::JOINTS_OF_A_LEG; ++number) {
          const robot_model::Joint& joint =
              robot_.joints[findJointByIdentifier(robot_, legJointIdentifier(leg, number))];
          const double angle = angleOf(here[i], number);
          ASSERT_GT(angle, joint.lowest * 1e-6) << joint.name;
          ASSERT_LT(angle, joint.highest * 1e-6) << joint.name;
          ASSERT_LT(std::abs(angleOf(next[i], number) - angle) / kFrame, 0.98e-6 * joint.highest_speed)
              << joint.name << " at phase " << phase << " of " << velocity.forward << ", " << velocity.left << ", "
              << velocity.turn;
        }
        const robot_model::Coupling& coupling = robot_.couplings[i];
        ASSERT_EQ(robot_.joints[coupling.follower].identifier, legJointIdentifier(leg, 1));
        ASSERT_GT(here[i].elevator, coupledLowest(coupling, static_cast<int>(here[i].rotator * 1e6)) * 1e-6);
      }
    }
  }
}

TEST_F(GaitTest, AFastWalkLeavesRoomForLessTurning) {
  EXPECT_NEAR(gait_.Limited({0.25, 0, 0.12}).forward, 0.25, 1e-9);
  EXPECT_NEAR(gait_.LimitedInWalk({0.24, 0, -1.5}).forward, 0.24, 1e-9) << "it slows down before it turns";
  EXPECT_NEAR(gait_.LimitedInWalk({0.24, 0, -1.5}).turn, -0.15, 1e-9);
  EXPECT_DOUBLE_EQ(gait_.LimitedInWalk({0.1, 0, 1.5}).turn, gait_.Limited({0.1, 0, 1.5}).turn);
}

TEST(WalkPace, ChangesAVelocityInASecondByItsHighestValue) {
  const Gait gait;
  const protocol::version2::WalkLimits& highest = gait.Parameters().highest;
  const std::pair<Velocity, Velocity> rows[] = {{{9, 0, 0}, {highest.forward, 0, 0}},
                                                {{-9, 0, 0}, {-highest.back, 0, 0}},
                                                {{0, 9, 0}, {0, highest.left, 0}},
                                                {{0, 0, 9}, {0, 0, highest.turn}}};
  for (const auto& [wanted, most] : rows) {
    WalkPace pace(gait);
    pace.Begin();
    Legs legs;
    for (int frame = 0; frame < 25; ++frame) {
      pace.NextFrame(wanted, false, legs.data());
    }
    EXPECT_NEAR(pace.Commanded().forward, 0.2 * most.forward, 1e-9);
    EXPECT_NEAR(pace.Commanded().left, 0.2 * most.left, 1e-9);
    EXPECT_NEAR(pace.Commanded().turn, 0.2 * most.turn, 1e-9);
  }
}

constexpr bool kAllPaws[] = {true, true, true, true};
constexpr bool kNoPaws[] = {false, false, false, false};
constexpr double kSeconds = 0.032;

class WalkedVelocityTest : public ::testing::Test {
 protected:
  WalkedVelocityTest() { walked_.Begin(); }

  void report(const Legs& legs, const bool* paws, unsigned frames = 4, double unseen = 0) {
    frame_ += frames;
    walked_.Measured(legs.data(), paws, frame_, unseen);
  }

  static Legs swungBy(double rotator) {
    Legs legs{};
    for (LegAngles& leg : legs) {
      leg.rotator = rotator;
    }
    return legs;
  }

  /// Of the shoulders over the floor: a leg whose foot rolls turns about the point where the foot touches the floor.
  static double heightOf(const Legs& legs) {
    return robot_model::FOOT_RADIUS - findFoot(robot_model::LEFT_FRONT_LEG, legs[0]).z;
  }

  WalkedVelocity walked_;
  unsigned frame_ = 0;
};

TEST_F(WalkedVelocityTest, IsThatOfABodyOnFeetThatRoll) {
  constexpr double kSwing = 0.02;
  report(swungBy(kSwing / 2), kAllPaws);
  report(swungBy(-kSwing / 2), kAllPaws);
  EXPECT_NEAR(walked_.Now().forward, heightOf(swungBy(0)) * kSwing / kSeconds, 1e-3);
  EXPECT_NEAR(walked_.Now().left, 0, 1e-9);
  EXPECT_NEAR(walked_.Now().turn, 0, 1e-9);
}

TEST_F(WalkedVelocityTest, WithoutPawsTheLowerPairCounts) {
  Legs legs = swungBy(0);
  legs[robot_model::LEFT_HIND_LEG].knee = legs[robot_model::RIGHT_FRONT_LEG].knee = 1;  // it lifts these two
  report(legs, kNoPaws);
  legs[robot_model::LEFT_FRONT_LEG].rotator = legs[robot_model::RIGHT_HIND_LEG].rotator = -0.01;
  legs[robot_model::LEFT_HIND_LEG].rotator = legs[robot_model::RIGHT_FRONT_LEG].rotator = 0.1;
  report(legs, kNoPaws);
  const double speed = walked_.Now().forward;
  EXPECT_NEAR(speed, heightOf(swungBy(0)) * 0.01 / kSeconds, 1e-3);
  legs = swungBy(0.2);
  legs[robot_model::LEFT_FRONT_LEG].knee = legs[robot_model::RIGHT_HIND_LEG].knee = 1;
  report(legs, kNoPaws, 4, 0.1);
  EXPECT_EQ(walked_.Now().forward, speed) << "with nothing added to it";
}

TEST_F(WalkedVelocityTest, IsTheAverageOfTheReportsSinceTheLastTime) {
  report(swungBy(0.01), kAllPaws);
  report(swungBy(0), kAllPaws);
  report(swungBy(0), kAllPaws);
  EXPECT_NEAR(walked_.Take(true).forward, heightOf(swungBy(0)) * 0.01 / kSeconds / 2, 1e-3);
  EXPECT_EQ(walked_.Take(true).forward, 0) << "the last report's";
  EXPECT_TRUE(walked_.Take(false).isZero());
}

}  // namespace
