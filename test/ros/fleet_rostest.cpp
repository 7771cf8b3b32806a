// Several robots on one ROS master, and a robot that is not the one that the driver was told.

#include <diagnostic_msgs/DiagnosticStatus.h>
#include <gmock/gmock.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/Range.h>
#include <sensor_msgs/SetCameraInfo.h>
#include <signal.h>
#include <std_msgs/Float64.h>
#include <tf2_msgs/TFMessage.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "support/good_calibration.h"
#include "support/process.h"
#include "support/ros/diagnostics_listener.h"
#include "support/ros/driver_process.h"
#include "support/ros/joint_listener.h"
#include "support/ros/joint_messages.h"
#include "support/ros/topic_listener.h"
#include "support/ros/topic_publishers.h"
#include "support/simulated_robot.h"
#include "support/temporary_folder.h"

namespace {

using test_support::DiagnosticsListener;
using test_support::DriverProcess;
using test_support::JointListener;
using test_support::Process;
using test_support::SimulatedRobot;
using test_support::TemporaryFolder;
using test_support::TopicListener;
using test_support::TopicPublishers;
using ::testing::HasSubstr;

constexpr std::chrono::seconds kTimeToStart{60};

const std::vector<std::string> kNames = {"rex", "laika", "fido", "bello"};

std_msgs::Float64 position(double radians) {
  std_msgs::Float64 message;
  message.data = radians;
  return message;
}

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
    EXPECT_THAT(fleet_->output(), ::testing::Not(HasSubstr("new node registered with same name")));
    fleet_.reset();
    robots_.clear();
    home_.reset();
  }

  template <typename Message>
  static std::string frameOf(const std::string& topic) {
    TopicListener<Message> listener(topic);
    const auto messages = listener.waitForCount(1, kTimeToStart);
    return messages.empty() ? "no message on " + topic : messages.front()->header.frame_id;
  }

  static std::vector<std::unique_ptr<SimulatedRobot>> robots_;
  static std::unique_ptr<TemporaryFolder> home_;
  static std::unique_ptr<Process> fleet_;
};

std::vector<std::unique_ptr<SimulatedRobot>> FleetTest::robots_;
std::unique_ptr<TemporaryFolder> FleetTest::home_;
std::unique_ptr<Process> FleetTest::fleet_;

TEST_F(FleetTest, EveryMessageIsInAFrameOfItsOwnRobot) {
  for (const std::string& name : kNames) {
    EXPECT_EQ(frameOf<sensor_msgs::CameraInfo>("/" + name + "/camera/camera_info"), name + "/camera_optical_frame");
    EXPECT_EQ(frameOf<sensor_msgs::Imu>("/" + name + "/imu/data_raw"), name + "/imu_link");
    EXPECT_EQ(frameOf<sensor_msgs::Range>("/" + name + "/range/chest"), name + "/range_chest_link");
  }
}

TEST_F(FleetTest, TheLinksOfEachRobotHaveFramesOfTheirOwnInOneTree) {
  std::map<std::string, std::set<std::string>> parents;  // of each frame
  for (const std::string topic : {"/tf", "/tf_static"}) {
    TopicListener<tf2_msgs::TFMessage> transforms(topic);
    const std::vector<std::string> links =
        topic == "/tf" ? std::vector<std::string>{"/head_pan_link", "/base_link", "/base_footprint"}
                       : std::vector<std::string>{"/imu_link", "/odom"};
    for (const std::string& name : kNames) {
      for (const std::string& link : links) {
        EXPECT_TRUE(transforms.waitFor([&](const tf2_msgs::TFMessage& message) {
          return std::any_of(message.transforms.begin(), message.transforms.end(),
                             [&](const auto& transform) { return transform.child_frame_id == name + link; });
        })) << name
            << link;
      }
    }
    for (const auto& message : transforms.waitForCount(1)) {
      for (const auto& transform : message->transforms) {
        parents[transform.child_frame_id].insert(transform.header.frame_id);
      }
    }
  }
  for (const std::string& name : kNames) {
    std::string root = name + "/imu_link";
    for (int depth = 0; depth < 10 && parents.count(root) > 0; ++depth) {
      root = *parents[root].begin();
    }
    EXPECT_EQ(root, "fleet") << name << " does not stand in the frame of the fleet";
  }
  for (const auto& [child, all] : parents) {
    ASSERT_EQ(all.size(), 1u) << child << " has two parents, " << *all.begin() << " and " << *all.rbegin();
    const std::string robot = child.substr(0, child.find('/'));
    EXPECT_EQ(std::count(kNames.begin(), kNames.end(), robot), 1) << child;
    EXPECT_TRUE(*all.begin() == "fleet" || all.begin()->rfind(robot + "/", 0) == 0) << *all.begin();
  }
}

TEST_F(FleetTest, ACommandMovesOnlyItsRobot) {
  std::vector<std::unique_ptr<JointListener>> joints;
  for (const std::string& name : kNames) {
    joints.push_back(std::make_unique<JointListener>("/" + name));
    ASSERT_FALSE(joints.back()->messages().waitForCount(1, kTimeToStart).empty()) << name;
  }
  std::vector<double> before;
  for (const auto& listener : joints) {
    before.push_back(listener->position("head_pan"));
  }
  TopicPublishers laika("/laika");
  laika.publish("head_pan_position_controller/command", position(0.5));
  EXPECT_TRUE(joints[1]->waitForPosition("head_pan", 0.5));
  for (const std::size_t other : {0, 2, 3}) {
    EXPECT_NEAR(joints[other]->position("head_pan"), before[other], JointListener::kTolerance) << kNames[other];
  }
}

TEST_F(FleetTest, ACalibrationIsStoredForItsRobotAlone) {
  for (const std::string name : {"rex", "fido"}) {
    const std::string service = "/" + name + "/camera/set_camera_info";
    ASSERT_TRUE(ros::service::waitForService(service, ros::Duration(60)));
    sensor_msgs::SetCameraInfo call;
    call.request.camera_info = test_support::goodCalibration();
    ASSERT_TRUE(ros::service::call(service, call));
    EXPECT_THAT(call.response.status_message, HasSubstr("camera_info/" + name + ".yaml"));
  }
  TopicListener<sensor_msgs::CameraInfo> bello("/bello/camera/camera_info");
  const auto info = bello.waitForNext(kTimeToStart);
  ASSERT_TRUE(info);
  EXPECT_NEAR(info->K[0], 191.9, 0.1) << "the nominal one";
}

TEST(WrongRobot, GetsNoCommandsAndTheReasonIsSaid) {
  SimulatedRobot robot;
  JointListener joints("/wrong");
  TopicListener<sensor_msgs::CameraInfo> camera_infos("/wrong/camera/camera_info");
  DiagnosticsListener diagnostics;
  DriverProcess driver("/wrong", robot.port(), {"_robot:=ERS-210"});
  TopicPublishers user("/wrong");
  const auto status = diagnostics.waitFor("wrong/aibo_driver: joints", [](const auto& joint_status) {
    return joint_status.level == diagnostic_msgs::DiagnosticStatus::ERROR;
  });
  EXPECT_THAT(status.message, HasSubstr("commands are refused: the robot says that it is an ERS-7"));
  const std::string reason = "the robot says that it is an ERS-7, but the driver's parameter robot is ERS-210";
  user.publish("joint_command", test_support::command({{"head_pan", 0.5}}));
  EXPECT_NO_THROW(driver.waitForOutput("is refused: " + reason, kTimeToStart));
  trajectory_msgs::JointTrajectory trajectory;
  trajectory.joint_names = {"head_pan"};
  trajectory.points.resize(1);
  trajectory.points[0].positions = {0.5};
  trajectory.points[0].time_from_start = ros::Duration(2);
  user.publish("joint_trajectory", trajectory);
  EXPECT_NO_THROW(driver.waitForOutput("The trajectory of [a-z_]+ is refused: " + reason, kTimeToStart));
  EXPECT_THAT(driver.output(), HasSubstr("There is no model"));
  EXPECT_THAT(driver.output(), HasSubstr("commands are refused. Set the parameter, and start the driver again."));
  const auto info = camera_infos.waitForNext();
  EXPECT_TRUE(info && std::abs(info->K[0] - 189.2) < 0.1) << "that of an ERS-210";
}

TEST(WrongRobot, IsNotKnownToAVersion1Server) {
  SimulatedRobot robot({"--protocol-version", "1"});
  JointListener joints("/old");
  DriverProcess driver("/old", robot.port());
  TopicPublishers user("/old");
  ASSERT_FALSE(joints.messages().waitForCount(1).empty());
  user.publish("joint_command", test_support::command({{"head_pan", 0.3}}));
  EXPECT_TRUE(joints.waitForPosition("head_pan", 0.3));
}

}  // namespace
