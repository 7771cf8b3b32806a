#include "robot_model/head.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "robot_model/robot_model.h"

namespace robot_model {
namespace {

const double DEGREE = M_PI / 180;
const double REACHED = 0.001;

// Where the camera is with neck and head at zero.
const Point CAMERA = {NECK_FORWARD + CAMERA_FORWARD, 0, NECK_UP + NECK_LENGTH + CAMERA_UP};

TEST(Head, LooksAheadWithoutMoving) {
  HeadAngles angles;
  EXPECT_LT(findHeadAngles({3, 0, CAMERA.z}, &angles), REACHED);
  EXPECT_NEAR(angles.neck_tilt, 0, 1e-6);
  EXPECT_NEAR(angles.head_pan, 0, 1e-6);
  EXPECT_NEAR(angles.head_tilt, 0, REACHED);
}

TEST(Head, LooksToTheSidesAndUpWithAnUprightNeck) {
  HeadAngles angles;
  EXPECT_LT(findHeadAngles({NECK_FORWARD, 2, CAMERA.z}, &angles), 3 * DEGREE) << "2 degrees beyond its limit";
  EXPECT_NEAR(angles.head_pan, 88 * DEGREE, 1e-5);
  EXPECT_LT(findHeadAngles({NECK_FORWARD + 1, -1, 1}, &angles), REACHED);
  EXPECT_NEAR(angles.head_pan, -45 * DEGREE, 1e-6);
  EXPECT_EQ(angles.neck_tilt, 0);
  EXPECT_GT(angles.head_tilt, 30 * DEGREE);
}

TEST(Head, LeansTheNeckForwardToSeeTheFloorInFrontOfThePaws) {
  HeadAngles angles;
  EXPECT_LT(findHeadAngles({0.30, 0.05, -0.143}, &angles), REACHED);
  EXPECT_LT(angles.neck_tilt, -30 * DEGREE);
}

TEST(Head, APlaceAheadOfTheCameraInTheHeadIsSeenInTheMiddle) {
  for (const double angle : {-0.5, 0.0, 0.3}) {
    HeadAngles angles;
    angles.neck_tilt = 2 * angle - 0.3;
    angles.head_pan = -angle;
    angles.head_tilt = angle / 2 + 0.1;
    const Point ahead = findInBody({CAMERA_FORWARD + 0.5, 0, CAMERA_UP}, angles);
    EXPECT_LT(findViewError(ahead, angles), 1e-9);
  }
}

TEST(Head, ComesAsCloseAsItCanToWhatItCannotSee) {
  HeadAngles angles;
  const double behind = findHeadAngles({-1, 0.5, 0.1}, &angles);
  EXPECT_GT(behind, 45 * DEGREE);
  EXPECT_LT(behind, 70 * DEGREE);
  EXPECT_NEAR(angles.head_pan, 88 * DEGREE, 1e-5) << "to the side on which it is";
  EXPECT_GT(findHeadAngles({0.05, 0.3, -0.143}, &angles), 20 * DEGREE) << "the floor beside the robot";
  EXPECT_GT(findHeadAngles({0.12, 0, 0.095}, &angles), 20 * DEGREE) << "inside the head";
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
