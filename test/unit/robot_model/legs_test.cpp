#include "robot_model/legs.h"

#include <gmock/gmock.h>

#include <cmath>

#include "robot_model/robot_model.h"

namespace robot_model {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;
constexpr Leg kLegs[] = {LEFT_FRONT_LEG, LEFT_HIND_LEG, RIGHT_FRONT_LEG, RIGHT_HIND_LEG};

double distance(const Point& a, const Point& b) {
  return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

const Joint& jointOf(Leg leg, int number) {
  const RobotModel& ers7 = *findRobotModel("ERS-7");
  return ers7.joints[findJointByIdentifier(ers7, legJointIdentifier(leg, number))];
}

// Calls a function with the angles of a grid over the whole range of a leg's joints.
template <typename Function>
void forWholeRange(Leg leg, Function function) {
  constexpr int kSteps = 30;
  const auto angle = [leg](int number, int step) {
    const Joint& joint = jointOf(leg, number);
    return (joint.lowest + (static_cast<double>(joint.highest) - joint.lowest) * step / kSteps) / 1e6;
  };
  for (int rotator = 0; rotator <= kSteps; ++rotator) {
    for (int elevator = 0; elevator <= kSteps; ++elevator) {
      for (int knee = 0; knee <= kSteps; ++knee) {
        function(LegAngles{angle(0, rotator), angle(1, elevator), angle(2, knee)});
      }
    }
  }
}

TEST(LegsTest, FindsFeetAtTheEndsOfTheLinks) {
  // By hand from Tekkotsu's table: 65 + 9 - 5.03, 62.5 + 4.7, -69.5 - 65.24; the hind shank is 13.529 ahead.
  EXPECT_LT(distance(findFoot(LEFT_FRONT_LEG, {0, 0, 0}), {0.06897, 0.0672, -0.13474}), 1e-9);
  EXPECT_LT(distance(findFoot(RIGHT_HIND_LEG, {0, 0, 0}), {-0.060471, -0.0672, -0.13578}), 1e-9);
  EXPECT_NEAR(findFoot(RIGHT_HIND_LEG, {90 * kDegree, 0, 0}).x, -0.065 + 0.13578, 1e-9) << "forward";
  EXPECT_NEAR(findFoot(RIGHT_FRONT_LEG, {0, 90 * kDegree, 0}).y, -(0.0625 + 0.13474), 1e-9) << "outwards";
  EXPECT_NEAR(findFoot(LEFT_FRONT_LEG, {0, 0, 90 * kDegree}).x, 0.065 + 0.009 + 0.06524, 1e-9) << "front knees forward";
  EXPECT_NEAR(findFoot(LEFT_HIND_LEG, {0, 0, 90 * kDegree}).x, -0.065 - 0.009 - 0.06628, 1e-9) << "hind knees back";
}

TEST(LegsTest, ReachEveryFootOfTheJointsWholeRange) {
  for (const Leg leg : kLegs) {
    forWholeRange(leg, [leg](const LegAngles& angles) {
      const Point foot = findFoot(leg, angles);
      LegAngles found{};
      ASSERT_TRUE(findLegAngles(leg, foot, &found));
      ASSERT_LT(distance(findFoot(leg, found), foot), 1e-9)
          << leg << ": " << angles.rotator << ", " << angles.elevator << ", " << angles.knee;
    });
  }
}

TEST(LegsTest, StretchTowardsAFootTooFarAway) {
  for (const Leg leg : kLegs) {
    const Point shoulder = findShoulder(leg);
    LegAngles angles{};
    EXPECT_FALSE(findLegAngles(leg, {shoulder.x, shoulder.y, -0.3}, &angles));
    const Point foot = findFoot(leg, angles);
    EXPECT_NEAR(foot.x, shoulder.x, 1e-3);
    EXPECT_NEAR(foot.y, shoulder.y, 1e-3);
    EXPECT_LT(foot.z, -0.134);
  }
}

}  // namespace
}  // namespace robot_model
