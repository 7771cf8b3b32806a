// The driver's node with a robot that attacks it.

#include <aibo_driver/Sound.h>
#include <gmock/gmock.h>
#include <ros/ros.h>
#include <sensor_msgs/BatteryState.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/JointState.h>

#include <chrono>
#include <cmath>
#include <string>
#include <thread>

#include "hostile/attacks.h"
#include "support/picture_server.h"
#include "support/resources.h"
#include "support/ros/driver_process.h"
#include "support/ros/topic_listener.h"

namespace {

using hostile::RobotAttack;
using std::chrono::milliseconds;
using test_support::DriverProcess;
using test_support::PictureServer;
using test_support::Resources;
using test_support::TopicListener;

/// A driver, a server that behaves well at first, and subscribers of everything.
class Hostile : public testing::TestWithParam<int> {
 protected:
  static constexpr milliseconds kAttackTime{400};
  static constexpr std::size_t kMostLog = 64 * 1024;     // bytes, for an attack
  static constexpr std::size_t kMostMemory = 48 * 1024;  // KB more than before all attacks
  static constexpr double kMostSpeed = 70;               // rad/s; three times the tail's, and noise
  static constexpr double kFarthest = 2.6;               // rad; the rotators, and 0.2

  bool goesOn() { return pictures_.waitForNext() && joints_.waitForNext() && images_.waitForNext(); }

  void attack(const RobotAttack& attack) {
    ASSERT_TRUE(goesOn()) << "before the attack";
    joints_.clear();
    battery_.clear();
    const std::size_t log = driver_.output().size();
    server_.flood(attack.begin(1));
    std::this_thread::sleep_for(kAttackTime);
    server_.flood(nullptr);
    ASSERT_TRUE(driver_.isRunning()) << driver_.output();
    EXPECT_TRUE(goesOn()) << "after the attack";
    judgeMessages();
    EXPECT_LT(driver_.output().size() - log, kMostLog);
    if (test_support::kMemoryCounts) {
      const Resources now = Resources::of(std::to_string(driver_.pid()));
      EXPECT_LT(now.resident_kilobytes, before_.resident_kilobytes + kMostMemory);
    }
  }

  void judgeMessages() {
    const ros::Time now = ros::Time::now();
    for (const auto& message : joints_.waitForCount(0)) {
      EXPECT_LE(message->header.stamp, now);
      for (const double position : message->position) {
        EXPECT_LT(std::abs(position), kFarthest);
      }
      for (const double velocity : message->velocity) {
        EXPECT_LT(std::abs(velocity), kMostSpeed);
      }
    }
    for (const auto& message : battery_.waitForCount(0)) {
      EXPECT_LE(message->percentage, 1.05F);
    }
  }

  const std::string name_ = "/hostile" + std::to_string(GetParam());
  PictureServer server_{GetParam(), milliseconds(10)};
  TopicListener<sensor_msgs::CompressedImage> pictures_{name_ + "/camera/image_raw/compressed"};
  TopicListener<sensor_msgs::Image> images_{name_ + "/camera/image_raw"};
  TopicListener<sensor_msgs::JointState> joints_{name_ + "/joint_states"};
  TopicListener<sensor_msgs::BatteryState> battery_{name_ + "/battery"};
  TopicListener<aibo_driver::Sound> sounds_{name_ + "/microphone"};
  DriverProcess driver_{name_, server_.port(), {"_adaptive:=true"}};
  Resources before_;
};

INSTANTIATE_TEST_SUITE_P(Versions, Hostile, testing::Values(1, 2));

TEST_P(Hostile, RobotsDoNotHarmTheDriver) {
  server_.setTelemetry(true);
  ASSERT_TRUE(goesOn());
  before_ = Resources::of(std::to_string(driver_.pid()));
  for (const RobotAttack& each : hostile::robotAttacks()) {
    if (each.version == GetParam()) {
      SCOPED_TRACE(each.name);
      pictures_.clear();
      images_.clear();
      attack(each);
    }
  }
}

}  // namespace
