#include "simulator/ers7/body/joint.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace simulated_ers7 {
namespace {

const double kMicroradiansADegree = std::acos(-1.0) / 180 * 1e6;
constexpr double kFrame = 0.008;  // in seconds

const robot_model::RobotModel& model() {
  return *robot_model::findRobotModel("ERS-7");
}

const robot_model::Joint& jointModel(const char* name) {
  return model().joints[robot_model::findJointByName(model(), name)];
}

double highestStep(const robot_model::Joint& model) {
  return model.highest_speed * kFrame;
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

TEST(Joint, SettlesWithinATenthOfADegree12FramesAfterTheTimeAtHighestSpeed) {
  for (int i = 0; i < model().number_of_joints; ++i) {
    const robot_model::Joint& model_of_joint = model().joints[i];
    Joint joint = drivenJoint(model_of_joint, model_of_joint.lowest);
    joint.command(model_of_joint.highest);
    const double way = model_of_joint.highest - model_of_joint.lowest;
    pass(joint, static_cast<int>(std::ceil(way / highestStep(model_of_joint))) + 12);
    EXPECT_NEAR(joint.position(), model_of_joint.highest, 0.1 * kMicroradiansADegree) << model_of_joint.name;
    pass(joint, 15);
    EXPECT_EQ(joint.position(), model_of_joint.highest) << model_of_joint.name << " does not come to rest";
  }
}

TEST(Joint, FollowsASteadilyMovingCommand24MillisecondsBehind) {
  const robot_model::Joint& model_of_joint = jointModel("left_front_knee");
  Joint joint = drivenJoint(model_of_joint, 0);
  const int step = static_cast<int>(highestStep(model_of_joint) / 2);
  for (int i = 1; i <= 60; ++i) {
    joint.command(i * step);
    joint.passFrame(0);
    EXPECT_LE(i * step - joint.position(), 3 * step) << "frame " << i;
  }
  EXPECT_NEAR(60 * step - joint.position(), 2 * step, 0.01 * kMicroradiansADegree)
      << "one step is already made at the end of a frame";
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
    ASSERT_LE(std::abs(joint.position() - before), highestStep(model_of_joint) + 1e-6);
    ASSERT_GE((command - joint.position()) * (command - before), 0) << "passed its command, frame " << i;
  }
}

TEST(Joint, StopsAtItsMechanicalLimits) {
  const robot_model::Joint& model_of_joint = jointModel("head_tilt");
  Joint joint = drivenJoint(model_of_joint, 0);
  joint.command(model_of_joint.mechanical_highest + 400000);
  pass(joint, 100);
  EXPECT_EQ(joint.position(), model_of_joint.mechanical_highest);
  EXPECT_EQ(reading(joint).pwmDuty, Joint::kFullDuty) << "the motor still pushes";
  joint.command(model_of_joint.mechanical_lowest - 400000);
  pass(joint, 100);
  EXPECT_EQ(joint.position(), model_of_joint.mechanical_lowest);
}

// Level2 Reference Guide, pages 70 and 71: EnableJointGain, DisableJointGain, SetJointGain.
TEST(Joint, AcceptsGainsOnlyWhileItsGainIsEffective) {
  const robot_model::Joint& model_of_joint = jointModel("head_pan");
  Joint joint(model_of_joint, 0);
  joint.setPower(true);
  joint.command(100000);
  EXPECT_EQ(joint.setGains(model_of_joint.gains), oGAIN_DISABLED);
  joint.enableGain();
  pass(joint, 50);
  EXPECT_EQ(joint.position(), 0) << "gains that come too early have no effect";
  EXPECT_EQ(reading(joint).pwmDuty, 0);

  EXPECT_EQ(joint.setGains(model_of_joint.gains), oSUCCESS);
  pass(joint, 50);
  EXPECT_EQ(joint.position(), 100000) << "the command takes effect with the gain";

  joint.command(200000);
  joint.disableGain();
  pass(joint, 50);
  EXPECT_EQ(joint.position(), 100000);
  EXPECT_EQ(reading(joint).pwmDuty, 0);
  EXPECT_EQ(reading(joint).refValue, 200000);
  joint.enableGain();
  pass(joint, 50);
  EXPECT_EQ(joint.position(), 100000) << "disabling the gain has made it 0";
}

TEST(Joint, DoesNotMoveWithoutPower) {
  const robot_model::Joint& model_of_joint = jointModel("head_pan");
  Joint joint = drivenJoint(model_of_joint, 0);
  joint.command(100000);
  pass(joint, 2);
  joint.setPower(false);
  joint.passFrame(0);
  const double where = joint.position();
  EXPECT_GT(where, 0);
  pass(joint, 50);
  EXPECT_EQ(joint.position(), where);
  EXPECT_EQ(reading(joint).pwmDuty, 0);

  joint.command(static_cast<int>(where));
  joint.setPower(true);
  joint.passFrame(0);
  EXPECT_NEAR(joint.position(), where, 1) << "it begins at rest";
  joint.command(100000);
  pass(joint, 50);
  EXPECT_EQ(joint.position(), 100000) << "the gain has an effect again";
}

TEST(Joint, IsSofterWithAWeakerGain) {
  const robot_model::Joint& model_of_joint = jointModel("left_hind_knee");
  Joint standard = drivenJoint(model_of_joint, 0);
  Joint weak = drivenJoint(model_of_joint, 0);
  weak.setGains({0x10, 0x04, 0x01, 0x0E, 0x02, 0x0F});
  standard.command(100000);
  weak.command(100000);
  pass(standard, 4);
  pass(weak, 4);
  EXPECT_LT(weak.position(), 0.8 * standard.position());
  pass(weak, 60);
  EXPECT_EQ(weak.position(), 100000);
}

TEST(Joint, RunsToAFarCommandAtItsHighestSpeed) {
  const robot_model::Joint& model_of_joint = jointModel("neck_tilt");
  Joint joint = drivenJoint(model_of_joint, 0);
  joint.command(-1000000);
  joint.passFrame(0);
  EXPECT_GE(joint.position(), -highestStep(model_of_joint));
  EXPECT_EQ(reading(joint).pwmDuty, -Joint::kFullDuty);
}

TEST(Joint, StaysWhereItIsAtFullDutyWhileJammed) {
  const robot_model::Joint& model_of_joint = jointModel("head_pan");
  Joint joint = drivenJoint(model_of_joint, 0);
  joint.jam(true);
  joint.command(static_cast<int>(4 * highestStep(model_of_joint)));
  pass(joint, 61);
  EXPECT_EQ(joint.position(), 0);
  EXPECT_EQ(reading(joint).pwmDuty, Joint::kFullDuty);

  joint.jam(false);
  pass(joint, 40);
  EXPECT_NEAR(joint.position(), 4 * highestStep(model_of_joint), 1);

  joint.command(0);
  pass(joint, 2);
  joint.jam(true);
  pass(joint, 10);
  const double held = joint.position();
  joint.jam(false);
  pass(joint, 1);
  EXPECT_LT(held - joint.position(), 0.7 * highestStep(model_of_joint)) << "it begins at rest";
}

TEST(Joint, KeepsTheReadingsOfTheLastFourFramesInTheirOrder) {
  const robot_model::Joint& model_of_joint = jointModel("tail_pan");
  Joint joint(model_of_joint, 1000);
  for (const OJointValue& value : joint.readings()) {
    EXPECT_EQ(value.value, 1000);
  }
  for (int error = 1; error <= 6; ++error) {
    joint.passFrame(error);
  }
  for (int i = 0; i < Joint::kReadings; ++i) {
    EXPECT_EQ(joint.readings()[static_cast<std::size_t>(i)].value, 1003 + i);
  }
  EXPECT_EQ(joint.position(), 1000) << "an error of the encoder does not move the joint";
}

TEST(Joint, HasNoSpeedLeftAtItsStop) {
  const robot_model::Joint& model_of_joint = jointModel("head_tilt");
  Joint at_stop = drivenJoint(model_of_joint, 0);
  at_stop.command(model_of_joint.mechanical_highest + 400000);
  pass(at_stop, 100);
  Joint at_rest = drivenJoint(model_of_joint, model_of_joint.mechanical_highest);
  for (Joint* joint : {&at_stop, &at_rest}) {
    joint->command(0);
    joint->passFrame(0);
  }
  EXPECT_EQ(at_stop.position(), at_rest.position());
}

TEST(Joint, ItsSignalsCountTheEncodersStepsFromTheMechanicalLimit) {
  const robot_model::Joint& model_of_joint = jointModel("tail_pan");  // -60 degrees
  Joint joint(model_of_joint, static_cast<int>(-30 * kMicroradiansADegree));
  joint.command(static_cast<int>(30 * kMicroradiansADegree));
  joint.passFrame(0);
  EXPECT_NEAR(reading(joint).signal, 30 / 0.05, 1);
  EXPECT_NEAR(reading(joint).refSignal, 90 / 0.05, 1);
}

}  // namespace
}  // namespace simulated_ers7
