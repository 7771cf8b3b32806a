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

// A leg that is stretched forward from the shoulder hangs lower with a weaker motor, by its torque divided by the
// stiffness.
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

}  // namespace
