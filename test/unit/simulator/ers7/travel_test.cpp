// How the simulated robot travels on its legs.
#include "simulator/ers7/body/travel.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "protocol/walk_requests.h"
#include "robot_model/legs.h"
#include "simulator/openr_host/clock.h"

namespace simulated_ers7 {
namespace {

using Eigen::Vector3d;
using openr_host::kFrameSeconds;
using Legs = std::array<LegAngles, kLegs>;

constexpr double kGravity = 9.80665;
constexpr double kHeight = 0.115;  ///< of the body in these tests

using protocol::version2::Velocity;

/// The usual place of the foot's centre in the body.
Vector3d placeOf(Leg leg) {
  const robot_model::Point shoulder = robot_model::findShoulder(leg);
  return {shoulder.x, shoulder.y + (robot_model::isLeft(leg) ? 0.03 : -0.03), robot_model::FOOT_RADIUS - kHeight};
}

LegAngles withFootAt(Leg leg, const Vector3d& place) {
  return robot_model::findLegAngles(leg, {place.x(), place.y(), place.z()});
}

/// How far the foot rolls forward and to the left from its usual place to these angles: its radius times the angle by
/// which the lower leg turns.
Vector3d rolledTo(Leg leg, const LegAngles& angles) {
  const LegAngles usual = withFootAt(leg, placeOf(leg));
  const double front = robot_model::isFront(leg) ? 1 : -1;
  const double left = robot_model::isLeft(leg) ? 1 : -1;
  return robot_model::FOOT_RADIUS * Vector3d(angles.rotator - usual.rotator + front * (angles.knee - usual.knee),
                                             left * (angles.elevator - usual.elevator), 0);
}

/// The leg's angles where the foot's lowest point is so far from its usual place after it has rolled there.
LegAngles reaching(Leg leg, const Vector3d& shift) {
  LegAngles angles = withFootAt(leg, placeOf(leg) + shift);
  for (int round = 0; round < 10; ++round) {
    angles = withFootAt(leg, placeOf(leg) + shift - rolledTo(leg, angles));
  }
  return angles;
}

Legs reaching(const std::function<Vector3d(Leg)>& shift) {
  Legs legs;
  for (std::size_t i = 0; i < kLegs; ++i) {
    legs[i] = reaching(static_cast<Leg>(i), shift(static_cast<Leg>(i)));
  }
  return legs;
}

const Legs kStanding = reaching([](Leg) { return Vector3d::Zero(); });

/// Where a foot on the floor goes in the body within `seconds`.
Vector3d carriedBack(Leg leg, const Velocity& velocity, double seconds) {
  const Vector3d place = placeOf(leg);
  return -seconds *
         Vector3d(velocity.forward - velocity.turn * place.y(), velocity.left + velocity.turn * place.x(), 0);
}

/// A plain trot: diagonal feet, half a period each.
Legs trotting(const Velocity& velocity, double seconds) {
  constexpr double kPeriod = 0.4;
  constexpr double kLift = 0.016;
  return reaching([&](Leg leg) -> Vector3d {
    const bool is_first = leg == robot_model::LEFT_FRONT_LEG || leg == robot_model::RIGHT_HIND_LEG;
    const double phase = std::fmod(seconds / kPeriod + (is_first ? 0 : 0.5), 1);
    const Vector3d end = carriedBack(leg, velocity, kPeriod / 4);
    const double share = 2 * phase - (phase < 0.5 ? 0 : 1);
    if (phase < 0.5) {
      return (2 * share - 1) * end;
    }
    return std::cos(M_PI * share) * end + Vector3d(0, 0, kLift * std::sin(M_PI * share));
  });
}

double tiltOf(const Stance& stance) {
  return std::acos(std::min(1.0, stance.body.linear()(2, 2)));
}

class TravelTest : public testing::Test {
 protected:
  void pass(const Legs& legs, double seconds = kFrameSeconds) {
    for (double passed = 0; passed < seconds - 1e-9; passed += kFrameSeconds) {
      travel_.passFrame(legs, {}, scene_);
    }
  }

  void trot(const Velocity& velocity, double seconds) {
    for (double passed = 0; passed < seconds - 1e-9; passed += kFrameSeconds) {
      pass(trotting(velocity, passed));
      most_tilt_ = std::max(most_tilt_, tiltOf(travel_.stance()));
    }
  }

  Scene scene_;
  Travel travel_{kStanding, {}};
  double most_tilt_ = 0;
};

TEST_F(TravelTest, ATrotGoesWhereItsFeetPushItUpright) {
  const Velocity velocities[] = {{0.10, 0, 0}, {-0.08, 0, 0}, {0, 0.05, 0}, {0, -0.05, 0}, {0, 0, 0.8}, {0, 0, -0.8}};
  for (const Velocity& velocity : velocities) {
    travel_ = Travel(kStanding, {});
    trot(velocity, 4);
    const Place& place = travel_.place();
    EXPECT_NEAR(place.x, 4 * velocity.forward, 0.02) << velocity.left << " " << velocity.turn;
    EXPECT_NEAR(place.y, 4 * velocity.left, 0.02) << velocity.forward << " " << velocity.turn;
    EXPECT_NEAR(place.yaw, 4 * velocity.turn, 0.1) << velocity.forward << " " << velocity.left;
    EXPECT_LT(most_tilt_, 0.06) << "radian";
  }
}

TEST_F(TravelTest, FrictionLimitsHowFastItSpeedsUp) {
  // All feet begin to go back at 0.4 m/s at once. By hand: in 5 frames friction gives the body 0.6 * 9.8 * 0.04 =
  // 0.235 m/s, and it has gone half of that times 40 ms.
  double gone = 0;
  for (int frame = 1; frame <= 5; ++frame) {
    const double before = travel_.place().x;
    pass(reaching([&](Leg leg) { return carriedBack(leg, {0.4, 0, 0}, frame * kFrameSeconds); }));
    gone = travel_.place().x - before;
  }
  EXPECT_NEAR(gone / kFrameSeconds, kFriction * kGravity * 5 * kFrameSeconds, 0.005);
  EXPECT_NEAR(travel_.place().x, 0.0056, 0.0005) << "metres of the 0.016 that the feet have gone";
}

TEST_F(TravelTest, FeetThatPullAgainstEachOtherSlip) {
  for (int frame = 1; frame <= 40; ++frame) {
    pass(reaching([&](Leg leg) {
      return carriedBack(leg,
                         {leg == robot_model::LEFT_FRONT_LEG || leg == robot_model::RIGHT_HIND_LEG ? 0.1 : -0.1, 0, 0},
                         frame * kFrameSeconds);
    }));
  }
  EXPECT_NEAR(travel_.place().x, 0, 0.003);
  EXPECT_NEAR(travel_.place().y, 0, 0.003);
}

TEST_F(TravelTest, AWallStopsIt) {
  trot({-0.1, 0, 0}, 20);
  const double stopped = travel_.place().x;
  EXPECT_NEAR(stopped, kLowestCorner[0] + 0.15, 0.01) << "with its rump at the wall";
  trot({-0.1, 0, 0}, 4);
  EXPECT_TRUE(travel_.isStopped());
  EXPECT_NEAR(travel_.place().x, stopped, 0.005);
  EXPECT_DOUBLE_EQ(travel_.stance().body.translation().x(), travel_.place().x);
}

TEST_F(TravelTest, TheBallStopsIt) {
  trot({0.15, 0, 0}, 20);
  EXPECT_NEAR(scene_.clearance(travel_.stance().body * Vector3d(0.06, 0, 0)), 0.09, 0.002);
  trot({-0.1, 0, 0}, 5);
  EXPECT_LT(travel_.place().x, 0.4) << "it can go away again";
}

TEST_F(TravelTest, AFootBeyondTheEdgeOfATableDoesNotCarryAndTheRobotFallsOff) {
  const Scene scene(true);
  Travel travel(kStanding, {}, kTableHeight);
  EXPECT_NEAR(travel.stance().body.translation().z(), kTableHeight + kHeight, 1e-6);
  const double edge = kTableX + kTableHalfLength;
  int frames_over_edge = 0;
  for (double passed = 0; passed < 20 && !travel.hasFallenOff(); passed += kFrameSeconds) {
    const Legs legs = trotting({0.1, 0, 0}, passed);
    travel.passFrame(legs, {}, scene);
    const Vector3d foot = travel.stance().body * footInBody(robot_model::LEFT_FRONT_LEG, legs[0]);
    if (foot.x() > edge + 0.01) {
      ++frames_over_edge;
      EXPECT_TRUE(travel.isOverEdge());
      EXPECT_FALSE(travel.stance().paw_down[robot_model::LEFT_FRONT_LEG]);
    } else if (!travel.isOverEdge()) {
      EXPECT_NEAR(travel.stance().body.translation().z(), kTableHeight + kHeight, 0.005);
    }
  }
  EXPECT_GT(frames_over_edge, 20);
  ASSERT_TRUE(travel.hasFallenOff());
  EXPECT_LT(travel.place().x, edge + 0.02);
  for (double passed = 0; passed < 1; passed += kFrameSeconds) {
    travel.passFrame(kStanding, {}, scene);
  }
  EXPECT_LT(travel.stance().body.translation().z(), 0.2) << "it lies on the floor";
  EXPECT_LT(travel.stance().body.linear()(2, 1), -0.9) << "on its left side";
}

TEST_F(TravelTest, TheRobotFallsOffATableWhenItTipsBy15Degrees) {
  const Scene scene(true);
  Travel travel(kStanding, {}, kTableHeight);
  double degrees = 0;
  for (double passed = 0; passed < 20 && !travel.hasFallenOff(); passed += kFrameSeconds) {
    degrees = tiltOf(travel.stance()) * 180 / M_PI;
    travel.passFrame(trotting({0, -0.05, 0}, passed), {}, scene);
  }
  EXPECT_GT(travel.place().y, -kTableHalfWidth) << "its middle is still over the table";
  EXPECT_NEAR(degrees, 15, 1);
}

TEST_F(TravelTest, SpeedingUpIsFeltAsAnAccelerationAhead) {
  const auto gone = [](double seconds) {  // at 1 m/s^2
    return reaching([&](Leg leg) { return carriedBack(leg, {seconds / 2, 0, 0}, seconds); });
  };
  for (int frame = 0; frame < 40; ++frame) {
    pass(gone(frame * kFrameSeconds));
    if (frame > 20) {
      ASSERT_NEAR(travel_.acceleration().x(), 1, 0.1) << "frame " << frame;
    }
  }
  pass(gone(39 * kFrameSeconds), 0.4);
  EXPECT_NEAR(travel_.acceleration().norm(), 0, 0.01);
}

TEST_F(TravelTest, LiftedItIsHeldLevelWithAllPawsUpAndComesBackToItsPlace) {
  trot({0.1, 0, 0.3}, 2);
  pass(kStanding, 0.5);
  const Eigen::Isometry3d before = travel_.stance().body;
  travel_.lift(true);
  pass(kStanding, 1);
  EXPECT_GT(travel_.stance().body.translation().z(), 0.3);
  EXPECT_NEAR((travel_.stance().body.linear() * Vector3d::UnitX() - before.linear() * Vector3d::UnitX()).norm(), 0,
              0.02)
      << "it is not turned meanwhile";
  EXPECT_EQ(travel_.stance().paw_down, (std::array<bool, kLegs>{}));
  travel_.lift(false);
  pass(kStanding, 1);
  EXPECT_TRUE(travel_.stance().body.isApprox(before, 1e-6));
  EXPECT_EQ(travel_.stance().paw_down, (std::array<bool, kLegs>{true, true, true, true}));
}

TEST_F(TravelTest, ItLiesOnEachSideAndIsPutBackOnItsFeet) {
  const std::pair<Side, Vector3d> sides[] = {
      {Side::kLeft, {0, 1, 0}}, {Side::kRight, {0, -1, 0}}, {Side::kBack, {0, 0, 1}}};
  for (const auto& [side, below] : sides) {
    travel_.lie(side);
    const Eigen::Isometry3d& body = travel_.stance().body;
    for (int frame = 0; frame < 1.5 / kFrameSeconds; ++frame) {
      const Eigen::Matrix3d before = body.linear();
      pass(kStanding);
      EXPECT_LT(Eigen::AngleAxisd(before.transpose() * body.linear()).angle(), 0.1) << "it is turned over slowly";
    }
    EXPECT_NEAR((body.linear() * below).z(), -1, 1e-6);
    EXPECT_GT(body.translation().z(), 0.05);
    EXPECT_GT((body * headInBody({}) * Vector3d(0.081, 0, -0.0146)).z(), 0.01) << "the camera";
    EXPECT_EQ(travel_.stance().paw_down, (std::array<bool, kLegs>{}));
  }
  travel_.lie(Side::kFeet);
  pass(kStanding, 1);
  EXPECT_NEAR(tiltOf(travel_.stance()), 0, 1e-6);
  EXPECT_EQ(travel_.stance().paw_down, (std::array<bool, kLegs>{true, true, true, true}));
}

}  // namespace
}  // namespace simulated_ers7
