// Settings that can be changed while the driver runs, with dynamic_reconfigure.

#include <aibo_driver/CameraState.h>
#include <aibo_driver/Connection.h>
#include <aibo_driver/LinkQuality.h>
#include <aibo_driver/MotionState.h>
#include <aibo_driver/RobotState.h>
#include <aibo_driver/TakePicture.h>
#include <dynamic_reconfigure/ConfigDescription.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <geometry_msgs/Twist.h>
#include <gmock/gmock.h>
#include <ros/ros.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/JointState.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <tuple>
#include <vector>

#include "support/ros/diagnostics_listener.h"
#include "support/ros/driver_process.h"
#include "support/ros/joint_listener.h"
#include "support/ros/joint_messages.h"
#include "support/ros/topic_listener.h"
#include "support/ros/topic_publishers.h"
#include "support/simulated_robot.h"

namespace {

using aibo_driver::CameraState;
using aibo_driver::Connection;
using aibo_driver::LinkQuality;
using aibo_driver::RobotState;
using aibo_driver::TakePicture;
using dynamic_reconfigure::Config;
using dynamic_reconfigure::Reconfigure;
using test_support::DiagnosticsListener;
using test_support::DriverProcess;
using test_support::JointListener;
using test_support::positionOf;
using test_support::SimulatedRobot;
using test_support::TopicListener;
using test_support::TopicPublishers;
using ::testing::HasSubstr;
using ::testing::Not;

// A setting that was changed stays on the parameter server, for the next driver of the same name.
constexpr const char* kFullSpeed = "_speed_scale:=1";
// On a busy machine the connection would break off, and the motion with it.
constexpr const char* kPatient = "_read_timeout:=20";

Config jpegQuality(int value) {
  Config config;
  config.ints.resize(1);
  config.ints[0].name = "jpeg_quality";
  config.ints[0].value = value;
  return config;
}

Config number(const std::string& name, double value) {
  Config config;
  config.doubles.resize(1);
  config.doubles[0].name = name;
  config.doubles[0].value = value;
  return config;
}

Config whole(const std::string& name, int value) {
  Config config = jpegQuality(value);
  config.ints[0].name = name;
  return config;
}

Config text(const std::string& name, const std::string& value) {
  Config config;
  config.strs.resize(1);
  config.strs[0].name = name;
  config.strs[0].value = value;
  return config;
}

/// Mean luminance, about, of a decoded picture.
double brightnessOf(const sensor_msgs::Image& image) {
  return std::accumulate(image.data.begin(), image.data.end(), 0.0) / static_cast<double>(image.data.size());
}

/// A driver of a simulated robot, and its service.
class SettingsUser {
 public:
  explicit SettingsUser(const std::string& name_space, const std::vector<std::string>& parameters = {})
      : node_(name_space + "/aibo_driver"), driver_(name_space, robot_.port(), parameters) {}

  /// @return the settings in force afterwards
  Config set(const Config& config) {
    const std::string service = node_ + "/set_parameters";
    Reconfigure call;
    call.request.config = config;
    EXPECT_TRUE(ros::service::waitForService(service, ros::Duration(test_support::kSafetyNet.count())));
    EXPECT_TRUE(ros::service::call(service, call));
    return call.response.config;
  }

  void waitForLog(const std::string& pattern) { driver_.waitForOutput(pattern, test_support::kSafetyNet); }

  std::string log() const { return driver_.output(); }

  /// The settings in force, from the answer to an empty change.
  double inForce(const std::string& name) { return valueOf(set(Config()), name); }

  static double valueOf(const Config& config, const std::string& name) {
    for (const auto& entry : config.ints) {
      if (entry.name == name) {
        return entry.value;
      }
    }
    for (const auto& entry : config.doubles) {
      if (entry.name == name) {
        return entry.value;
      }
    }
    return std::numeric_limits<double>::quiet_NaN();
  }

 private:
  SimulatedRobot robot_;
  const std::string node_;
  DriverProcess driver_;
};

TEST(Settings, BeginWithTheParameters) {
  SettingsUser user("/settings_begin", {"_jpeg_quality:=40", "_telemetry_rate:=6.25", "_speed_scale:=0.5"});
  EXPECT_EQ(user.inForce("jpeg_quality"), 40);
  EXPECT_EQ(user.inForce("telemetry_rate"), 6.25);
  EXPECT_EQ(user.inForce("speed_scale"), 0.5);
  user.waitForLog("Settings in force: jpeg_quality 40 .*telemetry_rate 6.25 of 0..31.25, speed_scale 0.5 of");
}

TEST(Settings, TellTheirRangesToProgramsThatShowThem) {
  TopicListener<dynamic_reconfigure::ConfigDescription> descriptions(
      "/settings_ranges/aibo_driver/parameter_descriptions");
  const SettingsUser user("/settings_ranges");
  const std::vector<std::tuple<std::string, double, double>> ranges = {{"jpeg_quality", 1, 100},
                                                                       {"frame_rate", 2, 30},
                                                                       {"max_picture_age", 0.05, 2},
                                                                       {"telemetry_rate", 0, 31.25},
                                                                       {"speed_scale", 0.1, 1},
                                                                       {"white_balance", 1, 3},
                                                                       {"gain", 1, 3},
                                                                       {"shutter_speed", 1, 3}};
  EXPECT_TRUE(descriptions.waitFor([&ranges](const auto& description) {
    return std::all_of(ranges.begin(), ranges.end(), [&description](const auto& range) {
      const auto& [name, lowest, highest] = range;
      return SettingsUser::valueOf(description.min, name) == lowest &&
             SettingsUser::valueOf(description.max, name) == highest;
    });
  }));
}

TEST(Settings, JpegQualityChangesTheRunningStream) {
  TopicListener<sensor_msgs::CompressedImage> pictures("/settings_quality/camera/image_raw/compressed");
  SettingsUser user("/settings_quality", {"_jpeg_quality:=100"});
  const auto before = pictures.waitForNext();
  ASSERT_TRUE(before);
  user.set(jpegQuality(1));
  EXPECT_TRUE(pictures.waitFor([&before](const auto& p) { return 2 * p.data.size() < before->data.size(); }));
}

TEST(Settings, JpegQualityAppliesToTakePictureToo) {
  SettingsUser user("/settings_picture", {"_stream_on_start:=false"});
  user.set(jpegQuality(20));
  TopicListener<Connection> connection("/settings_picture/connection");
  ASSERT_TRUE(connection.waitFor([](const Connection& message) { return message.state == Connection::CONNECTED; }));
  TakePicture call;
  ASSERT_TRUE(ros::service::call("/settings_picture/take_picture", call));
  EXPECT_THAT(call.response.message, HasSubstr("at quality 20"));
}

TEST(Settings, TelemetryRateChangesJointStates) {
  TopicListener<sensor_msgs::JointState> states("/settings_rate/joint_states");
  SettingsUser user("/settings_rate");
  ASSERT_TRUE(states.waitForNext());
  const double rate = user.valueOf(user.set(number("telemetry_rate", 1)), "telemetry_rate");
  EXPECT_NEAR(rate, 1 / 0.992, 1e-6) << "31 measurements of 32 ms";
  ros::Time last;
  EXPECT_TRUE(states.waitFor([&last](const auto& state) {
    const double interval = (state.header.stamp - last).toSec();
    last = state.header.stamp;
    return interval > 0.9 && interval < 1.1;  // the robot measures every 32 ms
  }));
  user.set(number("telemetry_rate", 0));
  TopicPublishers topics("/settings_rate");
  topics.publish("joint_trajectory", test_support::trajectory({{"head_pan", 0.5}}, 1));
  user.waitForLog("telemetry_rate is 0");
}

TEST(Settings, SpeedScaleSlowsTheJointsDown) {
  JointListener joints("/settings_speed");
  SettingsUser user("/settings_speed", {"_joint_speed_limit:=5", "_approach_speed:=5", kFullSpeed, kPatient});
  TopicPublishers topics("/settings_speed");
  ASSERT_TRUE(joints.messages().waitForNext());
  user.set(number("speed_scale", 0.1));
  sensor_msgs::JointState command;
  command.name = {"head_pan"};
  command.position = {0.5};
  topics.publish("joint_command", command);
  EXPECT_TRUE(joints.waitForPosition("head_pan", 0.5));
  EXPECT_LT(joints.highestSpeed("head_pan"), 0.7);
  user.set(number("speed_scale", 1));
  command.position = {-0.5};
  topics.publish("joint_command", command);
  EXPECT_TRUE(joints.waitForPosition("head_pan", -0.5));
  EXPECT_GT(joints.highestSpeed("head_pan"), 1);
}

TEST(Settings, SpeedScaleSlowsARunningTrajectory) {
  JointListener joints("/settings_trajectory");
  SettingsUser user("/settings_trajectory", {"_joint_speed_limit:=2", kFullSpeed, kPatient});
  TopicListener<aibo_driver::MotionState> states("/settings_trajectory/motion_state");
  TopicPublishers topics("/settings_trajectory");
  ASSERT_TRUE(joints.messages().waitForNext());
  topics.publish("joint_trajectory", test_support::trajectory({{"head_pan", 1.0}}, 1.5));
  const auto waitForPanBeyond = [&joints](double position) {
    return joints.messages().waitFor([=](const auto& state) { return positionOf(state, "head_pan") > position; });
  };
  const auto begun = states.waitFor([](const auto& state) { return !state.movements.empty(); });
  ASSERT_TRUE(begun && waitForPanBeyond(0.1));
  user.set(number("speed_scale", 0.1));
  // The mean speed, because a busy computer may be late with some commands, and the joint then stops for a moment.
  const auto halfway = waitForPanBeyond(0.5);
  const auto later = waitForPanBeyond(0.9);
  ASSERT_TRUE(halfway && later);
  EXPECT_LT(0.4 / (later->header.stamp - halfway->header.stamp).toSec(), 0.3) << "0.2 is allowed";
  EXPECT_TRUE(joints.waitForPosition("head_pan", 1.0)) << "it still goes to the end";
  EXPECT_TRUE(states.waitFor([&begun](const auto& state) {
    return !state.movements.empty() && state.movements[0].end > begun->movements[0].end + ros::Duration(1);
  })) << "its end is said to be later";
}

TEST(Settings, WithoutGuardTheRobotWalksBackWhereItCannotSee) {
  TopicListener<RobotState> states("/settings_guard/robot_state");
  TopicListener<aibo_driver::MotionState> motions("/settings_guard/motion_state");
  SettingsUser user("/settings_guard", {"_guard:=true", kPatient});
  TopicPublishers topics("/settings_guard");
  ASSERT_TRUE(states.waitFor([](const auto& state) { return state.posture == RobotState::STANDING; }));
  Config config;
  config.bools.resize(1);
  config.bools[0].name = "guard";
  config.bools[0].value = 0;
  user.set(config);
  geometry_msgs::Twist back;
  back.linear.x = -0.1;
  topics.publish("cmd_vel", back);
  const auto walked = motions.waitFor([](const auto& motion) { return !motion.ended.empty(); });
  ASSERT_TRUE(walked);
  EXPECT_EQ(walked->ended[0].reason, "it was not steered for 500 ms") << "it was not refused";
}

TEST(Settings, ResolutionAndRateChangeTheRunningStream) {
  TopicListener<sensor_msgs::CameraInfo> infos("/settings_size/camera/camera_info");
  TopicListener<CameraState> states("/settings_size/camera/state");
  SettingsUser user("/settings_size", {"_resolution:=104x80", kPatient});
  ASSERT_TRUE(infos.waitFor([](const auto& info) { return info.width == 104 && info.height == 80; }));
  const Config answer = user.set(text("resolution", "416x320"));
  ASSERT_TRUE(infos.waitFor([](const auto& info) { return info.width == 416 && info.K[2] > 200; }));
  ASSERT_TRUE(states.waitFor([](const auto& state) { return state.width == 416 && state.frame_number > 0; }));
  EXPECT_NEAR(user.valueOf(user.set(number("frame_rate", 8)), "frame_rate"), 7.5, 1e-9);
  ros::Time last;
  EXPECT_TRUE(infos.waitFor([&last](const auto& info) {
    const double interval = (info.header.stamp - last).toSec();
    last = info.header.stamp;
    return interval > 0.12 && interval < 0.15;  // 4 images of 33 ms
  }));
  TakePicture call;
  call.request.resolution = "52x40";
  ASSERT_TRUE(ros::service::call("/settings_size/take_picture", call));
  EXPECT_THAT(call.response.message, HasSubstr("52x40 pixels"));
  Config partly_wrong = text("resolution", "1x1");
  partly_wrong.doubles = number("frame_rate", 15).doubles;
  const Config same = user.set(partly_wrong);
  EXPECT_TRUE(std::any_of(same.strs.begin(), same.strs.end(),
                          [](const auto& each) { return each.name == "resolution" && each.value == "416x320"; }));
  user.waitForLog("The resolution '1x1' is not one of 52x40, .* 416x320: it stays at 416x320");
  EXPECT_TRUE(infos.waitFor([&last](const auto& info) {
    const double interval = (info.header.stamp - last).toSec();
    last = info.header.stamp;
    return interval > 0.05 && interval < 0.08;  // 2 images of 33 ms
  })) << "the rest of the change is in force";
  EXPECT_FALSE(states.waitFor([](const auto& state) { return state.width == 52; }, std::chrono::milliseconds(500)));
}

TEST(Settings, TransportChangesTheRunningStream) {
  DiagnosticsListener diagnostics;
  TopicListener<sensor_msgs::CompressedImage> pictures("/settings_transport/camera/image_raw/compressed");
  SettingsUser user("/settings_transport", {"_transport:=udp", kPatient});
  const auto wait_for = [&diagnostics](const std::string& transport) {
    return diagnostics.waitFor("settings_transport/aibo_driver: stream", [&transport](const auto& status) {
      return DiagnosticsListener::value(status, "transport") == transport &&
             DiagnosticsListener::value(status, "streaming") == "yes";
    });
  };
  const auto by_udp = wait_for("udp");
  EXPECT_THAT(by_udp.message, Not(HasSubstr("by TCP")));
  EXPECT_EQ(DiagnosticsListener::value(by_udp, "why this transport"), "datagrams from the robot get through");
  EXPECT_TRUE(pictures.waitForNext());
  EXPECT_NE(DiagnosticsListener::value(diagnostics.waitForNext("settings_transport/aibo_driver: stream"),
                                       "datagrams received"),
            "");
  user.set(text("transport", "tcp"));
  EXPECT_EQ(DiagnosticsListener::value(wait_for("tcp"), "why this transport"), "~transport is tcp");
  pictures.clear();
  EXPECT_TRUE(pictures.waitForNext());
  const Config answer = user.set(text("transport", "pigeon"));
  user.waitForLog("The transport 'pigeon' is not one of auto, tcp or udp: it stays at tcp");
  EXPECT_TRUE(std::any_of(answer.strs.begin(), answer.strs.end(),
                          [](const auto& each) { return each.name == "transport" && each.value == "tcp"; }));
  for (int report = 0; report < 3; ++report) {
    EXPECT_EQ(
        DiagnosticsListener::value(diagnostics.waitForNext("settings_transport/aibo_driver: stream"), "transport"),
        "tcp");
  }
}

TEST(Settings, ByDefaultPicturesComeByUdpAndTheConnectionSaysSo) {
  TopicListener<Connection> connections("/settings_auto/connection");
  TopicListener<LinkQuality> qualities("/settings_auto/link_quality");
  SettingsUser user("/settings_auto", {kPatient});
  EXPECT_TRUE(connections.waitFor([](const auto& connection) {
    return connection.transport == "udp" && connection.transport_reason == "datagrams from the robot get through";
  }));
  const auto quality = qualities.waitFor([](const auto& each) {
    return each.transport == "udp" && each.pictures_per_second_asked == 30 && each.age > 0 && each.lost >= 0;
  });
  ASSERT_TRUE(quality);
  EXPECT_GE(quality->longest_age, quality->age);
  EXPECT_LT(quality->age, 20);
  EXPECT_LT(std::abs((ros::Time::now() - quality->header.stamp).toSec()), 20);
  user.set(text("transport", "tcp"));
  EXPECT_TRUE(connections.waitFor([](const auto& connection) {
    return connection.transport == "tcp" && connection.transport_reason == "~transport is tcp";
  }));
}

TEST(Settings, ThatRosparamSetsHaveNoEffectAndTheDriverSaysSo) {
  SettingsUser user("/settings_rosparam");
  const std::string name = "/settings_rosparam/aibo_driver/jpeg_quality";
  EXPECT_EQ(user.inForce("jpeg_quality"), 85);
  Config changed = number("speed_scale", 0.4);
  changed.bools.resize(1);
  changed.bools[0].name = "adaptive";
  changed.bools[0].value = 1;
  user.set(changed);
  user.set(text("transport", "tcp"));
  ros::param::set(name, 50);
  user.waitForLog(name + " was set to '50', but '85' stays in force");
  EXPECT_EQ(user.inForce("jpeg_quality"), 85);
  for (const char* const setting : {"speed_scale", "adaptive", "transport"}) {
    EXPECT_THAT(user.log(), Not(HasSubstr(std::string(setting) + " was set to"))) << "dynamic_reconfigure did it";
  }
  EXPECT_THAT(user.log(), Not(HasSubstr("/port was set to"))) << "it was before the driver was started";
}

TEST(Settings, OfTheCameraAreSeenInThePictures) {
  TopicListener<sensor_msgs::Image> images("/settings_camera/camera/image_raw");
  TopicListener<CameraState> states("/settings_camera/camera/state");
  SettingsUser user("/settings_camera", {"_frame_rate:=10", "_gain:=2", "_shutter_speed:=2", kPatient});
  ASSERT_TRUE(states.waitFor([](const auto& state) { return state.gain == CameraState::GAIN_MID; }));
  ASSERT_TRUE(images.waitForNext());
  const double usual = brightnessOf(*images.waitForNext());
  user.set(whole("shutter_speed", CameraState::SHUTTER_FAST));
  EXPECT_TRUE(images.waitFor([usual](const auto& image) { return brightnessOf(image) < 0.9 * usual; }));
  EXPECT_TRUE(states.waitFor([](const auto& state) {
    return state.shutter_speed == CameraState::SHUTTER_FAST && state.gain == CameraState::GAIN_MID;
  }));
  user.set(whole("gain", CameraState::GAIN_HIGH));
  EXPECT_TRUE(states.waitFor([](const auto& state) { return state.gain == CameraState::GAIN_HIGH; }));
  Config automatic = whole("white_balance", CameraState::WB_OUTDOOR_MODE);
  automatic.bools.resize(1);
  automatic.bools[0].name = "auto_exposure";
  automatic.bools[0].value = 1;
  automatic.strs.resize(1);  // refused, and the rest is carried out all the same
  automatic.strs[0].name = "resolution";
  automatic.strs[0].value = "1x1";
  user.set(automatic);
  EXPECT_TRUE(states.waitFor([](const auto& state) {
    return state.white_balance == CameraState::WB_OUTDOOR_MODE && state.auto_exposure && !state.auto_white_balance;
  }));
  automatic.bools[0].name = "auto_white_balance";
  user.set(automatic);
  EXPECT_TRUE(states.waitFor([](const auto& state) { return state.auto_exposure && state.auto_white_balance; }));
  states.clear();
  images.waitForCount(images.count() + 3);
  EXPECT_EQ(states.count(), 0u) << "nothing has changed";
}

TEST(Settings, OutOfRangeAreSetToTheNearestAllowedValue) {
  SettingsUser user("/settings_range");
  EXPECT_EQ(user.valueOf(user.set(jpegQuality(300)), "jpeg_quality"), 100);
  user.waitForLog("jpeg_quality 300 is not in the range of 1..100: 100 is used");
  EXPECT_EQ(user.valueOf(user.set(number("telemetry_rate", -1)), "telemetry_rate"), 0);
  EXPECT_EQ(user.valueOf(user.set(number("speed_scale", 0)), "speed_scale"), 0.1);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const char* name : {"frame_rate", "max_picture_age", "telemetry_rate", "speed_scale"}) {
    const double in_force = user.valueOf(user.set(number(name, 1)), name);  // frame_rate cannot be so low
    EXPECT_EQ(user.valueOf(user.set(number(name, nan)), name), in_force) << name;
  }
}

}  // namespace
