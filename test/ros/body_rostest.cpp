// The robot's body except its joints: sensors and LEDs.

#include <aibo_driver/LedStates.h>
#include <aibo_driver/Leds.h>
#include <aibo_driver/PlayMotion.h>
#include <aibo_driver/Touch.h>
#include <gmock/gmock.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <sensor_msgs/BatteryState.h>
#include <sensor_msgs/Imu.h>
#include <tf2_msgs/TFMessage.h>

#include <cmath>

#include "support/ros/driver_user.h"

namespace {

using aibo_driver::LedStates;
using sensor_msgs::BatteryState;
using sensor_msgs::Imu;
using test_support::TopicListener;

// All tests share a master, and this topic has the same name for all drivers.
std::string ownTf(const std::string& name_space) {
  return "/tf:=" + name_space + "/tf";
}

class BodyUser : public test_support::DriverUser {
 public:
  explicit BodyUser(const std::string& name_space, const std::vector<std::string>& robot_options = {})
      : test_support::DriverUser(name_space, {"_stream_on_start:=false", ownTf(name_space)}, robot_options) {}
};

// The transforms from base_footprint to base_link.
class Footprints {
 public:
  explicit Footprints(const std::string& name_space) : listener_(name_space + "/tf") {}

  /// Waits for one with a height and a pitch between these limits.
  bool waitFor(double lowest, double highest, double lowest_pitch, double highest_pitch) {
    return listener_.waitFor([=](const tf2_msgs::TFMessage& message) {
      const geometry_msgs::TransformStamped& each = message.transforms.front();
      const auto& rotation = each.transform.rotation;
      const double height = each.transform.translation.z;
      const double pitch = std::asin(2 * (rotation.w * rotation.y - rotation.z * rotation.x)) * 180 / M_PI;
      return each.header.frame_id == "rex/base_footprint" && each.child_frame_id == "rex/base_link" &&
             height > lowest && height < highest && pitch > lowest_pitch && pitch < highest_pitch;
    }) != nullptr;
  }

  std::size_t count() const { return listener_.count(); }

 private:
  TopicListener<tf2_msgs::TFMessage> listener_;
};

TEST(Footprint, OfARobotThatStandsAndThenSitsIsUnderItsFeet) {
  Footprints footprints("/footprint");
  BodyUser user("/footprint");
  EXPECT_TRUE(footprints.waitFor(0.12, 0.15, -3, 3));
  aibo_driver::PlayMotion::Request sit;
  sit.name = "sit";
  EXPECT_TRUE(user.call<aibo_driver::PlayMotion>("play_motion", sit).success);
  EXPECT_TRUE(footprints.waitFor(0.08, 0.13, -28, -22)) << "leaning back by 25 degrees";
}

TEST(Footprint, IsNotPublishedIfItIsNotWanted) {
  test_support::SimulatedRobot robot;
  Footprints footprints("/no_footprint");
  TopicListener<Imu> accelerations("/no_footprint/imu/data_raw");
  TopicListener<nav_msgs::Odometry> odom("/no_footprint/odom");
  test_support::DriverProcess driver("/no_footprint", robot.port(),
                                     {"_publish_footprint:=false", "_publish_odom_tf:=false", ownTf("/no_footprint")});
  ASSERT_GE(accelerations.waitForCount(30).size(), 30u);
  ASSERT_TRUE(odom.waitForNext());
  EXPECT_EQ(footprints.count(), 0u) << "neither the footprint nor the odometry";
}

TEST(Sensors, FollowWhatTheRobotFeels) {
  for (const std::string version : {"1", "2"}) {
    const std::string name_space = "/feels" + version;
    const BodyUser user(name_space, {"--protocol-version", version});
    TopicListener<aibo_driver::Touch> touch(name_space + "/touch");
    TopicListener<BatteryState> battery(name_space + "/battery");
    TopicListener<Imu> accelerations(name_space + "/imu/data_raw");
    EXPECT_TRUE(accelerations.waitFor([](const Imu& each) { return each.linear_acceleration.z > 8; })) << version;
    ASSERT_THAT(user.robot.type("press chin"), testing::HasSubstr("ok"));
    EXPECT_TRUE(touch.waitFor([](const aibo_driver::Touch& each) { return each.chin && !each.back_rear; })) << version;
    ASSERT_THAT(user.robot.type("battery 40"), testing::HasSubstr("ok"));
    EXPECT_TRUE(battery.waitFor([](const BatteryState& each) { return std::abs(each.percentage - 0.4) < 0.02; }))
        << version;
  }
}

TEST(LedStatesTopic, FollowsWhatTheRobotAcceptedAndTheConnection) {
  const auto are_all = [](float intensity) {
    return [=](const LedStates& states) {
      return std::all_of(states.intensities.begin(), states.intensities.end(),
                         [=](float each) { return each == intensity || (std::isnan(each) && std::isnan(intensity)); });
    };
  };
  BodyUser user("/led_states");
  TopicListener<LedStates> states("/led_states/led_states");
  ASSERT_TRUE(states.waitFor(are_all(0)));
  aibo_driver::Leds message;
  message.names = {"face_1", "wireless"};
  message.intensities = {0.2F};
  message.mode = aibo_driver::Leds::MODE_B;
  user.publish("leds", message);
  const auto shown = states.waitFor([](const LedStates& each) { return each.intensities.at(5) == 1; });
  ASSERT_TRUE(shown);
  EXPECT_EQ(shown->names.at(6), "face_1");
  EXPECT_FLOAT_EQ(shown->intensities.at(6), 0.2F);
  EXPECT_EQ(shown->modes.at(6), LedStates::MODE_B);
  user.robot.kill();
  EXPECT_TRUE(states.waitFor(are_all(NAN)));
}

}  // namespace
