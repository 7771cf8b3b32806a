#include "rcserver/walk/Gait.h"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <vector>

#include "robot_model/robot_model.h"

namespace {

using protocol::version2::Velocity;
using robot_model::Leg;
using robot_model::LegAngles;
using robot_model::Point;

constexpr double kFrame = 0.008;  // s
constexpr Leg kLegs[] = {robot_model::LEFT_FRONT_LEG, robot_model::LEFT_HIND_LEG, robot_model::RIGHT_FRONT_LEG,
                         robot_model::RIGHT_HIND_LEG};

using Legs = std::array<LegAngles, robot_model::NUMBER_OF_LEGS>;

double angleOf(const LegAngles& angles, int number) {
  return number == 0 ? angles.rotator : number == 1 ? angles.elevator : angles.knee;
}

class GaitTest : public ::testing::Test {
 protected:
  Legs legs(double phase, const Velocity& velocity, double effort = 1) const {
    Legs angles;
    gait_.FindPosture(phase - std::floor(phase), velocity, effort, angles.data());
    return angles;
  }

  // A foot seen from the floor below the body: without the body's lean.
  Point foot(Leg leg, double phase, const Velocity& velocity, double effort = 1) const {
    const Point in_body = findFoot(leg, legs(phase, velocity, effort)[static_cast<std::size_t>(leg)]);
    const StepParameters step = gait_.StepAt(velocity);
    const double sine = std::sin(step.nose_down);
    const double cosine = std::cos(step.nose_down);
    return {in_body.x * cosine + in_body.z * sine, in_body.y,
            in_body.z * cosine - in_body.x * sine + step.height - robot_model::FOOT_RADIUS};
  }

  // Where a foot on the floor is on average, seen from the floor.
  static Point middleOf(Leg leg, const StepParameters& step) {
    Point middle = findShoulder(leg);
    middle.x += isFront(leg) ? step.front_ahead : step.hind_ahead;
    middle.y += (isLeft(leg) ? 1 : -1) * (isFront(leg) ? step.front_outward : step.hind_outward);
    return middle;
  }

  // Velocities all around the limits, where they are farthest from 0, and within them.
  std::vector<Velocity> allowed() const {
    std::vector<Velocity> velocities;
    for (int forward = -4; forward <= 4; ++forward) {
      for (int left = -4; left <= 4; ++left) {
        for (int turn = -4; turn <= 4; ++turn) {
          velocities.push_back(gait_.LimitedForLegs({forward * 0.07, left * 0.035, turn * 0.6}));
        }
      }
    }
    return velocities;
  }

  const Gait gait_;
  const StepParameters in_place_ = gait_.Parameters().in_place;
  const robot_model::RobotModel& robot_ = *robot_model::findRobotModel("ERS-7");
};

TEST_F(GaitTest, StandsLevelOnAllFeetWithoutVelocityAndEffortWhateverThePhaseIs) {
  for (const double phase : {0.0, 0.2, 0.6, 0.9}) {
    for (const Leg leg : kLegs) {
      const Point place = foot(leg, phase, {0, 0, 0}, 0);
      EXPECT_NEAR(place.z, 0, 1e-9);
      EXPECT_NEAR(place.x, foot(leg, 0, {0, 0, 0}, 0).x, 1e-9);
    }
  }
}

TEST_F(GaitTest, MovesFeetOnTheFloorWithTheFloor) {
  const Velocity velocity = gait_.Limited({0.05, 0.02, 0.3});
  const StepParameters step = gait_.StepAt(velocity);
  const double phase_of_frame = kFrame / step.period;
  for (const Leg leg : kLegs) {
    for (double phase = 0; phase < 1; phase += 0.01) {
      if (!Gait::IsOnFloor(step, leg, phase) || !Gait::IsOnFloor(step, leg, std::fmod(phase + phase_of_frame, 1))) {
        continue;
      }
      const Point here = foot(leg, phase, velocity);
      const Point next = foot(leg, phase + phase_of_frame, velocity);
      const Point middle = middleOf(leg, step);
      EXPECT_NEAR((next.x - here.x) / kFrame, -velocity.forward + velocity.turn * middle.y, 1e-6);
      EXPECT_NEAR((next.y - here.y) / kFrame, -velocity.left - velocity.turn * middle.x, 1e-6);
      EXPECT_NEAR(here.z, 0, 1e-9);
    }
  }
}

TEST_F(GaitTest, AlwaysHasADiagonalPairOnTheFloor) {
  for (double phase = 0; phase < 1; phase += 0.001) {
    const bool first = Gait::IsOnFloor(in_place_, robot_model::LEFT_FRONT_LEG, phase);
    const bool second = Gait::IsOnFloor(in_place_, robot_model::RIGHT_FRONT_LEG, phase);
    EXPECT_TRUE(first || second) << phase;
    EXPECT_EQ(Gait::IsOnFloor(in_place_, robot_model::RIGHT_HIND_LEG, phase), first);
    EXPECT_EQ(Gait::IsOnFloor(in_place_, robot_model::LEFT_HIND_LEG, phase), second);
  }
}

TEST_F(GaitTest, LiftsEachFootAsHighAsTheEffortSays) {
  for (const double effort : {1.0, 0.4}) {
    for (const Leg leg : kLegs) {
      double highest = 0;
      for (double phase = 0; phase < 1; phase += 0.001) {
        highest = std::max(highest, foot(leg, phase, {0.1, 0, 0}, effort).z);
      }
      const StepParameters step = gait_.StepAt({0.1, 0, 0});
      EXPECT_NEAR(highest, effort * (isFront(leg) ? step.front_lift : step.hind_lift), 1e-4);
    }
  }
}

TEST_F(GaitTest, ShiftsAllFeetAsFarAsTheEffortSays) {
  for (const double effort : {1.0, 0.4}) {
    Legs shifted;
    gait_.FindPosture(0.3, {0.1, 0, 0.1}, effort, shifted.data(), {0.01, -0.005, 0});
    for (const Leg leg : kLegs) {
      const std::size_t i = static_cast<std::size_t>(leg);
      const Point from = findFoot(leg, legs(0.3, {0.1, 0, 0.1}, effort)[i]);
      const Point to = findFoot(leg, shifted[i]);
      EXPECT_NEAR(to.x - from.x, effort * 0.01, 1e-4);
      EXPECT_NEAR(to.y - from.y, effort * -0.005, 1e-4);
    }
  }
}

// A foot that touches down slower or faster than the floor drags or brakes the robot.
TEST_F(GaitTest, NeitherJumpsNorKinksWhereAFootLiftsOffAndTouchesDown) {
  constexpr double kStep = 1e-4;
  const Velocity velocity = gait_.Limited({0.1, 0, 0.2});
  for (const Leg leg : kLegs) {
    for (double phase = 0; phase < 1; phase += kStep) {
      const Point before = foot(leg, phase - kStep, velocity);
      const Point here = foot(leg, phase, velocity);
      const Point after = foot(leg, phase + kStep, velocity);
      const double seconds = kStep * gait_.StepAt(velocity).period;
      ASSERT_NEAR((after.x - here.x) / seconds, (here.x - before.x) / seconds, 1e-3) << phase;
      ASSERT_NEAR((after.z - here.z) / seconds, (here.z - before.z) / seconds, 1e-3) << phase;
    }
  }
}

TEST_F(GaitTest, LimitsEachVelocity) {
  const GaitParameters& parameters = gait_.Parameters();
  EXPECT_DOUBLE_EQ(gait_.Limited({1, 0, 0}).forward, parameters.fastest);
  EXPECT_DOUBLE_EQ(gait_.Limited({-1, 0, 0}).forward, -parameters.highest.back);
  EXPECT_DOUBLE_EQ(gait_.StepAt({-parameters.highest.back, 0, 0}).period, parameters.back.period);
  EXPECT_DOUBLE_EQ(gait_.Limited({0, 1, 0}).left, parameters.highest.left);
  EXPECT_DOUBLE_EQ(gait_.Limited({0, 0, -9}).turn, -parameters.highest.turn);
  EXPECT_DOUBLE_EQ(gait_.Limited({0.01, -0.01, 0.1}).left, -0.01) << "within the limits";
}

TEST_F(GaitTest, SharesTheLegsSpeedAmongVelocitiesAndKeepsTheDirection) {
  const GaitParameters& parameters = gait_.Parameters();
  const Velocity limited =
      gait_.Limited({parameters.highest.forward, parameters.highest.left, 2 * parameters.highest.turn});
  EXPECT_DOUBLE_EQ(limited.forward, parameters.highest.forward / 4);
  EXPECT_DOUBLE_EQ(limited.left, parameters.highest.left / 4);
  EXPECT_DOUBLE_EQ(limited.turn, parameters.highest.turn / 2);
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

TEST_F(GaitTest, NoJointComesNearItsSpeedInAnyFastWalk) {
  for (double forward = 0.15; forward <= 0.34; forward += 0.01) {
    for (const double turn : {-0.5, -0.2, 0.0}) {
      const Velocity velocity = gait_.LimitedForLegs({forward, 0.2 * turn, turn});
      const double phase_of_frame = kFrame / gait_.StepAt(velocity).period;
      for (double phase = 0; phase < 1; phase += 0.01) {
        const Legs here = legs(phase, velocity);
        const Legs next = legs(phase + phase_of_frame, velocity);
        for (const Leg leg : kLegs) {
          const std::size_t i = static_cast<std::size_t>(leg);
          ASSERT_LT(std::abs(next[i].rotator - here[i].rotator) / kFrame, 0.95 * 4.865) << forward << " " << turn;
          ASSERT_LT(std::abs(next[i].knee - here[i].knee) / kFrame, 0.95 * 5.279) << forward << " " << turn;
        }
      }
    }
  }
}

TEST_F(GaitTest, ChangesSmoothlyFromTheTrotToWaves) {
  for (double forward = 0.1; forward < 0.34; forward += 0.001) {
    EXPECT_NEAR(gait_.StepAt({forward, 0, 0}).period, gait_.StepAt({forward + 0.001, 0, 0}).period, 0.001);
    for (double phase = 0; phase < 1; phase += 0.05) {
      const Legs slower = legs(phase, {forward, 0, 0});
      const Legs faster = legs(phase, {forward + 0.001, 0, 0});
      for (std::size_t i = 0; i < slower.size(); ++i) {
        for (int number = 0; number < robot_model::JOINTS_OF_A_LEG; ++number) {
          ASSERT_NEAR(angleOf(slower[i], number), angleOf(faster[i], number), 0.006) << forward;
        }
      }
    }
  }
}

TEST_F(GaitTest, IsTheSameOnTheOtherSideHalfAPeriodLater) {
  for (const double forward : {0.1, 0.2, 0.3}) {
    for (double phase = 0; phase < 1; phase += 0.1) {
      const Legs here = legs(phase, {forward, 0.005, 0.05});
      const Legs later = legs(phase + 0.5, {forward, -0.005, -0.05});
      for (const Leg leg : {robot_model::LEFT_FRONT_LEG, robot_model::LEFT_HIND_LEG}) {
        for (int number = 0; number < robot_model::JOINTS_OF_A_LEG; ++number) {
          EXPECT_NEAR(angleOf(here[leg], number), angleOf(later[leg + 2], number), 1e-9);
        }
      }
    }
  }
}

TEST_F(GaitTest, LiftsFeetInWavesTooButNotWithoutEffort) {
  for (const Leg leg : kLegs) {
    double highest = -1;
    double lowest = 1;
    for (double phase = 0; phase < 1; phase += 0.01) {
      const double height = foot(leg, phase, {0.3, 0, 0}).z;
      highest = std::max(highest, height);
      lowest = std::min(lowest, height);
      EXPECT_NEAR(foot(leg, phase, {0.3, 0, 0}, 0).z, 0, 1e-9);
    }
    EXPECT_GT(highest - lowest, 0.015);
  }
}

}  // namespace
