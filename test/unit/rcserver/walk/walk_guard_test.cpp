#include "rcserver/walk/WalkGuard.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace {

using protocol::version2::Velocity;
using robot_model::LegAngles;
using robot_model::NUMBER_OF_LEGS;
using ::testing::HasSubstr;

constexpr double kNothing = 2;  // m; more than any sensor measures

class WalkGuardTest : public ::testing::Test {
 protected:
  // What the sensors measure on a level floor without anything on it, with the head upright.
  static WalkGuard::Reading onFloor() { return {0.223, kNothing, kNothing, {}, {true, true, true, true}}; }

  static WalkGuard::Reading atEdge() {
    WalkGuard::Reading reading = onFloor();
    reading.chest = 0.9;
    return reading;
  }

  static WalkGuard::Reading beforeWall(double distance) {
    WalkGuard::Reading reading = onFloor();
    reading.near = distance;
    return reading;
  }

  void look(const WalkGuard::Reading& reading, int reports = 3) {
    LegAngles legs[NUMBER_OF_LEGS];
    gait_.FindPosture(0, {0, 0, 0}, 0, legs);
    for (int i = 0; i < reports; ++i) {
      guard_.Look(reading, legs, 0, nullptr);
    }
  }

  // Reports come every 4 frames.
  void walk(const Velocity& velocity, double seconds, const WalkGuard::Reading& reading = onFloor()) {
    for (int frame = 0; frame < seconds / 0.008; ++frame) {
      const StepParameters step = gait_.StepAt(velocity);
      phase_ += 0.008 / step.period;
      phase_ -= std::floor(phase_);
      if (frame % 4 == 0) {
        LegAngles legs[NUMBER_OF_LEGS];
        gait_.FindPosture(phase_, velocity, 1, legs);
        guard_.HaveWalked(velocity, velocity, 4);
        guard_.Look(reading, legs, phase_, &step);
      }
    }
  }

  std::string objection(const Velocity& velocity) const {
    const char* const text = guard_.Objection(velocity);
    return text == nullptr ? "" : text;
  }

  // Walks until the guard objects. Returns how far the robot gets, and comes to rest after the time to stop.
  double wayUntil(const char* expected, const Velocity& velocity) {
    int reports = 0;
    while (objection(velocity).empty() && reports < 10000) {
      walk(velocity, 0.032);
      ++reports;
    }
    EXPECT_THAT(objection(velocity), HasSubstr(expected));
    return std::hypot(velocity.forward, velocity.left) * (0.032 * reports + kTimeToStop);
  }

  static constexpr double kTimeToStop = 0.73;  // s; 0.23 until the legs react, and half of the second of slowing down
  const Gait gait_;
  WalkGuard guard_{gait_};
  double phase_ = 0;
  const Velocity kForward{0.1, 0, 0};
  const Velocity kBack{-0.05, 0, 0};
  const Velocity kLeft{0, 0.03, 0};
  const Velocity kTurn{0, 0, 0.5};
};

// Distances in m, angles in radian.
struct Seen {
  const char* what;
  double chest;
  double near;
  double head_pan;
  double neck_tilt;
  double head_tilt;
  const char* objection;  // to walking ahead
};

TEST_F(WalkGuardTest, TheRobotWalksAheadByWhatItsSensorsSee) {
  const char* const kNone = "";
  const char* const kFloorEnds = "the floor ends ahead: turn, or walk back";
  const char* const kInTheWay = "something is in the way ahead: turn, or walk back";
  const Seen rows[] = {
      {"a level floor", 0.223, kNothing, 0, 0, 0, kNone},
      {"an edge", 0.9, kNothing, 0, 0, 0, kFloorEnds},
      {"a step of 7 cm", 0.36, kNothing, 0, 0, 0, kFloorEnds},
      {"a body that leans back by 10 degrees", 0.32, kNothing, 0, 0, 0, kNone},
      {"a body that leans ahead by 8 degrees", 0.18, kNothing, 0, 0, 0, kNone},
      {"no chest sensor", 0, kNothing, 0, 0, 0, kNone},
      {"something low", 0.1, kNothing, 0, 0, 0, kInTheWay},
      {"a wall at 5 cm", 0.223, 0.05, 0, 0, 0, kInTheWay},
      {"a wall at 15 cm", 0.223, 0.15, 0, 0, 0, kNone},
      {"a wall to the left", 0.223, 0.05, 1.2, 0, 0, kNone},
      {"the floor, with the neck down", 0.223, 0.1, 0, -1, -0.2, kNone},
      {"something over the head", 0.223, 0.3, 0, 0, 0.7, kNone},
  };
  for (const Seen& row : rows) {
    WalkGuard::Reading reading = onFloor();
    reading.chest = row.chest;
    reading.near = row.near;
    reading.head.head_pan = row.head_pan;
    reading.head.neck_tilt = row.neck_tilt;
    reading.head.head_tilt = row.head_tilt;
    guard_.Forget();
    look(onFloor());
    look(reading, 2);
    EXPECT_EQ(objection(kForward), "") << row.what << ", seen twice";
    look(reading, 1);
    EXPECT_EQ(objection(kForward), row.objection) << row.what;
    EXPECT_EQ(objection(kTurn), "") << row.what;
  }
}

TEST_F(WalkGuardTest, BeforeAnEdgeTheRobotMayTurnAndWalkBackTheWayItCame) {
  walk(kForward, 3);
  look(atEdge());
  EXPECT_THAT(objection(kForward), HasSubstr("the floor ends ahead"));
  EXPECT_THAT(objection({0.05, 0, 0.5}), HasSubstr("the floor ends ahead"));
  EXPECT_EQ(objection(kTurn), "");
  EXPECT_EQ(objection(kBack), "");
  walk(kBack, 4);
  look(onFloor());
  EXPECT_EQ(objection(kForward), "") << "the edge is far away now";
}

TEST_F(WalkGuardTest, TheRobotStopsFiveCentimetresBeforeAWall) {
  const double braking = gait_.Parameters().highest.forward;  // in a second from its highest velocity
  for (const double distance : {0.12, 0.2, 0.3, 0.4}) {
    look(beforeWall(distance));
    const double highest = guard_.HighestForward();
    EXPECT_NEAR(highest * 0.23 + highest * highest / (2 * braking), distance - 0.05, 1e-6) << distance;
  }
  look(beforeWall(0.3), 2);
  look(onFloor(), 1);
  look(beforeWall(0.1), 2);
  EXPECT_GT(guard_.HighestForward(), 1) << "two reports are no wall";
  WalkGuard::Reading reading = onFloor();
  reading.far = 1;
  look(reading);
  EXPECT_LT(guard_.HighestForward(), 1) << "the other sensor sees it from farther away";
  for (const double chest : {0.16, 0.185}) {  // 0.7 and 0.8 times the way to the floor
    reading = onFloor();
    reading.chest = chest;
    look(reading);
    EXPECT_EQ(guard_.HighestForward() < 1, chest == 0.16) << chest;
  }
}

TEST_F(WalkGuardTest, ItStopsFourCentimetresBeyondTheGroundThatItRemembers) {
  EXPECT_NEAR(wayUntil("it cannot see there", kLeft), 0.04, 0.004);
  guard_.Forget();
  walk(kForward, 5);
  EXPECT_NEAR(wayUntil("it cannot see there", kBack), 0.5 + 0.04, 0.005);
  guard_.Forget();
  walk(kForward, 30);
  EXPECT_NEAR(wayUntil("it cannot see there", kBack), 48 * 0.0224 + 0.04, 0.03) << "a pose every 7 reports";
}

TEST_F(WalkGuardTest, ItStopsFiveCentimetresBeforeAnEdgeThatItRemembers) {
  LegAngles legs[NUMBER_OF_LEGS];
  gait_.FindPosture(0, {0, 0, 0}, 0, legs);
  const double toes = findFoot(robot_model::LEFT_FRONT_LEG, legs[robot_model::LEFT_FRONT_LEG]).x + 0.04;
  const StepParameters stance = gait_.StepAt({0, 0, 0});
  const double sensor = stance.height - 0.0034 - 0.109 * std::sin(stance.nose_down);
  const double edge = 0.109 + 0.866 * sensor / std::sin(M_PI / 6 + stance.nose_down);  // where the sensor looks
  look(atEdge());
  look(onFloor());
  EXPECT_NEAR(wayUntil("the floor ends there", kForward), edge - toes - 0.05, 0.007);
  walk(kForward, 0.63);  // so that 6 cm are left
  for (const int side : {-1, 1}) {
    EXPECT_EQ(objection({0, 0, side * 0.2}), "");
    EXPECT_EQ(objection({0, 0, side * 0.6}), "the floor ends there") << "it turns a corner to the edge";
  }
  guard_.Forget();
  look(atEdge());
  walk(kTurn, 4.2);
  look(atEdge(), 100);
  look(onFloor());
  for (const double turn : {-0.5, 0.5}) {  // from the second edge to the first one
    EXPECT_NEAR(wayUntil("the floor ends there", kForward), edge - toes - 0.05, 0.012) << turn;
    walk({-0.1, 0, 0}, 0.5);
    walk({0, 0, turn}, 4.2);
  }
}

TEST_F(WalkGuardTest, APawThatFindsNoFloorEndsTheWalkAndIsNamed) {
  const char* const names[NUMBER_OF_LEGS] = {"left front", "left hind", "right front", "right hind"};
  for (int leg = 0; leg < NUMBER_OF_LEGS; ++leg) {
    guard_.Forget();
    walk(kForward, 3);
    EXPECT_EQ(objection(kForward), "");
    WalkGuard::Reading reading = onFloor();
    reading.paws[leg] = false;
    walk(kForward, 1, reading);
    EXPECT_THAT(objection(kForward), HasSubstr("the " + std::string(names[leg]) + " paw finds no floor"));
    look(onFloor());
    EXPECT_EQ(objection(kBack).empty(), isFront(static_cast<robot_model::Leg>(leg))) << "when it stands";
  }
}

TEST_F(WalkGuardTest, APawIsBelievedAfterFourSteps) {
  const double period = gait_.StepAt(kForward).period;
  for (int steps = 1; steps <= 6; ++steps) {
    guard_.Forget();
    phase_ = 0;
    WalkGuard::Reading reading = onFloor();
    std::fill(std::begin(reading.paws), std::end(reading.paws), true);
    walk(kForward, steps * period, reading);
    std::fill(std::begin(reading.paws), std::end(reading.paws), false);
    walk(kForward, 1.5 * period, reading);
    EXPECT_EQ(objection(kForward) != "", steps >= 3) << steps << " and a part of the next";
  }
}

}  // namespace
