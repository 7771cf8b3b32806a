// How the driver recovers from faults of robot and network.

#include <aibo_driver/CameraState.h>
#include <aibo_driver/Connection.h>
#include <aibo_driver/LinkQuality.h>
#include <aibo_driver/RobotState.h>
#include <gmock/gmock.h>
#include <ros/ros.h>
#include <sensor_msgs/CompressedImage.h>

#include <chrono>
#include <cmath>
#include <memory>
#include <string>

#include "support/ros/diagnostics_listener.h"
#include "support/ros/driver_process.h"
#include "support/ros/topic_listener.h"
#include "support/scripted_server.h"
#include "support/simulated_robot.h"

namespace {

using aibo_driver::Connection;
using test_support::DiagnosticsListener;
using test_support::DriverProcess;
using test_support::SimulatedRobot;
using test_support::TopicListener;
using ::testing::HasSubstr;
using ::testing::Not;

using CompressedListener = TopicListener<sensor_msgs::CompressedImage>;

TopicListener<Connection>::ConstPtr waitForState(TopicListener<Connection>& connection, std::uint8_t state) {
  return connection.waitFor([state](const Connection& message) { return message.state == state; });
}

TEST(Recovery, PicturesComeAgainAfterTheReturnOfAKilledRobot) {
  SimulatedRobot robot;
  CompressedListener pictures("/killed/camera/image_raw/compressed");
  TopicListener<aibo_driver::CameraState> camera_states("/killed/camera/state");
  TopicListener<Connection> connection("/killed/connection");
  DriverProcess driver("/killed", robot.port());
  ASSERT_FALSE(pictures.waitForCount(1).empty());
  for (int round = 0; round < 3; ++round) {
    connection.clear();
    robot.kill();
    const auto lost = waitForState(connection, Connection::DISCONNECTED);
    ASSERT_TRUE(lost);
    EXPECT_NE(lost->reason, "");
    EXPECT_NE(lost->advice, "");
    EXPECT_EQ(lost->transport, "");
    pictures.clear();
    camera_states.clear();
    robot.restart();
    EXPECT_FALSE(pictures.waitForCount(1).empty()) << "round " << round;
    EXPECT_FALSE(camera_states.waitForCount(1).empty()) << "it tells when this robot was switched on";
    EXPECT_TRUE(waitForState(connection, Connection::CONNECTED));
  }
  EXPECT_TRUE(driver.isRunning());
}

TEST(Recovery, TheFirstAttemptIsNoFaultUntilItHasEnded) {
  const test_support::ScriptedServer silent;
  TopicListener<Connection> connection("/first/connection");
  DiagnosticsListener diagnostics;
  DriverProcess driver("/first", silent.port(), {"_connect_timeout:=60", "_read_timeout:=60"});
  const auto trying = waitForState(connection, Connection::CONNECTING);
  ASSERT_TRUE(trying);
  EXPECT_EQ(trying->text, "connecting to 127.0.0.1:" + std::to_string(silent.port()));
  const auto status = diagnostics.waitForNext("first/aibo_driver: connection");
  EXPECT_EQ(status.level, diagnostic_msgs::DiagnosticStatus::WARN);
  EXPECT_EQ(status.message, trying->text);
}

TEST(Recovery, ADriverWithoutARobotWaitsForItAndSaysWhatToCheck) {
  auto robot = std::make_unique<SimulatedRobot>();
  robot->kill();
  CompressedListener pictures("/absent/camera/image_raw/compressed");
  TopicListener<Connection> connection("/absent/connection");
  DiagnosticsListener diagnostics;
  DriverProcess driver("/absent", robot->port());
  const auto failed = connection.waitFor([](const Connection& message) { return !message.reason.empty(); });
  ASSERT_TRUE(failed);
  EXPECT_THAT(failed->text, HasSubstr("127.0.0.1:" + std::to_string(robot->port())));
  EXPECT_NE(failed->advice, "");
  EXPECT_EQ(failed->host, "127.0.0.1");
  EXPECT_EQ(failed->port, robot->port());
  EXPECT_EQ(failed->protocol_version, 0);
  EXPECT_LT(std::abs((ros::Time::now() - failed->header.stamp).toSec()), 20);
  const auto unknown = TopicListener<aibo_driver::RobotState>("/absent/robot_state").waitForNext();
  EXPECT_TRUE(unknown && unknown->motors == aibo_driver::RobotState::UNKNOWN) << "it is latched";
  EXPECT_TRUE(unknown && std::abs((ros::Time::now() - unknown->header.stamp).toSec()) < 20);
  const auto quality = TopicListener<aibo_driver::LinkQuality>("/absent/link_quality").waitForNext();
  EXPECT_TRUE(quality && quality->transport.empty());
  const auto status = diagnostics.waitFor("absent/aibo_driver: connection", [](const auto& s) {
    return s.level == diagnostic_msgs::DiagnosticStatus::ERROR;
  });
  EXPECT_THAT(status.message, HasSubstr(failed->advice));
  robot->restart();
  EXPECT_FALSE(pictures.waitForCount(1).empty());
  const auto connected = waitForState(connection, Connection::CONNECTED);
  ASSERT_TRUE(connected);
  EXPECT_EQ(connected->protocol_version, 2);
  EXPECT_EQ(connected->robot, "ERS-7");
  EXPECT_EQ(connected->reason, "");
  EXPECT_TRUE(driver.isRunning());
}

}  // namespace
