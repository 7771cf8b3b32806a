#include "robot_model/legs.h"

#include <gmock/gmock.h>

#include <cmath>
#include <random>

#include "robot_model/head.h"
#include "robot_model/robot_model.h"

namespace robot_model {
namespace {

constexpr Leg kLegs[] = {LEFT_FRONT_LEG, LEFT_HIND_LEG, RIGHT_FRONT_LEG, RIGHT_HIND_LEG};

double distance(const Point& a, const Point& b) {
  return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

TEST(LegsTest, ReachEveryFootOfTheJointsWholeRange) {
  constexpr int kSteps = 30;
  const RobotModel& ers7 = *findRobotModel("ERS-7");
  for (const Leg leg : kLegs) {
    const auto angle = [&](int number, int step) {
      const Joint& joint = ers7.joints[findJointByIdentifier(ers7, legJointIdentifier(leg, number))];
      return (joint.lowest + (static_cast<double>(joint.highest) - joint.lowest) * step / kSteps) / 1e6;
    };
    for (int rotator = 0; rotator <= kSteps; ++rotator) {
      for (int elevator = 0; elevator <= kSteps; ++elevator) {
        for (int knee = 0; knee <= kSteps; ++knee) {
          const LegAngles angles = {angle(0, rotator), angle(1, elevator), angle(2, knee)};
          const Point foot = findFoot(leg, angles);
          ASSERT_LT(distance(findFoot(leg, findLegAngles(leg, foot)), foot), 1e-9)
              << leg << ": " << angles.rotator << ", " << angles.elevator << ", " << angles.knee;
        }
      }
    }
  }
}

const double DEGREE = M_PI / 180;

TEST(Head, ComesAsCloseAsItCanToWhatItCannotSee) {
  HeadAngles angles;
  const double behind = findHeadAngles({-1, 0.5, 0.1}, &angles);
  EXPECT_GT(behind, 45 * DEGREE);
  EXPECT_LT(behind, 70 * DEGREE);
  EXPECT_NEAR(angles.head_pan, 88 * DEGREE, 1e-5) << "to the side on which it is";
  EXPECT_GT(findHeadAngles({0.05, 0.3, -0.143}, &angles), 20 * DEGREE) << "the floor beside the robot";
  EXPECT_GT(findHeadAngles({0.12, 0, 0.095}, &angles), 20 * DEGREE) << "inside the head";
}

TEST(Head, SeesAheadFrom70DegreesDownTo45UpAnd88DegreesToEitherSide) {
  const auto miss = [](double up, double left) {  // of a point that is far away, in degrees
    HeadAngles angles;
    const Point point = {100 * std::cos(up * DEGREE) * std::cos(left * DEGREE),
                         100 * std::cos(up * DEGREE) * std::sin(left * DEGREE), 100 * std::sin(up * DEGREE)};
    return findHeadAngles(point, &angles) / DEGREE;
  };
  for (const auto& [up, left] : {std::pair(-70, 0), {45, 0}, {0, 88}, {0, -88}}) {
    EXPECT_NEAR(miss(up, left), 0, 0.2) << up << " " << left;
    EXPECT_GT(miss(up + (up > 0 ? 1 : up < 0 ? -1 : 0), left + (left > 0 ? 1 : left < 0 ? -1 : 0)), 0.7);
  }
}

TEST(Head, KeepsToTheLimitsOfItsJointsWhereverItLooks) {
  const RobotModel& model = *findRobotModel("ERS-7");
  const int neck = findJointByName(model, "neck_tilt");
  const int pan = findJointByName(model, "head_pan");
  const int tilt = findJointByName(model, "head_tilt");
  const int mouth = findJointByName(model, "mouth");
  std::mt19937 random(7);
  std::uniform_real_distribution<double> coordinate(-1, 1);
  for (int i = 0; i < 3000; ++i) {
    HeadAngles angles;
    findHeadAngles({coordinate(random), coordinate(random), coordinate(random)}, &angles);
    int posture[MAX_JOINTS] = {};
    posture[neck] = static_cast<int>(std::lround(angles.neck_tilt * 1e6));
    posture[pan] = static_cast<int>(std::lround(angles.head_pan * 1e6));
    posture[tilt] = static_cast<int>(std::lround(angles.head_tilt * 1e6));
    posture[mouth] = model.joints[mouth].highest;
    for (const int joint : {neck, pan, tilt}) {
      ASSERT_GE(posture[joint], lowestPosition(model, joint, posture)) << model.joints[joint].name;
      ASSERT_LE(posture[joint], model.joints[joint].highest) << model.joints[joint].name;
    }
  }
}

}  // namespace
}  // namespace robot_model
