// Listeners who come and go: messages are made only for those who are there, and nobody who comes misses the next one.

#include <aibo_driver/CameraState.h>
#include <aibo_driver/Connection.h>
#include <aibo_driver/LinkQuality.h>
#include <aibo_driver/MotionState.h>
#include <aibo_driver/Touch.h>
#include <diagnostic_msgs/DiagnosticArray.h>
#include <gtest/gtest.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/BatteryState.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/Range.h>
#include <std_msgs/Bool.h>
#include <tf2_msgs/TFMessage.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <algorithm>
#include <chrono>
#include <future>
#include <string>

#include "support/picture_server.h"
#include "support/ros/diagnostics_listener.h"
#include "support/ros/driver_process.h"
#include "support/ros/motion_states.h"
#include "support/ros/topic_listener.h"
#include "support/ros/topic_publishers.h"
#include "support/simulated_robot.h"

namespace {

using aibo_driver::Connection;
using aibo_driver::EndedMovement;
using aibo_driver::MotionState;
using aibo_driver::Movement;
using test_support::DiagnosticsListener;
using test_support::DriverProcess;
using test_support::lastEnd;
using test_support::PictureServer;
using test_support::SimulatedRobot;
using test_support::TopicListener;
using test_support::TopicPublishers;

class ListenersTest : public ::testing::TestWithParam<int> {
 protected:
  static bool hasWalk() { return GetParam() > 1; }

  /// @param name absolute, or in the driver's namespace
  std::string topic(const std::string& name) const { return name.front() == '/' ? name : namespace_ + "/" + name; }

  /// Somebody comes, gets a message, and goes.
  template <typename Message>
  void expectMessage(const std::string& name) const {
    EXPECT_FALSE(TopicListener<Message>(topic(name)).waitForCount(1).empty()) << name;
  }

  void expectTransform(const std::string& child_frame) const {
    const auto has_frame = [&child_frame](const tf2_msgs::TFMessage& message) {
      return std::any_of(message.transforms.begin(), message.transforms.end(),
                         [&child_frame](const auto& each) { return each.child_frame_id == child_frame; });
    };
    EXPECT_TRUE(TopicListener<tf2_msgs::TFMessage>("/tf").waitFor(has_frame)) << child_frame;
  }

  void expectAll() const {
    expectMessage<sensor_msgs::JointState>("joint_states");
    expectMessage<sensor_msgs::Range>("range/near");
    expectMessage<sensor_msgs::Imu>("imu/data_raw");
    expectMessage<aibo_driver::Touch>("touch");
    expectMessage<sensor_msgs::BatteryState>("battery");
    expectMessage<sensor_msgs::CompressedImage>("camera/image_raw/compressed");
    expectMessage<sensor_msgs::CameraInfo>("camera/camera_info");
    expectMessage<sensor_msgs::Image>("camera/image_raw");
    expectMessage<aibo_driver::LinkQuality>("link_quality");
    expectMessage<diagnostic_msgs::DiagnosticArray>("/diagnostics");
    expectTransform("listeners/base_link");
    expectTransform("listeners/base_footprint");
    if (hasWalk()) {
      expectMessage<nav_msgs::Odometry>("odom");
    }
  }

  void expectLatched() const {
    expectMessage<Connection>("connection");
    expectMessage<std_msgs::Bool>("streaming");
    expectMessage<MotionState>("motion_state");
    expectMessage<aibo_driver::CameraState>("camera/state");
  }

  const std::string namespace_ = "/listeners" + std::to_string(GetParam());
  SimulatedRobot robot_{{"--protocol-version", std::to_string(GetParam())}};
  DriverProcess driver_{namespace_, robot_.port(), {"_frame_prefix:=listeners"}};
};

TEST_P(ListenersTest, GetTheNextMessageHoweverLateTheyComeAndHoweverOften) {
  for (int i = 0; i < 2; ++i) {
    expectLatched();  // at first, nobody listens to anything else
    expectAll();
  }
}

// It needs to know where the joints are.
TEST_P(ListenersTest, AreNotNeededForATrajectory) {
  TopicListener<MotionState> motion_state(topic("motion_state"));
  TopicPublishers publishers(namespace_);
  trajectory_msgs::JointTrajectory trajectory;
  trajectory.joint_names = {"head_pan"};
  trajectory.points.resize(1);
  trajectory.points[0].positions = {0.3};
  trajectory.points[0].time_from_start = ros::Duration(0.5);
  const auto is_done = [](const MotionState& state) {
    return lastEnd(state).movement.kind == Movement::TRAJECTORY && lastEnd(state).how == EndedMovement::DONE;
  };
  bool is_there = false;
  // Again, until the robot has reported its joints. A new trajectory replaces the last one, so a busy computer needs
  // more time for each.
  for (int i = 1; i < 10 && !is_there; ++i) {
    publishers.publish("joint_trajectory", trajectory);
    is_there = motion_state.waitFor(is_done, std::chrono::seconds(i)) != nullptr;
  }
  EXPECT_TRUE(is_there);
}

TEST(ListenersOfDiagnostics, AreNotToldOfDamageBeforeTheyCame) {
  PictureServer server(2, std::chrono::milliseconds(20));
  TopicListener<aibo_driver::LinkQuality> seconds("/late/link_quality");
  TopicListener<sensor_msgs::CompressedImage> pictures("/late/camera/image_raw/compressed");
  const DriverProcess driver("/late", server.port(), {"_use_robot_time:=false", "_read_timeout:=20"});
  ASSERT_FALSE(pictures.waitForCount(1).empty());
  std::promise<void> damaged;
  server.spoilNext([&damaged](test_support::Bytes jpeg) {
    damaged.set_value();
    jpeg.resize(jpeg.size() / 2);
    return jpeg;
  });
  ASSERT_EQ(damaged.get_future().wait_for(test_support::kSafetyNet), std::future_status::ready);
  pictures.clear();
  ASSERT_GE(pictures.waitForCount(20).size(), 20U) << "the damaged one comes before them";
  seconds.clear();
  ASSERT_GE(seconds.waitForCount(2).size(), 2U);
  const auto status = DiagnosticsListener().waitForNext("late/aibo_driver: stream");
  EXPECT_EQ(DiagnosticsListener::value(status, "pictures damaged"), "1");
  EXPECT_EQ(status.message.find("damaged"), std::string::npos) << status.message;
}

INSTANTIATE_TEST_SUITE_P(Versions, ListenersTest, ::testing::Values(1, 2));

}  // namespace
