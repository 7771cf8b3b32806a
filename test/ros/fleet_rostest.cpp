// Several robots on one ROS master, and a robot that is not the one that the driver was told.

#include <diagnostic_msgs/DiagnosticStatus.h>
#include <gmock/gmock.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <signal.h>
#include <std_msgs/Float64.h>
#include <tf2_msgs/TFMessage.h>

#include <cmath>

#include "support/ros/diagnostics_listener.h"
#include "support/ros/driver_user.h"
#include "support/ros/joint_listener.h"
#include "support/ros/joint_messages.h"
#include "support/temporary_folder.h"

namespace {

using test_support::JointListener;
using test_support::Process;
using test_support::SimulatedRobot;
using test_support::TemporaryFolder;
using test_support::TopicListener;

constexpr std::chrono::seconds kTimeToStart{60};

const std::vector<std::string> kNames = {"rex", "laika", "fido", "bello"};

// Four simulated robots, and their drivers as a user would start them.
class FleetTest : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    std::string text = "robots:\n";
    for (const std::string& name : kNames) {
      robots_.push_back(std::make_unique<SimulatedRobot>());
      text += "  " + name + ": {host: 127.0.0.1, port: " + std::to_string(robots_.back()->port()) + "}\n";
    }
    home_ = std::make_unique<TemporaryFolder>();
    home_->write("robots.yaml", text);
    fleet_ = std::make_unique<Process>(std::vector<std::string>{"roslaunch", "aibo_driver", "fleet.launch",
                                                                "robots:=" + home_->path("robots.yaml").string()},
                                       std::map<std::string, std::string>{{"ROS_HOME", home_->path().string()}});
  }

  static void TearDownTestSuite() {
    fleet_->signal(SIGINT);
    EXPECT_TRUE(fleet_->waitForExit(std::chrono::seconds(60))) << "Ctrl-C does not end the fleet";
    EXPECT_THAT(fleet_->output(), ::testing::Not(testing::HasSubstr("new node registered with same name")));
    fleet_.reset();
    robots_.clear();
    home_.reset();
  }

  static std::vector<std::unique_ptr<SimulatedRobot>> robots_;
  static std::unique_ptr<TemporaryFolder> home_;
  static std::unique_ptr<Process> fleet_;
};

std::vector<std::unique_ptr<SimulatedRobot>> FleetTest::robots_;
std::unique_ptr<TemporaryFolder> FleetTest::home_;
std::unique_ptr<Process> FleetTest::fleet_;

// From the root of the tree to its leaves.
TEST_F(FleetTest, TheLinksOfEachRobotHaveFramesOfTheirOwnInOneTree) {
  TopicListener<tf2_msgs::TFMessage> moving("/tf");
  TopicListener<tf2_msgs::TFMessage> fixed("/tf_static");
  const auto is_told = [](TopicListener<tf2_msgs::TFMessage>& transforms, const std::string& parent,
                          const std::string& child) {
    EXPECT_TRUE(transforms.waitFor(
        [&](const tf2_msgs::TFMessage& message) {
          return std::any_of(message.transforms.begin(), message.transforms.end(), [&](const auto& each) {
            return each.header.frame_id == parent && each.child_frame_id == child;
          });
        },
        kTimeToStart))
        << parent << " to " << child;
  };
  for (const std::string& name : kNames) {
    is_told(fixed, "fleet", name + "/odom");
    is_told(moving, name + "/odom", name + "/base_footprint");
    is_told(moving, name + "/base_footprint", name + "/base_link");
    is_told(fixed, name + "/base_link", name + "/imu_link");
  }
}

TEST_F(FleetTest, ACommandMovesOnlyItsRobot) {
  JointListener rex("/rex");
  JointListener laika("/laika");
  ASSERT_FALSE(rex.messages().waitForCount(1, kTimeToStart).empty());
  const double before = rex.position("head_pan");
  test_support::TopicPublishers user("/laika");
  EXPECT_TRUE(test_support::DriverUser::becomesTrue([&] {
    std_msgs::Float64 position;
    position.data = 0.5;
    user.publish("head_pan_position_controller/command", position);
    return laika.waitForPositions({{"head_pan", 0.5}}, std::chrono::seconds(5)).empty();
  }));
  EXPECT_NEAR(rex.position("head_pan"), before, JointListener::kTolerance);
}

TEST(WrongRobot, GetsNoCommandsAndTheReasonIsSaid) {
  SimulatedRobot robot;
  JointListener joints("/wrong");
  TopicListener<sensor_msgs::CameraInfo> camera_infos("/wrong/camera/camera_info");
  test_support::DiagnosticsListener diagnostics;
  test_support::DriverProcess driver("/wrong", robot.port(), {"_robot:=ERS-210"});
  test_support::TopicPublishers user("/wrong");
  const auto status = diagnostics.waitFor("wrong/aibo_driver: joints", [](const auto& joint_status) {
    return joint_status.level == diagnostic_msgs::DiagnosticStatus::ERROR;
  });
  EXPECT_THAT(status.message, testing::HasSubstr("commands are refused: the robot says that it is an ERS-7"));
  const std::string reason = "the robot says that it is an ERS-7, but the driver's parameter robot is ERS-210";
  user.publish("joint_command", test_support::command({{"head_pan", 0.5}}));
  EXPECT_NO_THROW(driver.waitForOutput("is refused: " + reason, kTimeToStart));
  const auto info = camera_infos.waitForNext();
  EXPECT_TRUE(info && std::abs(info->K[0] - 189.2) < 0.1) << "that of an ERS-210";
}

}  // namespace
