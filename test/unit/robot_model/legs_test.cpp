#include "robot_model/legs.h"

#include <gmock/gmock.h>

#include <cmath>

#include "robot_model/robot_model.h"

namespace robot_model {
namespace {

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
