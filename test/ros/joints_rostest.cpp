// Moving the joints, and the limits that protect the robot.

#include <aibo_driver/MotionState.h>
#include <aibo_driver/PlayMotion.h>
#include <gmock/gmock.h>
#include <ros/ros.h>
#include <sensor_msgs/CompressedImage.h>
#include <std_msgs/Float64.h>

#include <chrono>
#include <string>

#include "robot_model/robot_model.h"
#include "support/ros/joint_listener.h"
#include "support/ros/joint_messages.h"
#include "support/ros/joint_user.h"
#include "support/ros/motion_states.h"
#include "support/ros/topic_listener.h"

namespace {

using aibo_driver::EndedMovement;
using aibo_driver::MotionState;
using test_support::command;
using test_support::DriverUser;
using test_support::JointListener;
using test_support::JointUser;
using test_support::kQuick;
using test_support::lastEnd;
using test_support::Posture;
using test_support::TopicListener;
using test_support::trajectory;

// Two encoder steps within 32 ms, and the settling of the servo.
constexpr double kSpeedTolerance = 0.12;  // rad/s

const robot_model::RobotModel& ers7() {
  return *robot_model::findRobotModel("ERS-7");
}

// Each joint at another fraction between its limits. From 0.5 to 0.7 no part of the body is in the way of another.
Posture postureOf(int number) {
  Posture posture;
  for (int i = 0; i < ers7().number_of_joints; ++i) {
    const robot_model::Joint& joint = ers7().joints[i];
    const double fraction = 0.5 + 0.01 * ((7 * (i + number)) % 20);
    posture[joint.name] = (joint.lowest + fraction * (joint.highest - joint.lowest)) / 1e6;
  }
  return posture;
}

TEST(JointCommand, MovesEveryJointByOneRequest) {
  JointUser user("/command");
  std::size_t orders = 0;
  EXPECT_TRUE(user.reaches(postureOf(1), [&] {
    user.publish("joint_command", command(postureOf(1)));
    ++orders;
  }));
  EXPECT_LE(user.jointRequests(), orders);
}

TEST(PositionControllers, MoveEveryJoint) {
  JointUser user("/controllers");
  EXPECT_TRUE(user.reaches(postureOf(2), [&user] {
    for (const auto& [joint, position] : postureOf(2)) {
      std_msgs::Float64 message;
      message.data = position;
      user.publish(joint + "_position_controller/command", message);
    }
  }));
}

TEST(JointTrajectory, MovesEveryJointAlsoWhileNobodyListensToTheJoints) {
  JointUser user("/trajectory");
  EXPECT_TRUE(user.reaches(postureOf(3), "joint_trajectory", trajectory(postureOf(3), 1.5)));

  DriverUser deaf("/unheard", kQuick);
  TopicListener<MotionState> states("/unheard/motion_state");
  const auto is_done = [](const MotionState& state) { return lastEnd(state).how == EndedMovement::DONE; };
  bool is_there = false;
  for (int seconds = 1; seconds <= 9 && !is_there; ++seconds) {  // again, until the robot has reported its joints
    deaf.publish("joint_trajectory", trajectory({{"head_pan", 0.3}}, 0.5));
    is_there = states.waitFor(is_done, std::chrono::seconds(seconds)) != nullptr;
  }
  EXPECT_TRUE(is_there);
}

TEST(JointCommand, KeepsTheSpeedLimitOfTheParameter) {
  JointUser user("/limit", {"_stream_on_start:=false", "_joint_speed_limit:=1.5", "_approach_speed:=20"});
  EXPECT_TRUE(user.reaches({{"head_pan", 1.0}}, "joint_command", command({{"head_pan", 1.0}})));
  EXPECT_LE(user.joints.highestSpeed("head_pan"), 1.5 + kSpeedTolerance);
}

TEST(JointTrajectory, ThatIsTooFastIsSlowedDownOnRequest) {
  JointUser user("/slowed", {"_stream_on_start:=false", "_joint_speed_limit:=1", "_slow_down:=true"});
  EXPECT_TRUE(user.reaches({{"head_pan", 1.0}}, "joint_trajectory", trajectory({{"head_pan", 1.0}}, 0.02)));
  EXPECT_LE(user.joints.highestSpeed("head_pan"), 1.0 + kSpeedTolerance);
}

TEST(PlayMotion, KeepsTheSpeedLimitOfTheParameter) {
  JointUser user("/motion_limit", {"_stream_on_start:=false", "_motion_speed_limit:=0.3"});
  aibo_driver::PlayMotion::Request nod;
  nod.name = "nod";
  const auto answer = user.call<aibo_driver::PlayMotion>("play_motion", nod);
  ASSERT_TRUE(answer.success) << answer.message;
  ASSERT_TRUE(user.joints.messages().waitFor(
      [](const auto& state) { return test_support::speedOf(state, "neck_tilt").value_or(0) > 0.2; }));
  EXPECT_TRUE(user.joints.waitForSpeedBelow("neck_tilt", 0.03));
  EXPECT_LE(user.joints.highestSpeed("neck_tilt"), 0.3 + kSpeedTolerance);
}

TEST(JointTrajectory, IsNeitherResumedNorRepeatedAfterAReconnect) {
  JointUser user("/cut_off");
  const auto order = trajectory({{"head_pan", 1.4}}, 14.0);
  ASSERT_TRUE(user.becomesTrue([&] {
    user.publish("joint_trajectory", order);
    return user.waitForPanBeyond(0.1, std::chrono::seconds(5));
  }));
  const std::size_t connections = user.proxy.connections();
  user.reconnect();
  const double first = user.joints.position("head_pan");
  user.joints.messages().clear();
  user.joints.messages().waitForCount(15);
  EXPECT_NEAR(user.joints.position("head_pan"), first, JointListener::kTolerance);
  EXPECT_EQ(user.jointRequests(connections), 0u);
}

TEST(OldServer, MovesJointsDuringTheStream) {
  TopicListener<sensor_msgs::CompressedImage> pictures("/old/camera/image_raw/compressed");
  JointUser user("/old", {"_joint_speed_limit:=20", "_approach_speed:=20"}, {"--protocol-version", "1"});
  ASSERT_FALSE(pictures.waitForCount(10).empty());
  EXPECT_TRUE(user.reaches(postureOf(5), "joint_command", command(postureOf(5))));
  EXPECT_GE(pictures.waitForCount(pictures.count() + 30).size(), 40u) << "the stream goes on";
  EXPECT_EQ(user.proxy.connections(), 1u);
}

}  // namespace
