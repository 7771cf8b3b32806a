// The driver's node with a robot that attacks it. AIBO_WHOLE_CAMPAIGN makes each attack longer.

#include <aibo_driver/Sound.h>
#include <gmock/gmock.h>
#include <ros/ros.h>
#include <sensor_msgs/BatteryState.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/JointState.h>
#include <time.h>

#include <chrono>
#include <cmath>
#include <string>
#include <thread>

#include "hostile/attacks.h"
#include "support/picture_server.h"
#include "support/resources.h"
#include "support/ros/diagnostics_listener.h"
#include "support/ros/driver_process.h"
#include "support/ros/topic_listener.h"
#include "support/whole_campaign.h"

namespace {

using hostile::RobotAttack;
using std::chrono::milliseconds;
using std::chrono::steady_clock;
using test_support::DiagnosticsListener;
using test_support::DriverProcess;
using test_support::PictureServer;
using test_support::Resources;
using test_support::TopicListener;
using test_support::wantsWholeCampaign;
using ::testing::HasSubstr;

double processorSeconds(pid_t process) {
  clockid_t clock = 0;
  timespec time = {};
  if (::clock_getcpuclockid(process, &clock) == 0) {
    ::clock_gettime(clock, &time);
  }
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// A driver, a server that behaves well at first, and subscribers of everything.
class Hostile : public testing::TestWithParam<int> {
 protected:
  static constexpr std::size_t kMostLog = 64 * 1024;     // bytes, for an attack
  static constexpr std::size_t kMostMemory = 48 * 1024;  // KB more than before all attacks
  static constexpr double kMostSpeed = 70;               // rad/s; three times the tail's, and noise
  static constexpr double kFarthest = 2.6;               // rad; the rotators, and 0.2

  milliseconds attackTime() const { return milliseconds(wantsWholeCampaign() ? 5000 : 400); }

  bool goesOn() { return pictures_.waitForNext() && joints_.waitForNext() && images_.waitForNext(); }

  void attack(const RobotAttack& attack) {
    ASSERT_TRUE(goesOn()) << "before the attack";
    joints_.clear();
    battery_.clear();
    sounds_.clear();
    const std::size_t log = driver_.output().size();
    const double work = processorSeconds(driver_.pid());
    const auto begin = steady_clock::now();
    server_.misbehave(attack.begin(1));
    std::this_thread::sleep_for(attackTime());
    server_.misbehave({});
    ASSERT_TRUE(driver_.isRunning()) << driver_.output();
    EXPECT_TRUE(goesOn()) << "after the attack";
    const double seconds = std::chrono::duration<double>(steady_clock::now() - begin).count();
    judgeMessages(seconds);
    EXPECT_LT(driver_.output().size() - log, kMostLog);
    if (wantsWholeCampaign()) {
      EXPECT_LT(processorSeconds(driver_.pid()) - work, 2.5 * seconds) << "processors";
    }
    if (test_support::kMemoryCounts) {
      const Resources now = Resources::of(std::to_string(driver_.pid()));
      EXPECT_LT(now.resident_kilobytes, before_.resident_kilobytes + kMostMemory);
    }
  }

  void judgeMessages(double seconds) {
    const auto joints = joints_.waitForCount(0);
    // Twice the rate, and a burst for each of a few connections.
    EXPECT_LT(static_cast<double>(joints.size()), 2 * 31.25 * seconds + 64 * 15);
    const ros::Time now = ros::Time::now();
    for (const auto& message : joints) {
      EXPECT_LE(message->header.stamp, now);
      for (const double position : message->position) {
        EXPECT_LT(std::abs(position), kFarthest);
      }
      for (const double velocity : message->velocity) {
        EXPECT_LT(std::abs(velocity), kMostSpeed);
      }
    }
    // Twice the frames, and a second for each of a few connections.
    EXPECT_LT(static_cast<double>(sounds_.count()), 2 * 125 * seconds + 125 * 15);
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

TEST_P(Hostile, RobotsThatMeasureTheImpossibleAreInTheDiagnostics) {
  server_.setTelemetry(true);
  ASSERT_TRUE(goesOn());
  DiagnosticsListener diagnostics;
  server_.misbehave(hostile::findRobotAttack("values", GetParam()).begin(1));
  const auto status = diagnostics.waitFor(name_.substr(1) + "/aibo_driver: joints", [](const auto& each) {
    return each.message.find("impossible values dropped") != std::string::npos;
  });
  EXPECT_EQ(status.level, diagnostic_msgs::DiagnosticStatus::WARN) << status.message;
  EXPECT_GT(std::stoi(DiagnosticsListener::value(status, "impossible values dropped")), 0);
  if (GetParam() == 2) {  // with version 1, what nobody asked for fills the log first
    EXPECT_THAT(driver_.output(), HasSubstr("sent an impossible value, which is dropped: "));
  }
}

TEST(HostileTelemetry, FloodsAreInTheDiagnostics) {
  PictureServer server(2, milliseconds(10));
  server.setTelemetry(true);
  DriverProcess driver("/flood", server.port());
  TopicListener<sensor_msgs::JointState> joints("/flood/joint_states");
  ASSERT_TRUE(joints.waitForNext());
  DiagnosticsListener diagnostics;
  server.misbehave(hostile::findRobotAttack("telemetry", 2).begin(1));
  const auto status = diagnostics.waitFor("flood/aibo_driver: joints", [](const auto& each) {
    return each.message.find("more than twice as many") != std::string::npos;
  });
  EXPECT_EQ(status.level, diagnostic_msgs::DiagnosticStatus::WARN) << status.message;
  EXPECT_THAT(driver.output(), HasSubstr("more than twice as often as it was asked to"));
}

}  // namespace
