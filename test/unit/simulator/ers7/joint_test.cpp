#include "simulator/ers7/body/joint.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace simulated_ers7 {
namespace {

constexpr double kFrame = 0.008;  // in seconds

const robot_model::Joint& jointModel(const char* name) {
  const robot_model::RobotModel& robot = *robot_model::findRobotModel("ERS-7");
  return robot.joints[robot_model::findJointByName(robot, name)];
}

/// A joint with standard gains, ready to move.
Joint drivenJoint(const robot_model::Joint& model, int position) {
  Joint joint(model, position);
  joint.setPower(true);
  joint.enableGain();
  EXPECT_EQ(joint.setGains(model.gains), oSUCCESS);
  return joint;
}

void pass(Joint& joint, int frames) {
  for (int i = 0; i < frames; ++i) {
    joint.passFrame(0);
  }
}

const OJointValue& reading(const Joint& joint) {
  return joint.readings().back();
}

TEST(Joint, NeverExceedsItsHighestSpeedAndNeverOvershootsAFixedCommand) {
  std::mt19937 random(1);
  const robot_model::Joint& model_of_joint = jointModel("neck_tilt");
  Joint joint = drivenJoint(model_of_joint, model_of_joint.lowest);
  int command = model_of_joint.lowest;
  for (int i = 0; i < 10000; ++i) {
    const double before = joint.position();
    if (i % 60 == 0) {
      const auto range = static_cast<unsigned>(model_of_joint.highest - model_of_joint.lowest);
      command = model_of_joint.lowest + static_cast<int>(random() % range);
      joint.command(command);
    }
    joint.passFrame(0);
    ASSERT_LE(std::abs(joint.position() - before), model_of_joint.highest_speed * kFrame + 1e-6);
    ASSERT_GE((command - joint.position()) * (command - before), 0) << "passed its command, frame " << i;
  }
}

TEST(Joint, DoesNotMoveWithoutGainOrPowerButRemembersItsCommand) {
  Joint joint = drivenJoint(jointModel("head_pan"), 0);
  joint.setPower(false);
  joint.command(100000);
  pass(joint, 50);
  EXPECT_EQ(joint.position(), 0);
  EXPECT_EQ(reading(joint).pwmDuty, 0);
  joint.setPower(true);
  pass(joint, 50);
  EXPECT_EQ(joint.position(), 100000) << "the gain has an effect again";
  joint.disableGain();
  joint.command(200000);
  pass(joint, 50);
  EXPECT_EQ(joint.position(), 100000);
  EXPECT_EQ(reading(joint).refValue, 200000);
  joint.enableGain();
  pass(joint, 50);
  EXPECT_EQ(joint.position(), 100000) << "disabling the gain has made it 0";
}

TEST(Joint, StaysWhereItIsAtFullDutyWhileJammed) {
  Joint joint = drivenJoint(jointModel("head_pan"), 0);
  joint.jam(true);
  joint.command(500000);
  pass(joint, 61);
  EXPECT_EQ(joint.position(), 0);
  EXPECT_EQ(reading(joint).pwmDuty, Joint::kFullDuty);
  joint.jam(false);
  pass(joint, 60);
  EXPECT_EQ(joint.position(), 500000);
}

}  // namespace
}  // namespace simulated_ers7
