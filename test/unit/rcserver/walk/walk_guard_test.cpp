#include "rcserver/walk/WalkGuard.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>

namespace {

using protocol::version2::Velocity;
using robot_model::LegAngles;
using robot_model::NUMBER_OF_LEGS;
using ::testing::HasSubstr;
using ::testing::IsNull;

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

  void look(const WalkGuard::Reading& reading, int reports = 3, const Gait& gait = Gait()) {
    LegAngles legs[NUMBER_OF_LEGS];
    gait.FindPosture(0, {0, 0, 0}, 0, legs);
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

TEST_F(WalkGuardTest, WithoutAnEdgeOrAWallTheRobotMayWalkAheadAndTurn) {
  look(onFloor());
  EXPECT_EQ(objection(kForward), "");
  EXPECT_EQ(objection(kTurn), "");
  EXPECT_GT(guard_.HighestForward(), 1);
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

TEST_F(WalkGuardTest, OneMeasurementIsNoEdge) {
  look(atEdge(), 2);
  look(onFloor(), 1);
  look(atEdge(), 2);
  EXPECT_EQ(objection(kForward), "");
}

TEST_F(WalkGuardTest, ALeaningBodyMakesTheWayToTheFloorLongerAndIsNoEdge) {
  WalkGuard::Reading reading = onFloor();
  reading.chest = 0.32;  // 10 degrees nose up
  look(reading);
  EXPECT_EQ(objection(kForward), "");
  reading.chest = 0.18;  // 8 degrees nose down
  look(reading);
  EXPECT_EQ(objection(kForward), "");
  reading.chest = 0.36;  // a step of 7 cm
  look(reading);
  EXPECT_THAT(objection(kForward), HasSubstr("the floor ends ahead"));
}

TEST_F(WalkGuardTest, AFootInTheAirIsNotWhereTheFloorIs) {
  for (int leg = 0; leg < NUMBER_OF_LEGS; ++leg) {
    LegAngles legs[NUMBER_OF_LEGS];
    gait_.FindPosture(0, {0, 0, 0}, 0, legs);
    robot_model::Point foot = findFoot(static_cast<robot_model::Leg>(leg), legs[leg]);
    foot.z += 0.03;
    findLegAngles(static_cast<robot_model::Leg>(leg), foot, &legs[leg]);
    for (const double chest : {0.32, 0.36}) {
      WalkGuard::Reading reading = onFloor();
      reading.chest = chest;
      guard_.Forget();
      for (int i = 0; i < 3; ++i) {
        guard_.Look(reading, legs, 0, nullptr);
      }
      EXPECT_EQ(objection(kForward).empty(), chest == 0.32) << leg;
    }
  }
}

TEST_F(WalkGuardTest, TheLegsSayHowFarTheFloorShouldBe) {
  GaitParameters high;
  high.in_place.nose_down = -0.2;  // looks farther ahead
  WalkGuard::Reading reading = onFloor();
  reading.chest = 0.40;
  look(reading, 3, Gait(high));
  EXPECT_EQ(objection(kForward), "");
}

TEST_F(WalkGuardTest, AReportThatLooksTooFarAheadSeparatesTheOthers) {
  GaitParameters high;
  high.in_place.nose_down = -0.35;
  look(atEdge(), 2);
  look(atEdge(), 1, Gait(high));
  look(atEdge(), 2);
  EXPECT_EQ(objection(kForward), "");
}

TEST_F(WalkGuardTest, WithoutAChestSensorThereIsNoEdge) {
  WalkGuard::Reading reading = onFloor();
  reading.chest = 0;
  look(reading);
  EXPECT_EQ(objection(kForward), "");
}

TEST_F(WalkGuardTest, BeforeAWallTheRobotSlowsDownAndStops) {
  double before = 1;
  for (double distance = 0.3; distance > 0.14; distance -= 0.02) {
    look(beforeWall(distance));
    EXPECT_EQ(objection(kForward), "") << distance;
    EXPECT_LT(guard_.HighestForward(), before) << distance;
    before = guard_.HighestForward();
  }
  look(beforeWall(0.05));
  EXPECT_THAT(objection(kForward), HasSubstr("something is in the way ahead"));
  EXPECT_EQ(objection(kTurn), "");
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
}

TEST_F(WalkGuardTest, OnlyWhatTheBodyOrTheHeadWouldHitIsInTheWay) {
  const robot_model::Point ahead = {0.0769 + 0.4, 0.0028, -0.0146};  // of the sensor
  for (double pan = -0.6; pan < 0.6; pan += 0.03) {
    for (double tilt = 0; tilt < 0.7; tilt += 0.05) {
      WalkGuard::Reading reading = beforeWall(0.4);
      reading.head.head_pan = pan;
      reading.head.head_tilt = tilt;
      look(reading);
      const robot_model::Point place = findInBody(ahead, reading.head);
      EXPECT_EQ(guard_.HighestForward() < 1, std::abs(place.y) < 0.11 && place.z < 0.15) << pan << " " << tilt;
    }
  }
}

TEST_F(WalkGuardTest, TheHeadSpeaksForTheWayAheadOnlyIfItLooksThere) {
  WalkGuard::Reading reading = beforeWall(0.1);
  reading.head.head_pan = 1.2;
  look(reading);
  EXPECT_EQ(objection(kForward), "") << "it looks to the left";
  reading.head.head_pan = 0;
  reading.head.head_tilt = -0.2;
  reading.head.neck_tilt = -1;
  look(reading);
  EXPECT_EQ(objection(kForward), "") << "it sees the floor";
  reading.head.neck_tilt = 0;
  reading.head.head_tilt = 0.7;
  reading.near = 0.3;
  look(reading);
  EXPECT_EQ(objection(kForward), "") << "it sees something over its head";
}

TEST_F(WalkGuardTest, TheChestSeesWhatIsCloserThanTheFloor) {
  WalkGuard::Reading reading = onFloor();
  reading.chest = 0.1;
  look(reading);
  EXPECT_THAT(objection(kForward), HasSubstr("something is in the way ahead"));
}

TEST_F(WalkGuardTest, BackAndSidewaysItWalksOnlyWhereItHasJustWalked) {
  look(onFloor());
  EXPECT_EQ(objection(kLeft), "") << "a little is allowed";
  walk(kLeft, 1);
  EXPECT_THAT(objection(kLeft), HasSubstr("no sensor looks there"));
  EXPECT_THAT(objection({0.1, 0.06, 0}), HasSubstr("no sensor looks there"));
  EXPECT_THAT(objection({-0.1, 0, 0}), HasSubstr("no sensor looks there"));
  EXPECT_EQ(objection({0, -0.06, 0}), "") << "back to where it was";
  guard_.Forget();
  walk(kForward, 3);
  EXPECT_EQ(objection(kBack), "");
  walk(kBack, 3);
  EXPECT_EQ(objection(kBack), "") << "half of the way";
  walk(kBack, 4);
  EXPECT_THAT(objection(kBack), HasSubstr("no sensor looks there")) << "it is where it began";
}

TEST_F(WalkGuardTest, ItStopsFourCentimetresBeyondTheGroundThatItRemembers) {
  EXPECT_NEAR(wayUntil("no sensor looks there", kLeft), 0.04, 0.004);
  guard_.Forget();
  walk(kForward, 5);
  EXPECT_NEAR(wayUntil("no sensor looks there", kBack), 0.5 + 0.04, 0.005);
  guard_.Forget();
  walk(kForward, 30);
  EXPECT_NEAR(wayUntil("no sensor looks there", kBack), 48 * 0.0224 + 0.04, 0.03) << "a pose every 7 reports";
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

// It sees more than it can remember while it turns by two thirds.
TEST_F(WalkGuardTest, TheOldestEdgesAreForgotten) {
  walk(kTurn, 8.4, atEdge());
  look(onFloor());
  wayUntil("the floor ends there", kForward);
  guard_.HaveWalked({-0.1, 0, 0}, kForward, 63);
  walk(kTurn, 4.17);
  walk(kForward, 2);
  EXPECT_EQ(objection(kForward), "") << "where it began";
}

// What holds for one side holds for the other.
TEST_F(WalkGuardTest, LeftAndRightAreAlike) {
  WalkGuard mirrored(gait_);
  const auto mirror = [](const Velocity& velocity) {
    return Velocity{velocity.forward, -velocity.left, -velocity.turn};
  };
  LegAngles legs[NUMBER_OF_LEGS];
  gait_.FindPosture(0, {0, 0, 0}, 0, legs);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> share(-1, 1);
  int objections = 0;
  for (int walk = 0; walk < 200; ++walk) {
    const Velocity velocity = {0.1 * share(random), 0.05 * share(random), share(random)};
    for (int report = 0; report < 10; ++report) {
      guard_.HaveWalked(velocity, velocity, 4);
      mirrored.HaveWalked(mirror(velocity), mirror(velocity), 4);
      for (WalkGuard* guard : {&guard_, &mirrored}) {
        guard->Look(walk % 20 == 19 ? atEdge() : onFloor(), legs, 0, nullptr);
      }
      const Velocity wanted = {0.1 * share(random), 0.05 * share(random), share(random)};
      EXPECT_EQ(guard_.Objection(wanted), mirrored.Objection(mirror(wanted)));
      objections += guard_.Objection(wanted) != nullptr ? 1 : 0;
    }
  }
  EXPECT_GT(objections, 100);
  EXPECT_LT(objections, 1900);
}

TEST_F(WalkGuardTest, FromUnknownGroundItMayComeBack) {
  walk(kLeft, 6);  // in spite of all objections
  EXPECT_THAT(objection(kLeft), HasSubstr("no sensor looks there"));
  EXPECT_EQ(objection({0, -0.03, 0}), "");
}

TEST_F(WalkGuardTest, ElsewhereItKnowsNoGround) {
  const Velocity right = {0, -0.06, 0};
  walk(kForward, 3);
  walk({-0.1, 0, 0}, 3);
  walk(kTurn, 3.14);  // a quarter to the left, so that it has walked to its right
  walk(right, 1.5);
  EXPECT_EQ(objection(right), "");
  guard_.Forget();
  walk(kForward, 3);
  guard_.Forget();
  walk(kTurn, 3.14);
  walk(right, 1.5);
  EXPECT_THAT(objection(right), HasSubstr("no sensor looks there"));
}

TEST_F(WalkGuardTest, ElsewhereItKnowsNothingThatIsInTheWay) {
  for (const WalkGuard::Reading& reading : {atEdge(), beforeWall(0.05)}) {
    look(reading);
    EXPECT_NE(objection(kForward), "");
    guard_.Forget();
    EXPECT_EQ(objection(kForward), "");
    walk(kForward, 0.9);
    EXPECT_EQ(objection(kForward), "") << "3 cm before the place of the edge";
  }
}

TEST_F(WalkGuardTest, ItRemembersAnEdgeThatItDoesNotSeeAnyMore) {
  look(atEdge());
  walk(kTurn, 3.14, onFloor());  // a quarter to the left, so that the edge is on its right
  EXPECT_EQ(objection(kForward), "");
  EXPECT_THAT(objection({0.1, -0.06, 0}), HasSubstr("no sensor looks there"));
  walk({0, -0.06, 0}, 2.7);
  EXPECT_THAT(objection({0, 0, -1}), HasSubstr("the floor ends there"));
}

TEST_F(WalkGuardTest, APawThatFindsNoFloorEndsTheWalk) {
  walk(kForward, 3);
  EXPECT_EQ(objection(kForward), "");
  WalkGuard::Reading reading = onFloor();
  reading.paws[robot_model::LEFT_FRONT_LEG] = false;
  walk(kForward, 1, reading);
  EXPECT_THAT(objection(kForward), HasSubstr("the left front paw finds no floor"));
  look(onFloor());
  EXPECT_THAT(objection({0.05, 0, 0.4}), HasSubstr("the floor ends there"));
  EXPECT_EQ(objection(kBack), "");
}

TEST_F(WalkGuardTest, ThePawThatFindsNoFloorIsNamed) {
  const char* const names[NUMBER_OF_LEGS] = {"left front", "left hind", "right front", "right hind"};
  for (int leg = 0; leg < NUMBER_OF_LEGS; ++leg) {
    guard_.Forget();
    walk(kForward, 3);
    WalkGuard::Reading reading = onFloor();
    reading.paws[leg] = false;
    walk(kForward, 1, reading);
    EXPECT_THAT(objection(kForward), HasSubstr("the " + std::string(names[leg]) + " paw finds no floor"));
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

TEST_F(WalkGuardTest, APawThatHasNotWorkedIsNotBelieved) {
  WalkGuard::Reading reading = onFloor();
  std::fill(std::begin(reading.paws), std::end(reading.paws), false);
  walk(kForward, 5, reading);
  EXPECT_EQ(objection(kForward), "");
  const double two_steps = 2 * gait_.StepAt(kForward).period;
  for (int i = 0; i < 8; ++i) {
    walk(kForward, two_steps, onFloor());
    walk(kForward, two_steps, reading);
    EXPECT_EQ(objection(kForward), "") << "it works now and then";
  }
}

TEST_F(WalkGuardTest, APawThatFeelsTheFloorLateInEachStepIsOnTheFloor) {
  WalkGuard::Reading late = onFloor();
  late.paws[robot_model::RIGHT_HIND_LEG] = false;
  walk(kForward, 3);
  for (int i = 0; i < 100; ++i) {
    walk(kForward, 0.064, late);
    walk(kForward, 0.032, onFloor());
    EXPECT_EQ(objection(kForward), "");
  }
  walk(kForward, 1, late);
  EXPECT_THAT(objection(kForward), HasSubstr("the right hind paw finds no floor")) << "it is believed";
}

}  // namespace
