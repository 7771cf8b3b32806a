// Stamps from the robot's own clock.

#include <aibo_driver/ColorRegions.h>
#include <gmock/gmock.h>
#include <ros/ros.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/JointState.h>

#include <cmath>
#include <cstddef>
#include <vector>

#include "support/ros/diagnostics_listener.h"
#include "support/ros/driver_process.h"
#include "support/ros/topic_listener.h"
#include "support/simulated_robot.h"

namespace {

using test_support::DriverProcess;
using test_support::SimulatedRobot;
using test_support::TopicListener;

constexpr double kFrame = 0.008;  // s
constexpr double kMost = 0.5;     // of the intervals; of random ones, an eighth would fit

/// What is stamped with the time of the robot.
class StampedTopics {
 public:
  StampedTopics(const std::string& name_space, const std::vector<std::string>& parameters)
      : pictures_(name_space + "/camera/image_raw/compressed"),
        states_(name_space + "/joint_states"),
        colors_(name_space + "/color_regions"),
        driver_(name_space, robot_.port(), parameters) {}

  /// Calls this with the next stamps of each topic.
  template <typename Check>
  void check(std::size_t count, Check check) {
    check("picture", stampsOf(pictures_, count));
    check("joints", stampsOf(states_, count));
    check("colours", stampsOf(colors_, count));
  }

 private:
  template <typename Message>
  static std::vector<ros::Time> stampsOf(TopicListener<Message>& topic, std::size_t count) {
    topic.clear();
    std::vector<ros::Time> stamps;
    for (const auto& message : topic.waitForCount(count)) {
      stamps.push_back(message->header.stamp);
    }
    EXPECT_GE(stamps.size(), count);
    return stamps;
  }

  SimulatedRobot robot_;
  TopicListener<sensor_msgs::CompressedImage> pictures_;
  TopicListener<sensor_msgs::JointState> states_;
  TopicListener<aibo_driver::ColorRegions> colors_;
  DriverProcess driver_;
};

// Whole within 0.5 ms. Interruptions of this computer spoil a few.
TEST(RobotTime, IntervalsOfPicturesJointStatesAndColoursAreWholeFrames) {
  StampedTopics topics("/robot_time", {});
  topics.check(60, [](const char*, const std::vector<ros::Time>&) {});  // by then the clock is known
  topics.check(100, [](const char* topic, const std::vector<ros::Time>& stamps) {
    double whole = 0;
    for (std::size_t i = 1; i < stamps.size(); ++i) {
      whole += std::abs(std::remainder((stamps[i] - stamps[i - 1]).toSec(), kFrame)) < 0.0005 ? 1 : 0;
    }
    EXPECT_GT(whole / static_cast<double>(stamps.size() - 1), kMost) << topic;
  });
}

TEST(RobotTime, IsNotUsedIfTheUserDoesNotWantIt) {
  test_support::DiagnosticsListener diagnostics;
  StampedTopics topics("/no_robot_time", {"_use_robot_time:=false"});
  topics.check(1, [](const char*, const std::vector<ros::Time>&) {});
  const auto stream = diagnostics.waitForNext("no_robot_time/aibo_driver: stream");
  EXPECT_EQ(test_support::DiagnosticsListener::value(stream, "timelines begun"), "0");
}

TEST(TimeOffset, IsAddedToEachStamp) {
  StampedTopics topics("/offset", {"_time_offset:=60"});
  const ros::Time begin = ros::Time::now();
  topics.check(1, [&begin](const char* topic, const std::vector<ros::Time>& stamps) {
    EXPECT_GT(stamps.front(), begin + ros::Duration(50)) << topic;
  });
}

}  // namespace
