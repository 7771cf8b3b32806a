// Moving the joints, and the limits that protect the robot.

#include <aibo_driver/Connection.h>
#include <aibo_driver/PlayMotion.h>
#include <gmock/gmock.h>
#include <ros/ros.h>
#include <sensor_msgs/CompressedImage.h>
#include <std_msgs/Float64.h>
#include <std_srvs/SetBool.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "robot_model/robot_model.h"
#include "support/ros/diagnostics_listener.h"
#include "support/ros/joint_listener.h"
#include "support/ros/joint_messages.h"
#include "support/ros/joint_user.h"
#include "support/ros/topic_listener.h"
#include "support/scripted_server.h"

namespace {

using aibo_driver::Connection;
using sensor_msgs::JointState;
using test_support::command;
using test_support::DiagnosticsListener;
using test_support::JointListener;
using test_support::JointUser;
using test_support::kQuick;
using test_support::positionOf;
using test_support::Posture;
using test_support::TopicListener;
using test_support::trajectory;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using trajectory_msgs::JointTrajectory;

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

TEST(JointStates, ContainAllServosWithVelocitiesAndIncreasingStamps) {
  const JointUser user("/states");
  TopicListener<JointState> states("/states/joint_states");
  const auto messages = states.waitForCount(20);
  ASSERT_GE(messages.size(), 20u);
  ros::Time last;
  for (const auto& message : messages) {
    EXPECT_THAT(message->name, SizeIs(18));
    EXPECT_THAT(message->position, SizeIs(18));
    EXPECT_THAT(message->velocity, SizeIs(18));
    EXPECT_THAT(message->effort, SizeIs(18));
    EXPECT_GT(message->header.stamp, last);
    last = message->header.stamp;
  }
}

TEST(JointStates, HaveTheDutyOfAJammedJointAsEffort) {
  JointUser user("/effort");
  TopicListener<JointState> states("/effort/joint_states");
  ASSERT_TRUE(states.waitForNext());
  ASSERT_THAT(user.robot.type("jam head_pan"), HasSubstr("ok"));
  user.publish("joint_command", command({{"head_pan", -1}}));
  EXPECT_TRUE(states.waitFor([](const JointState& message) {
    const auto pan = std::find(message.name.begin(), message.name.end(), "head_pan") - message.name.begin();
    return message.effort.at(static_cast<std::size_t>(pan)) < -0.9;
  }));
}

// The joint may have been moved by hand meanwhile, or it is another robot's.
TEST(JointStates, HaveNoSpeedFromOneConnectionToTheNext) {
  test_support::ScriptedServer server;
  TopicListener<JointState> states("/two_robots/joint_states");
  const test_support::DriverProcess driver("/two_robots", server.port(), {"_stream_on_start:=false"});
  for (const unsigned connection : {0U, 1U}) {
    test_support::ScriptedPeer robot = server.accept();
    robot.agreeToTelemetry("F J T");
    const auto pan = version2_frames::makeTelemetry(1000 + 125 * connection, {{'J', 2, 500000 * int(connection)}});
    const auto is_there = [&](const JointState& state) { return state.position.at(0) == 0.5 * connection; };
    JointState::ConstPtr first;
    do {
      robot.send(version2_frames::makeFrame('t', 0, pan));  // again, until the driver knows its first subscriber
    } while (!(first = states.waitFor(is_there, std::chrono::milliseconds(100))));
    EXPECT_THAT(first->velocity, ::testing::ElementsAre(0.0));
  }
}

TEST(JointCommand, MovesEveryJointByOneRequest) {
  JointUser user("/command");
  const Posture posture = postureOf(1);
  user.publish("joint_command", command(posture));
  EXPECT_THAT(user.joints.waitForPositions(posture), IsEmpty());
  EXPECT_EQ(user.jointRequests(), 1u);
}

TEST(JointCommand, MovesEveryJointByAQuickSeriesOfMessages) {
  JointUser user("/series");
  const Posture posture = postureOf(2);
  for (const auto& joint : posture) {
    user.publish("joint_command", command({joint}));
  }
  EXPECT_THAT(user.joints.waitForPositions(posture), IsEmpty());
}

TEST(PositionControllers, MoveEveryJoint) {
  JointUser user("/controllers");
  const Posture posture = postureOf(3);
  for (const auto& joint : posture) {
    user.publisherOf<std_msgs::Float64>(joint.first + "_position_controller/command");
  }
  for (const auto& joint : posture) {
    std_msgs::Float64 position;
    position.data = joint.second;
    user.publish(joint.first + "_position_controller/command", position);
  }
  EXPECT_THAT(user.joints.waitForPositions(posture), IsEmpty());
  EXPECT_LT(user.jointRequests(), posture.size());
  user.publish("head_pan_position_controller/command", std_msgs::Float64());
  EXPECT_TRUE(user.joints.waitForPosition("head_pan", 0)) << "the next one, too";
}

TEST(JointTrajectory, MovesEveryJoint) {
  JointUser user("/trajectory");
  const Posture posture = postureOf(4);
  user.publish("joint_trajectory", trajectory(posture, 1.5));
  EXPECT_THAT(user.joints.waitForPositions(posture), IsEmpty());
}

TEST(JointCommand, KeepsTheSpeedLimitOfTheParameter) {
  JointUser user("/limit", {"_stream_on_start:=false", "_joint_speed_limit:=1.5", "_approach_speed:=20"});
  user.publish("joint_command", command({{"head_pan", 1.0}}));
  EXPECT_TRUE(user.joints.waitForPosition("head_pan", 1.0));
  EXPECT_LE(user.joints.highestSpeed("head_pan"), 1.5 + kSpeedTolerance);
}

TEST(JointCommand, WithoutARobotIsDroppedAndNotSentLater) {
  JointUser user("/dropped");
  const double before = user.joints.position("head_pan");
  user.publisherOf<JointState>("joint_command");
  const std::size_t connections = user.proxy.connections();
  user.loseRobot();
  user.publish("joint_command", command({{"head_pan", 0.5}}));
  user.waitForWarning("command of head_pan is refused");
  user.robot.restart();
  user.joints.messages().clear();
  ASSERT_FALSE(user.joints.messages().waitForCount(10).empty());
  EXPECT_EQ(user.jointRequests(connections), 0u);
  EXPECT_NEAR(user.joints.position("head_pan"), before, JointListener::kTolerance);
}

TEST(JointCommand, CutOffByADisconnectIsNotRepeatedAndTheJointHolds) {
  JointUser user("/cut_off");
  JointState message = command({{"head_pan", 1.4}});
  message.velocity = {0.1};
  user.publish("joint_command", message);
  ASSERT_TRUE(user.waitForPanBeyond(0.1));
  const std::size_t connections = user.proxy.connections();
  user.reconnect();
  const double first = user.joints.position("head_pan");
  user.joints.messages().waitForNext();
  user.joints.messages().clear();
  user.joints.messages().waitForCount(15);  // 0.5 s, in which it would have gone on by 0.05 rad
  EXPECT_NEAR(user.joints.position("head_pan"), first, JointListener::kTolerance);
  EXPECT_LT(first, 1.3);
  EXPECT_EQ(user.jointRequests(connections), 0u);
}

TEST(JointTrajectory, CutOffByADisconnectStaysCutOff) {
  JointUser user("/trajectory_cut_off");
  user.publish("joint_trajectory", trajectory({{"head_pan", 1.4}}, 14.0));
  ASSERT_TRUE(user.waitForPanBeyond(0.1));
  const std::size_t connections = user.proxy.connections();
  user.reconnect();
  user.waitForWarning("trajectory of head_pan ends early");
  const double first = user.joints.position("head_pan");
  user.joints.messages().clear();
  user.joints.messages().waitForCount(15);
  EXPECT_NEAR(user.joints.position("head_pan"), first, JointListener::kTolerance);
  EXPECT_EQ(user.jointRequests(connections), 0u);
}

TEST(JointTrajectory, ThatIsTooFastIsSlowedDownOnRequest) {
  std::vector<std::string> parameters{"_stream_on_start:=false", "_joint_speed_limit:=1", "_slow_down:=true"};
  JointUser user("/slowed", parameters);
  user.publish("joint_trajectory", trajectory({{"head_pan", 1.0}}, 0.02));
  EXPECT_TRUE(user.joints.waitForPosition("head_pan", 1.0));
  EXPECT_LE(user.joints.highestSpeed("head_pan"), 1.0 + kSpeedTolerance);
  user.driver.waitForOutput("The trajectory is slowed down [0-9.]+ times", test_support::kSafetyNet);
}

TEST(JointTrajectory, WaitsForItsStamp) {
  JointUser user("/stamp");
  user.publisherOf<JointTrajectory>("joint_trajectory");  // the stamp is made after the wait for a subscriber
  JointTrajectory message = trajectory({{"head_pan", 1.0}}, 0.5);
  message.header.stamp = ros::Time::now() + ros::Duration(1.0);
  user.joints.messages().clear();
  user.publish("joint_trajectory", message);
  const auto moved = user.joints.messages().waitFor([](const JointState& state) {
    const auto position = positionOf(state, "head_pan");
    return position && *position > 0.1;
  });
  ASSERT_TRUE(moved);
  EXPECT_GT(moved->header.stamp, message.header.stamp);
  EXPECT_TRUE(user.joints.waitForPosition("head_pan", 1.0));
}

TEST(JointTrajectory, WithoutPointsStopsTheJoints) {
  JointUser user("/hold");
  user.publish("joint_trajectory", trajectory({{"head_pan", 1.4}}, 14.0));
  ASSERT_TRUE(user.waitForPanBeyond(0.1));
  user.publish("joint_trajectory", JointTrajectory());
  const std::size_t requests = user.jointRequests();
  // From the first message that shows it standing, it stays there.
  user.joints.messages().clear();
  ASSERT_TRUE(user.joints.messages().waitFor(
      [](const JointState& state) { return std::abs(state.velocity.at(1)) < 0.03 && state.name.at(1) == "head_pan"; }));
  const double first = user.joints.position("head_pan");
  user.joints.messages().clear();
  user.joints.messages().waitForCount(15);
  EXPECT_NEAR(user.joints.position("head_pan"), first, JointListener::kTolerance);
  EXPECT_LE(user.jointRequests(), requests + 4);
}

TEST(Motors, OffKeepJointsFromMovingUntilTheyAreOnAgain) {
  JointUser user("/motors");
  const std_srvs::SetBool::Response off = user.setMotors(false);
  EXPECT_TRUE(off.success) << off.message;
  EXPECT_THAT(off.message, HasSubstr("off"));
  const double before = user.joints.position("head_pan");
  user.publish("joint_command", command({{"head_pan", 0.5}}));
  user.waitForWarning("motors are off");
  EXPECT_NEAR(user.joints.position("head_pan"), before, JointListener::kTolerance);
  const std_srvs::SetBool::Response on = user.setMotors(true);
  EXPECT_TRUE(on.success) << on.message;
  user.publish("joint_command", command({{"head_pan", 0.5}}));
  EXPECT_TRUE(user.joints.waitForPosition("head_pan", 0.5));
}

TEST(Motors, ACallThatFailsEndsTheTrajectoryToo) {
  JointUser user("/motors_refused", kQuick, {"--protocol-version", "1"});
  user.publish("joint_trajectory", trajectory({{"head_pan", 1.4}}, 14.0));
  ASSERT_TRUE(user.waitForPanBeyond(0.1));
  EXPECT_FALSE(user.setMotors(false).success) << "version 1 has no such request";
  user.waitForWarning("trajectory of head_pan ends early");
}

TEST(PlayMotion, IsNotSlowedDownByTheApproachOfACommandBefore) {
  JointUser user("/motion_after_approach", {"_stream_on_start:=false"});
  user.publish("joint_command", command({{"neck_tilt", -0.2}}));
  ASSERT_TRUE(user.joints.waitForPosition("neck_tilt", -0.2));
  EXPECT_LE(user.joints.highestSpeed("neck_tilt"), 0.5 + kSpeedTolerance) << "that was the approach";
  aibo_driver::PlayMotion motion;
  motion.request.name = "nod";
  motion.request.repetitions = 1;
  ASSERT_TRUE(ros::service::call("/motion_after_approach/play_motion", motion));
  ASSERT_TRUE(motion.response.success) << motion.response.message;
  EXPECT_TRUE(user.joints.messages().waitFor([](const JointState& state) {
    const auto neck = std::find(state.name.begin(), state.name.end(), "neck_tilt") - state.name.begin();
    return std::abs(state.velocity.at(static_cast<std::size_t>(neck))) > 0.7;
  }));
}

TEST(PlayMotion, KeepsTheSpeedLimitOfTheParameter) {
  JointUser user("/motion_limit", {"_stream_on_start:=false", "_motion_speed_limit:=0.3"});
  aibo_driver::PlayMotion motion;
  motion.request.name = "nod";
  motion.request.repetitions = 1;
  ASSERT_TRUE(ros::service::call("/motion_limit/play_motion", motion));
  ASSERT_TRUE(motion.response.success) << motion.response.message;
  ASSERT_TRUE(user.joints.messages().waitFor(
      [](const JointState& state) { return test_support::speedOf(state, "neck_tilt").value_or(0) > 0.2; }));
  EXPECT_TRUE(user.joints.waitForSpeedBelow("neck_tilt", 0.03));
  EXPECT_LE(user.joints.highestSpeed("neck_tilt"), 0.3 + kSpeedTolerance);
}

TEST(Diagnostics, SayHowOftenTheJointsAreMeasured) {
  DiagnosticsListener diagnostics;
  const JointUser user("/joint_diagnostics");
  const auto status = diagnostics.waitFor("joint_diagnostics/aibo_driver: joints", [](const auto& s) {
    return s.level == diagnostic_msgs::DiagnosticStatus::OK;
  });
  EXPECT_THAT(status.message, HasSubstr("measurements/s"));
  EXPECT_EQ(DiagnosticsListener::value(status, "robot"), "ERS-7");
  for (int seconds = 0; seconds < 4; ++seconds) {
    diagnostics.waitForNext(status.name);
  }
  const auto later = diagnostics.waitFor(status.name, [](const auto& s) {
    return std::stod(DiagnosticsListener::value(s, "measurements per second")) > 20;
  });
  EXPECT_FALSE(later.name.empty()) << "how many came in the last second, not since the start";
}

TEST(OldServer, MovesJointsDuringTheStream) {
  TopicListener<sensor_msgs::CompressedImage> pictures("/old/camera/image_raw/compressed");
  DiagnosticsListener diagnostics;
  JointUser user("/old", {"_joint_speed_limit:=20", "_approach_speed:=20"}, {"--protocol-version", "1"});
  const auto connected =
      user.connection.waitFor([](const Connection& message) { return message.state == Connection::CONNECTED; });
  ASSERT_TRUE(connected);
  EXPECT_EQ(connected->protocol_version, 1);
  ASSERT_FALSE(pictures.waitForCount(10).empty());

  const Posture posture = postureOf(5);
  user.publish("joint_command", command(posture));
  EXPECT_THAT(user.joints.waitForPositions(posture), IsEmpty());
  EXPECT_GE(pictures.waitForCount(pictures.count() + 30).size(), 40u) << "the stream goes on";
  const auto state = user.joints.messages().waitForNext();
  ASSERT_TRUE(state);
  EXPECT_THAT(state->effort, IsEmpty()) << "version 1 has no duties";
  const auto stream = diagnostics.waitForNext("old/aibo_driver: stream");
  EXPECT_EQ(DiagnosticsListener::value(stream, "pictures damaged"), "0");
  EXPECT_EQ(user.proxy.connections(), 1u);
}

}  // namespace
