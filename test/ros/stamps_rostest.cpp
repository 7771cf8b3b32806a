// Stamps from the robot's own clock.

#include <aibo_driver/ColorRegions.h>
#include <gmock/gmock.h>
#include <ros/ros.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/JointState.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <vector>

#include "support/proxy/fault_proxy.h"
#include "support/ros/diagnostics_listener.h"
#include "support/ros/driver_process.h"
#include "support/ros/topic_listener.h"
#include "support/simulated_robot.h"

namespace {

using namespace std::chrono_literals;
using test_support::Action;
using test_support::DriverProcess;
using test_support::Fault;
using test_support::FaultProxy;
using test_support::kSafetyNet;
using test_support::SimulatedRobot;
using test_support::TopicListener;

using Pictures = TopicListener<sensor_msgs::CompressedImage>;
using JointStates = TopicListener<sensor_msgs::JointState>;

constexpr double kFrame = 0.008;  // s
constexpr double kMost = 0.5;     // of the intervals; of random ones, an eighth would fit

/// The share of the intervals between stamps that are whole numbers of frames, within 0.5 ms. Interruptions of this
/// computer spoil a few.
template <typename Message>
double partInFrames(const std::vector<boost::shared_ptr<const Message>>& messages) {
  std::size_t whole = 0;
  for (std::size_t i = 1; i < messages.size(); ++i) {
    const double interval = (messages[i]->header.stamp - messages[i - 1]->header.stamp).toSec();
    whole += std::abs(std::remainder(interval, kFrame)) < 0.0005 ? 1 : 0;
  }
  return static_cast<double>(whole) / static_cast<double>(messages.size() - 1);
}

TEST(RobotTime, IntervalsOfPicturesAndJointStatesAreWholeFrames) {
  SimulatedRobot robot;
  Pictures pictures("/robot_time/camera/image_raw/compressed");
  JointStates states("/robot_time/joint_states");
  TopicListener<aibo_driver::ColorRegions> colors("/robot_time/color_regions");
  DriverProcess driver("/robot_time", robot.port());
  pictures.waitForCount(60);
  pictures.clear();
  states.clear();
  EXPECT_GT(partInFrames(pictures.waitForCount(100)), kMost);
  EXPECT_GT(partInFrames(states.waitForCount(100)), kMost);
  EXPECT_GT(partInFrames(colors.waitForCount(100)), kMost);
}

TEST(RobotTime, IsNotUsedIfTheUserDoesNotWantIt) {
  SimulatedRobot robot;
  Pictures pictures("/no_robot_time/camera/image_raw/compressed");
  JointStates states("/no_robot_time/joint_states");
  TopicListener<aibo_driver::ColorRegions> colors("/no_robot_time/color_regions");
  test_support::DiagnosticsListener diagnostics;
  DriverProcess driver("/no_robot_time", robot.port(), {"_use_robot_time:=false"});
  ASSERT_FALSE(pictures.waitForCount(1).empty() || states.waitForCount(1).empty() || colors.waitForCount(1).empty());
  const auto stream = diagnostics.waitForNext("no_robot_time/aibo_driver: stream");
  EXPECT_EQ(test_support::DiagnosticsListener::value(stream, "timelines begun"), "0");
}

/// The longest interval between two stamps, in seconds.
template <typename Message>
double longestInterval(const std::vector<boost::shared_ptr<const Message>>& messages) {
  double longest = 0;
  for (std::size_t i = 1; i < messages.size(); ++i) {
    longest = std::max(longest, (messages[i]->header.stamp - messages[i - 1]->header.stamp).toSec());
  }
  return longest;
}

TEST(RobotTime, NoMeasurementIsLostWhenTheRadioIsHeldUpAndEachHasTheTimeOfItsFrame) {
  SimulatedRobot robot;
  FaultProxy proxy(robot.port());
  JointStates states("/robot_time_hold_up/joint_states");
  TopicListener<sensor_msgs::Imu> accelerations("/robot_time_hold_up/imu/data_raw");
  DriverProcess driver("/robot_time_hold_up", proxy.port(), {"_stream_on_start:=false", "_read_timeout:=20"});
  states.waitForCount(60);  // by then the clock is known
  Fault pause;
  pause.action = Action::kPause;
  pause.time = 300ms;
  double longest = 1;
  // A busy computer holds up the robot, too, which then measures less often: one time without that is enough.
  for (std::size_t i = 1; i <= 10 && longest > 0.048; ++i) {  // they come every 32 ms
    states.clear();
    accelerations.clear();
    proxy.add(pause);
    ASSERT_TRUE(proxy.waitForFaults(i, kSafetyNet));
    longest = std::max(longestInterval(states.waitForCount(40)), longestInterval(accelerations.waitForCount(40)));
  }
  EXPECT_LT(longest, 0.048);
  EXPECT_GT(partInFrames(states.waitForCount(40)), kMost);
}

TEST(RobotTime, StampsIncreaseAndBeginWithTheArrivalAgainWhenTheRobotWasRestarted) {
  SimulatedRobot robot;
  Pictures pictures("/robot_time_restart/camera/image_raw/compressed");
  DriverProcess driver("/robot_time_restart", robot.port());
  const auto before = pictures.waitForCount(60);
  ASSERT_GE(before.size(), 60u);
  robot.kill();
  pictures.clear();
  const ros::Time restart = ros::Time::now();
  robot.restart();
  const auto after = pictures.waitForCount(30);
  ASSERT_FALSE(after.empty());
  EXPECT_TRUE(std::is_sorted(after.begin(), after.end(),
                             [](const auto& a, const auto& b) { return a->header.stamp < b->header.stamp; }));
  EXPECT_GT(after.back()->header.stamp, before.back()->header.stamp);
  EXPECT_GT(after.back()->header.stamp, restart);
  EXPECT_LE(after.back()->header.stamp, ros::Time::now());
}

}  // namespace
