// Settings that can be changed while the driver runs, with dynamic_reconfigure.

#include <aibo_driver/CameraState.h>
#include <aibo_driver/LinkQuality.h>
#include <dynamic_reconfigure/ConfigDescription.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <gmock/gmock.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>

#include "ros/diagnostics_listener.h"
#include "ros/driver_user.h"
#include "support/ros/joints.h"

namespace {

using aibo_driver::CameraState;
using dynamic_reconfigure::Config;
using test_support::DiagnosticsListener;
using test_support::positionOf;
using test_support::TopicListener;

/// @param entries of the setting's type
template <typename Entries, typename Value>
Config change(Entries Config::*entries, const std::string& name, const Value& value) {
  Config config;
  (config.*entries).resize(1);
  (config.*entries)[0].name = name;
  (config.*entries)[0].value = value;
  return config;
}

class SettingsUser : public test_support::DriverUser {
 public:
  using test_support::DriverUser::DriverUser;

  /// @return the settings in force afterwards
  Config set(const Config& config) {
    dynamic_reconfigure::Reconfigure::Request request;
    request.config = config;
    return call<dynamic_reconfigure::Reconfigure>("aibo_driver/set_parameters", request).config;
  }

  /// NaN without this setting.
  static double valueOf(const Config& config, const std::string& name) {
    double value = std::numeric_limits<double>::quiet_NaN();
    for (const auto& entry : config.ints) {
      value = entry.name == name ? entry.value : value;
    }
    for (const auto& entry : config.doubles) {
      value = entry.name == name ? entry.value : value;
    }
    return value;
  }

  void waitForLog(const std::string& pattern) { driver.waitForOutput(pattern); }
};

struct Range {
  const char* name;
  bool is_whole;
  double lowest;
  double highest;
};

const Range kRanges[] = {{"jpeg_quality", true, 1, 100},
                         {"frame_rate", false, 2, 30},
                         {"max_picture_age", false, 0.05, 2},
                         {"telemetry_rate", false, 0, 31.25},
                         {"speed_scale", false, 0.1, 1},
                         {"white_balance", true, 1, 3},
                         {"gain", true, 1, 3},
                         {"shutter_speed", true, 1, 3}};

TEST(Settings, TellTheirRangesAndOutOfThemTakeTheNearestAllowedValue) {
  TopicListener<dynamic_reconfigure::ConfigDescription> descriptions("/settings/aibo_driver/parameter_descriptions");
  SettingsUser user("/settings", {"_stream_on_start:=false"});
  const auto description = descriptions.waitFor([&user](const auto& each) {
    return user.valueOf(each.min, "frame_rate") == 2 && user.valueOf(each.max, "jpeg_quality") == 100;
  });
  ASSERT_TRUE(description);
  for (const auto& [name, is_whole, lowest, highest] : kRanges) {
    const auto set = [&, name = name, is_whole = is_whole](double value) {
      return user.valueOf(user.set(is_whole ? change(&Config::ints, name, static_cast<int>(value))
                                            : change(&Config::doubles, name, value)),
                          name);
    };
    EXPECT_EQ(user.valueOf(description->min, name), lowest) << name;
    EXPECT_EQ(user.valueOf(description->max, name), highest) << name;
    EXPECT_EQ(set(highest + 1), highest) << name;
    EXPECT_EQ(set(lowest - 1), lowest) << name;
    if (!is_whole) {
      EXPECT_EQ(set(std::numeric_limits<double>::quiet_NaN()), lowest) << name;
    }
  }
  user.waitForLog("jpeg_quality 101 is not in the range of 1..100: 100 is used");
}

TEST(Settings, BeginWithTheParametersAndStayInForceWhenRosparamSetsThem) {
  SettingsUser user("/settings_rosparam", {"_jpeg_quality:=40"});
  EXPECT_EQ(user.valueOf(user.set(Config()), "jpeg_quality"), 40);
  ros::param::set("/settings_rosparam/aibo_driver/jpeg_quality", 50);
  EXPECT_EQ(user.valueOf(user.set(Config()), "jpeg_quality"), 40);
}

TEST(Settings, OfWhatTheRobotSendsChangeItMeanwhile) {
  TopicListener<sensor_msgs::CompressedImage> pictures("/settings_stream/camera/image_raw/compressed");
  TopicListener<sensor_msgs::CameraInfo> infos("/settings_stream/camera/camera_info");
  TopicListener<aibo_driver::Connection> connections("/settings_stream/connection");
  TopicListener<aibo_driver::LinkQuality> links("/settings_stream/link_quality");
  SettingsUser user("/settings_stream", {"_jpeg_quality:=100"});
  EXPECT_TRUE(connections.waitFor([](const auto& each) { return each.transport == "udp"; })) << "the usual way";
  const auto before = pictures.waitForNext();
  ASSERT_TRUE(before);
  user.set(change(&Config::ints, "jpeg_quality", 1));
  EXPECT_TRUE(pictures.waitFor([&before](const auto& each) { return 2 * each.data.size() < before->data.size(); }));
  user.set(change(&Config::strs, "resolution", "416x320"));
  EXPECT_TRUE(infos.waitFor([](const auto& info) { return info.width == 416 && info.K[2] > 200; }))
      << "with the calibration of this size";
  EXPECT_NEAR(user.valueOf(user.set(change(&Config::doubles, "frame_rate", 8.0)), "frame_rate"), 7.5, 1e-9);
  EXPECT_TRUE(links.waitFor([](const auto& each) { return each.pictures_per_second_asked == 7.5F; }));
  connections.clear();
  user.set(change(&Config::strs, "transport", "tcp"));
  EXPECT_TRUE(connections.waitFor(
      [](const auto& each) { return each.transport == "tcp" && each.transport_reason == "~transport is tcp"; }));

  Config partly_wrong = change(&Config::strs, "resolution", "1x1");
  partly_wrong.doubles = change(&Config::doubles, "frame_rate", 15.0).doubles;
  EXPECT_EQ(user.valueOf(user.set(partly_wrong), "frame_rate"), 15);
  user.waitForLog("The resolution '1x1' is not one of 52x40, .* 416x320: it stays at 416x320");
}

TEST(Settings, TheTelemetryRateChangesMeanwhileToAPartOfTheRobots) {
  TopicListener<sensor_msgs::JointState> joints("/settings_telemetry/joint_states");
  SettingsUser user("/settings_telemetry", {"_stream_on_start:=false"});
  ASSERT_TRUE(joints.waitForFirst());
  EXPECT_NEAR(user.valueOf(user.set(change(&Config::doubles, "telemetry_rate", 10.0)), "telemetry_rate"), 31.25 / 3,
              1e-9);
  EXPECT_TRUE(user.becomesTrue([&joints] {
    joints.clear();
    const auto next = joints.waitForCount(3);
    return std::abs((next.at(2)->header.stamp - next.at(0)->header.stamp).toSec() - 2 * 0.096) < 1e-3;
  }));
}

TEST(Settings, SpeedScaleSlowsARunningTrajectoryThatStillArrives) {
  test_support::JointListener joints("/settings_trajectory");
  // A setting that was changed stays on the parameter server, for the next driver of the same name.
  SettingsUser user("/settings_trajectory", {"_joint_speed_limit:=0.5", "_speed_scale:=1"});
  const auto passes = [&joints](double position) {
    return joints.messages().waitFor([=](const auto& state) { return positionOf(state, "head_pan") > position; });
  };
  ASSERT_TRUE(user.becomesTrue([&] {  // until the robot has reported its joints
    user.publish("joint_trajectory", test_support::trajectory({{"head_pan", 0.8}}, 4));
    return joints.messages().waitFor([](const auto& state) { return positionOf(state, "head_pan") > 0.1; },
                                     std::chrono::seconds(3)) != nullptr;
  }));
  user.set(change(&Config::doubles, "speed_scale", 0.1));
  const auto halfway = passes(0.65);
  const auto later = passes(0.75);
  ASSERT_TRUE(halfway && later);
  EXPECT_LT(0.1 / (later->header.stamp - halfway->header.stamp).toSec(), 0.1) << "0.05 rad/s are allowed";
  EXPECT_THAT(joints.waitForPositions({{"head_pan", 0.8}}), testing::IsEmpty());
}

// The robot sees no floor behind it, so with the guard it refuses. Otherwise the walk ends because nobody steers on.
TEST(Settings, WithoutGuardTheRobotWalksBackWhereItCannotSee) {
  TopicListener<aibo_driver::MotionState> motions("/settings_guard/motion_state");
  SettingsUser user("/settings_guard", {"_guard:=true"});
  user.set(change(&Config::bools, "guard", false));
  geometry_msgs::Twist back;
  back.linear.x = -0.1;
  EXPECT_TRUE(user.becomesTrue([&] {
    user.publish("cmd_vel", back);
    return motions.waitFor(
               [](const aibo_driver::MotionState& state) {
                 return !state.ended.empty() && state.ended.back().how != aibo_driver::EndedMovement::REFUSED;
               },
               std::chrono::seconds(2)) != nullptr;
  }));
}

TEST(Settings, OfTheCameraAreSeenInItsStateAndAdaptiveInTheDiagnostics) {
  TopicListener<CameraState> states("/settings_camera/camera/state");
  DiagnosticsListener diagnostics;
  SettingsUser user("/settings_camera",
                    {"_gain:=2", "_shutter_speed:=2", "_auto_white_balance:=false", test_support::kStreams});
  ASSERT_TRUE(states.waitFor([](const auto& state) { return state.gain == CameraState::GAIN_MID; }));
  user.set(change(&Config::ints, "gain", int(CameraState::GAIN_HIGH)));
  user.set(change(&Config::ints, "white_balance", int(CameraState::WB_OUTDOOR_MODE)));
  user.set(change(&Config::bools, "auto_exposure", true));
  EXPECT_TRUE(states.waitFor([](const auto& state) {
    return state.gain == CameraState::GAIN_HIGH && state.shutter_speed == CameraState::SHUTTER_MID &&
           state.white_balance == CameraState::WB_OUTDOOR_MODE && state.auto_exposure && !state.auto_white_balance;
  }));
  user.set(change(&Config::ints, "shutter_speed", int(CameraState::SHUTTER_SLOW)));
  user.set(change(&Config::bools, "auto_white_balance", true));
  EXPECT_TRUE(states.waitFor(
      [](const auto& state) { return state.shutter_speed == CameraState::SHUTTER_SLOW && state.auto_white_balance; }));
  for (const bool is_on : {true, false}) {
    user.set(change(&Config::bools, "adaptive", is_on));
    EXPECT_NE(diagnostics
                  .waitFor("settings_camera/aibo_driver: stream",
                           [is_on](const auto& status) {
                             return (DiagnosticsListener::value(status, "adaptive") != "off") == is_on;
                           })
                  .name,
              "");
  }
}

}  // namespace
