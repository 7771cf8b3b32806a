// A robot that is not of the kind in the driver's parameter.

#include <diagnostic_msgs/DiagnosticStatus.h>
#include <gmock/gmock.h>
#include <sensor_msgs/CameraInfo.h>

#include <cmath>

#include "support/ros/diagnostics_listener.h"
#include "support/ros/driver_user.h"
#include "support/ros/joint_messages.h"

namespace {

using test_support::kSafetyNet;

TEST(WrongRobot, GetsNoCommandsAndTheReasonIsSaid) {
  test_support::SimulatedRobot robot;
  test_support::TopicListener<sensor_msgs::CameraInfo> camera_infos("/wrong/camera/camera_info");
  test_support::DiagnosticsListener diagnostics;
  test_support::DriverProcess driver("/wrong", robot.port(), {"_robot:=ERS-210"});
  test_support::TopicPublishers user("/wrong");
  const auto status = diagnostics.waitFor("wrong/aibo_driver: joints", [](const auto& joint_status) {
    return joint_status.level == diagnostic_msgs::DiagnosticStatus::ERROR;
  });
  EXPECT_THAT(status.message, testing::HasSubstr("commands are refused: the robot says that it is an ERS-7"));
  const std::string reason = "the robot says that it is an ERS-7, but the driver's parameter robot is ERS-210";
  user.publish("joint_command", test_support::command({{"head_pan", 0.5}}));
  EXPECT_NO_THROW(driver.waitForOutput("is refused: " + reason, kSafetyNet));
  const auto info = camera_infos.waitForNext();
  EXPECT_TRUE(info && std::abs(info->K[0] - 189.2) < 0.1) << "that of an ERS-210";
}

}  // namespace
