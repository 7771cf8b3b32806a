#include "physical_ers7.h"

#include <gmock/gmock.h>

namespace {

using physics::PhysicalErs7;

constexpr double kDegree = 3.14159265358979323846 / 180;
constexpr double kGravity = 9.81;

void passSeconds(PhysicalErs7& robot, double seconds) {
  for (double time = 0; time < seconds; time += 0.008) {
    robot.passFrame();
  }
}

void holdAll(PhysicalErs7& robot) {
  for (std::size_t i = 0; i < 18; ++i) {
    robot.drive(i, robot.jointPosition(i));
  }
}

std::size_t joint(const PhysicalErs7& robot, const char* name) {
  return static_cast<std::size_t>(robot_model::findJointByName(robot.model(), name));
}

double acceleration(PhysicalErs7& robot, const char* locator) {
  OPrimitiveID id = 0;
  EXPECT_EQ(robot.openPrimitive(locator, &id), oSUCCESS);
  OSensorValue value = {};
  EXPECT_EQ(robot.getSensorValue(id, &value), oSUCCESS);
  return value.value * 1e-6;
}

// A motor that is slower than its command has full duty, and does not exceed its highest speed without a load.
TEST(PhysicalErs7, MovesAJointInTheAirAtItsHighestSpeedAtMost) {
  PhysicalErs7 robot;
  holdAll(robot);
  robot.hold(0.3);
  passSeconds(robot, 1);
  const std::size_t rotator = joint(robot, "left_front_rotator");
  double fastest = 0;
  robot.drive(rotator, 1.5);
  for (int frame = 0; frame < 125; ++frame) {
    robot.passFrame();
    fastest = std::max(fastest, robot.jointSpeed(rotator));
  }
  EXPECT_NEAR(fastest, robot.highestSpeed(rotator), 0.2 * robot.highestSpeed(rotator));
  EXPECT_NEAR(robot.jointPosition(rotator), 1.5, 0.05);
}

// Stretched forward from the shoulder, the leg hangs lower with a weaker motor: by its torque over the stiffness.
TEST(PhysicalErs7, HangsUnderALoadByWhatItsTorqueAllows) {
  double sag[2];
  for (const bool is_weak : {false, true}) {
    physics::World world;
    world.stall_torque = is_weak ? 0.5 : 1.5;
    PhysicalErs7 robot(world);
    holdAll(robot);
    robot.hold(0.3);
    const std::size_t rotator = joint(robot, "left_front_rotator");
    robot.drive(rotator, 90 * kDegree);
    passSeconds(robot, 3);
    sag[is_weak ? 1 : 0] = 90 * kDegree - robot.jointPosition(rotator);
    EXPECT_NEAR(robot.torque(rotator), 0.146 * kGravity * 0.06, 0.04);
  }
  EXPECT_NEAR(sag[1] / sag[0], 3, 0.3);
}

TEST(PhysicalErs7, SlidesUnderAPushThatFrictionCannotHold) {
  for (const double friction : {0.3, 0.8}) {
    physics::World world;
    world.friction = friction;
    PhysicalErs7 robot(world);
    holdAll(robot);
    passSeconds(robot, 1);
    robot.push({0, 0.4 * 1.65 * kGravity, 0});
    const double before = robot.footPosition(robot_model::LEFT_FRONT_LEG).y();
    passSeconds(robot, 0.4);
    const double slipped = robot.footPosition(robot_model::LEFT_FRONT_LEG).y() - before;
    EXPECT_EQ(slipped > 0.01, friction < 0.4) << friction << ": " << slipped;
  }
}

TEST(PhysicalErs7, FeelsGravityWithSonysSigns) {
  const char* const kFrontBack = "PRM:/a1-Sensor:a1";
  const char* const kRightLeft = "PRM:/a2-Sensor:a2";
  const char* const kUpDown = "PRM:/a3-Sensor:a3";
  PhysicalErs7 robot;
  holdAll(robot);
  passSeconds(robot, 2);
  EXPECT_NEAR(acceleration(robot, kUpDown), -kGravity, 0.2);
  EXPECT_NEAR(acceleration(robot, kRightLeft), 0, 0.2);
  EXPECT_NEAR(acceleration(robot, kFrontBack), 0, 0.5);

  // On its right side, gravity points to its right.
  robot.place({}, Eigen::Quaterniond(Eigen::AngleAxisd(90 * kDegree, Eigen::Vector3d::UnitX())));
  passSeconds(robot, 3);
  EXPECT_GT(acceleration(robot, kRightLeft), 0.8 * kGravity);
}

}  // namespace
