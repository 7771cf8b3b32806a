#include "node/driver_parameters.h"

#include <gmock/gmock.h>

#include <string>

#include "aibo_client/exceptions.h"

namespace aibo_driver::node {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;
using XmlRpc::XmlRpcValue;

XmlRpcValue one(const std::string& name, const XmlRpcValue& value) {
  XmlRpcValue values;
  values[name] = value;
  return values;
}

DriverParameters parse(const XmlRpcValue& values) {
  return parseDriverParameters(values, "/aibo/aibo_driver/", "/aibo");
}

std::string refusal(const std::string& name, const XmlRpcValue& value) {
  try {
    parse(one(name, value));
  } catch (const aibo_client::InvalidArgumentException& error) {
    return error.what();
  }
  return "accepted";
}

TEST(DriverParameters, HaveDefaultsWhenNothingIsGiven) {
  const DriverParameters parameters = parse(XmlRpcValue());
  EXPECT_EQ(parameters.client.host, "127.0.0.1");
  EXPECT_EQ(parameters.client.port, 54321);
  EXPECT_EQ(parameters.client.jpeg_quality, 85);
  EXPECT_TRUE(parameters.stream_on_start);
  EXPECT_FALSE(parameters.stream_on_demand);
  EXPECT_EQ(parameters.frame_id, "camera_optical_frame");
  EXPECT_TRUE(parameters.use_robot_time);
  EXPECT_EQ(parameters.time_offset.count(), 0);
  EXPECT_EQ(parameters.picture_folder, "");
  EXPECT_EQ(parameters.robot, "ERS-7");
  EXPECT_EQ(parameters.resolution, "208x160");
  EXPECT_DOUBLE_EQ(parameters.frame_rate, 30.0);
  EXPECT_EQ(parameters.transport, "auto");
  EXPECT_EQ(parameters.client.picture_transport, aibo_client::PictureTransport::kAuto);
  EXPECT_FALSE(parameters.adaptive);
  EXPECT_DOUBLE_EQ(parameters.max_picture_age, 0.15);
  EXPECT_TRUE(parameters.camera == aibo_client::CameraSettings());
  EXPECT_DOUBLE_EQ(parameters.telemetry_rate, 31.25);
  EXPECT_DOUBLE_EQ(parameters.joint_speed_limit, 3.0);
  EXPECT_DOUBLE_EQ(parameters.motion_speed_limit, 20.0);
  EXPECT_DOUBLE_EQ(parameters.speed_scale, 1.0);
  EXPECT_DOUBLE_EQ(parameters.approach_speed, 0.5);
  EXPECT_FALSE(parameters.slow_down);
  EXPECT_FALSE(parameters.client.leave_out_missing_joints);
  EXPECT_TRUE(parameters.publish_footprint);
  EXPECT_DOUBLE_EQ(parameters.color_rate, 30.0);
  EXPECT_EQ(parameters.color_tables, "pink_ball");
  EXPECT_EQ(parameters.microphone_channels, 2);
  EXPECT_FALSE(parameters.sound_priority);
  EXPECT_EQ(parameters.take_picture_timeout, std::chrono::seconds(2));
  EXPECT_EQ(parameters.client.connect_timeout, aibo_client::ClientOptions().connect_timeout);
  EXPECT_EQ(parameters.client.reconnect_wait_min, aibo_client::ClientOptions().reconnect_wait_min);
  EXPECT_TRUE(parameters.client.guard_walks);
  EXPECT_EQ(parameters.walk.timeout, std::chrono::milliseconds(500));
  EXPECT_TRUE(parameters.walk.publish_odom_tf);
  EXPECT_THAT(parameters.unknown, IsEmpty());
}

TEST(DriverParameters, OfTheCameraAreThoseThatItHas) {
  EXPECT_EQ(parse(one("resolution", "416x320")).resolution, "416x320");
  EXPECT_THAT(refusal("resolution", "640x480"), HasSubstr("52x40, 104x80, 208x160 or 416x320"));
  EXPECT_EQ(parse(one("frame_rate", 10)).frame_rate, 10.0);
  EXPECT_THAT(refusal("frame_rate", 1.5), HasSubstr("2..30"));
  EXPECT_EQ(parse(one("transport", "udp")).client.picture_transport, aibo_client::PictureTransport::kUdp);
  EXPECT_EQ(parse(one("transport", "tcp")).client.picture_transport, aibo_client::PictureTransport::kTcp);
  EXPECT_THAT(refusal("transport", "UDP"), HasSubstr("auto, tcp or udp"));
  EXPECT_TRUE(parse(one("adaptive", true)).adaptive);
  EXPECT_EQ(parse(one("max_picture_age", 0.3)).max_picture_age, 0.3);
  EXPECT_THAT(refusal("max_picture_age", 0), HasSubstr("seconds, 0.05..2"));
  EXPECT_EQ(parse(one("shutter_speed", 1)).camera.shutter_speed, 1);
  EXPECT_THAT(refusal("gain", 0), HasSubstr("1..3"));
  EXPECT_THAT(refusal("white_balance", 4), HasSubstr("1..3"));
  EXPECT_TRUE(parse(one("auto_exposure", true)).camera.auto_exposure);
  EXPECT_TRUE(parse(one("auto_white_balance", true)).camera.auto_white_balance);
  EXPECT_EQ(parse(one("gain", 3)).camera.gain, 3);
  EXPECT_EQ(parse(one("white_balance", 1)).camera.white_balance, 1);
}

TEST(DriverParameters, TheFolderForPicturesIsAnAbsolutePath) {
  EXPECT_EQ(parse(one("picture_folder", "/srv/pictures")).picture_folder, "/srv/pictures");
  EXPECT_EQ(parse(one("picture_folder", "")).picture_folder, "");
  EXPECT_THAT(refusal("picture_folder", "pictures"), HasSubstr("the absolute path of a folder, or empty"));
  EXPECT_THAT(refusal("picture_folder", "~/pictures"), HasSubstr("absolute path"));
}

TEST(DriverParameters, TheCameraIsNamedAfterTheNamespaceUnlessItHasAName) {
  EXPECT_EQ(parse(XmlRpcValue()).camera_name, "aibo");
  EXPECT_EQ(parseDriverParameters(XmlRpcValue(), "", "/team/left").camera_name, "team_left");
  EXPECT_EQ(parseDriverParameters(XmlRpcValue(), "", "/lab/room/rex").camera_name, "lab_room_rex");
  EXPECT_EQ(parse(one("camera_name", "")).camera_name, "aibo");
  EXPECT_EQ(parse(one("camera_name", "left_eye_2")).camera_name, "left_eye_2");
  EXPECT_EQ(parseDriverParameters(one("camera_name", "eye"), "", "/team/left").camera_name, "eye");
}

TEST(DriverParameters, AFramePrefixIsPutBeforeEveryFrame) {
  EXPECT_EQ(parse(XmlRpcValue()).frame("imu_link"), "imu_link");
  EXPECT_EQ(parse(one("frame_prefix", "")).frame("imu_link"), "imu_link");
  EXPECT_EQ(parse(one("frame_prefix", "left")).frame("imu_link"), "left/imu_link");
  for (const char* wrong : {"/left", "left/", "my left", " left", "left "}) {
    EXPECT_THAT(refusal("frame_prefix", wrong), HasSubstr("not beginning or ending with '/'")) << wrong;
  }
}

TEST(DriverParameters, ATelemetryRateIsRoundedToAMultipleOf4Frames) {
  EXPECT_EQ(telemetryPeriodOf(31.25), 4);
  EXPECT_EQ(telemetryPeriodOf(30), 4);
  EXPECT_EQ(telemetryPeriodOf(10), 12);
  EXPECT_EQ(telemetryPeriodOf(1), 124);
  EXPECT_EQ(telemetryPeriodOf(0), 0);
  EXPECT_EQ(telemetryPeriodOf(0.0001), 65532) << "the longest that the robot supports";
}

TEST(DriverParameters, ATelemetryPeriodGivesTheRateInForce) {
  EXPECT_DOUBLE_EQ(telemetryRateOf(4), 31.25);
  EXPECT_DOUBLE_EQ(telemetryRateOf(20), 6.25);
  EXPECT_DOUBLE_EQ(telemetryRateOf(0), 0);
}

TEST(DriverParameters, OfTheJointsAreRead) {
  XmlRpcValue values;
  values["robot"] = "ERS-210";
  values["joint_speed_limit"] = 2;
  values["motion_speed_limit"] = 1.5;
  values["speed_scale"] = 0.5;
  values["approach_speed"] = 0.25;
  values["slow_down"] = XmlRpcValue(true);
  values["leave_out_missing_joints"] = XmlRpcValue(true);
  values["publish_footprint"] = XmlRpcValue(false);
  const DriverParameters parameters = parse(values);
  EXPECT_EQ(parameters.robot, "ERS-210");
  EXPECT_DOUBLE_EQ(parameters.joint_speed_limit, 2);
  EXPECT_DOUBLE_EQ(parameters.motion_speed_limit, 1.5);
  EXPECT_DOUBLE_EQ(parameters.speed_scale, 0.5);
  EXPECT_DOUBLE_EQ(parameters.approach_speed, 0.25);
  EXPECT_TRUE(parameters.slow_down);
  EXPECT_TRUE(parameters.client.leave_out_missing_joints);
  EXPECT_FALSE(parameters.publish_footprint);
}

TEST(DriverParameters, OfTheJointsAreRefusedOutOfRange) {
  EXPECT_THAT(refusal("robot", "ERS-8"), HasSubstr("ERS-7 or ERS-210"));
  EXPECT_THAT(refusal("telemetry_rate", 50), HasSubstr("messages a second, 0..31.25"));
  EXPECT_THAT(refusal("joint_speed_limit", 0), HasSubstr("rad/s, 0.1..20"));
  EXPECT_THAT(refusal("motion_speed_limit", 21), HasSubstr("rad/s, 0.1..20"));
  EXPECT_THAT(refusal("speed_scale", 1.5), HasSubstr("0.1..1"));
  EXPECT_THAT(refusal("approach_speed", -1.0), HasSubstr("rad/s, 0.05..20"));
  EXPECT_THAT(refusal("slow_down", 1), HasSubstr("true or false"));
}

TEST(DriverParameters, OfTheWalkAreRead) {
  XmlRpcValue values;
  values["walk_speed_limit"] = 0.1;
  values["walk_side_limit"] = 0;
  values["walk_turn_limit"] = 0.5;
  values["walk_scale"] = 0.9;
  values["walk_side_scale"] = 0.8;
  values["walk_curve"] = -1.5;
  values["walk_turn_scale"] = 1.1;
  values["walk_direction"] = -0.05;
  values["cmd_vel_timeout"] = 0.2;
  values["publish_odom_tf"] = XmlRpcValue(false);
  values["guard"] = XmlRpcValue(false);
  EXPECT_FALSE(parse(values).client.guard_walks);
  EXPECT_FALSE(parse(values).get_up);
  values["get_up"] = XmlRpcValue(true);
  EXPECT_TRUE(parse(values).get_up);
  const WalkSettings walk = parse(values).walk;
  EXPECT_EQ(walk.speed_limit, 0.1);
  EXPECT_EQ(walk.side_limit, 0);
  EXPECT_EQ(walk.turn_limit, 0.5);
  EXPECT_EQ(walk.scale, 0.9);
  EXPECT_EQ(walk.side_scale, 0.8);
  EXPECT_EQ(walk.curve, -1.5);
  EXPECT_EQ(walk.turn_scale, 1.1);
  EXPECT_EQ(walk.direction, -0.05);
  EXPECT_EQ(walk.timeout, std::chrono::milliseconds(200));
  EXPECT_FALSE(walk.publish_odom_tf);
}

TEST(DriverParameters, OfTheWalkAreRefusedOutOfRange) {
  EXPECT_THAT(refusal("walk_speed_limit", -0.1), HasSubstr("m/s, 0..1"));
  EXPECT_THAT(refusal("walk_side_limit", 1.1), HasSubstr("m/s, 0..1"));
  EXPECT_THAT(refusal("walk_turn_limit", 11), HasSubstr("rad/s, 0..10"));
  EXPECT_THAT(refusal("walk_scale", 0), HasSubstr("0.2..5"));
  EXPECT_THAT(refusal("walk_side_scale", 0.1), HasSubstr("0.2..5"));
  EXPECT_THAT(refusal("walk_turn_scale", 6), HasSubstr("0.2..5"));
  EXPECT_THAT(refusal("walk_curve", 6), HasSubstr("rad/m, -5..5"));
  EXPECT_THAT(refusal("walk_direction", 1.5), HasSubstr("rad, -1..1"));
  EXPECT_THAT(refusal("cmd_vel_timeout", 0.6), HasSubstr("seconds, 0.1..0.5"));
  EXPECT_THAT(refusal("publish_odom_tf", 1), HasSubstr("true or false"));
  EXPECT_THAT(refusal("guard", "off"), HasSubstr("true or false"));
}

TEST(DriverParameters, AreRead) {
  XmlRpcValue values;
  values["host"] = "aibo.local";
  values["port"] = 1234;
  values["jpeg_quality"] = 1;
  values["connect_timeout"] = 3;
  values["read_timeout"] = 0.25;
  values["stream_on_start"] = XmlRpcValue(false);
  values["stream_on_demand"] = XmlRpcValue(true);
  values["use_robot_time"] = XmlRpcValue(false);
  values["time_offset"] = -0.02;
  values["camera_info_url"] = "package://aibo_driver/config/camera.yaml";
  values["reconnect_wait_max"] = 7;
  values["reconnect_wait_min"] = 0.5;
  values["color_rate"] = 5;
  values["color_tables"] = "pink_ball /my/table.yaml";
  values["microphone_channels"] = 1;
  values["sound_priority"] = XmlRpcValue(true);
  values["take_picture_timeout"] = 4.5;
  values["frame_id"] = "eye";
  values["telemetry_rate"] = 12.5;
  const DriverParameters parameters = parse(values);
  EXPECT_EQ(parameters.client.host, "aibo.local");
  EXPECT_EQ(parameters.client.port, 1234);
  EXPECT_EQ(parameters.client.jpeg_quality, 1);
  EXPECT_EQ(parameters.client.connect_timeout, std::chrono::seconds(3));
  EXPECT_EQ(parameters.client.read_timeout, std::chrono::milliseconds(250));
  EXPECT_FALSE(parameters.stream_on_start);
  EXPECT_TRUE(parameters.stream_on_demand);
  EXPECT_FALSE(parameters.use_robot_time);
  EXPECT_EQ(parameters.time_offset, std::chrono::milliseconds(-20));
  EXPECT_EQ(parameters.camera_info_url, "package://aibo_driver/config/camera.yaml");
  EXPECT_EQ(parameters.client.reconnect_wait_max, std::chrono::seconds(7));
  EXPECT_EQ(parameters.client.reconnect_wait_min, std::chrono::milliseconds(500));
  EXPECT_EQ(parameters.color_rate, 5);
  EXPECT_EQ(parameters.color_tables, "pink_ball /my/table.yaml");
  EXPECT_EQ(parameters.microphone_channels, 1);
  EXPECT_TRUE(parameters.sound_priority);
  EXPECT_EQ(parameters.take_picture_timeout, std::chrono::milliseconds(4500));
  EXPECT_EQ(parameters.frame_id, "eye");
  EXPECT_EQ(parameters.telemetry_rate, 12.5);
}

TEST(DriverParameters, OutOfRangeAreRefusedWithNameAndRange) {
  EXPECT_EQ(refusal("port", 0),
            "Parameter /aibo/aibo_driver/port is 0; it must be a whole number, 1..65535. "
            "'rosparam delete NAME' removes a parameter that was set before.");
  EXPECT_THAT(refusal("port", 65536), HasSubstr("1..65535"));
  EXPECT_THAT(refusal("jpeg_quality", 101), HasSubstr("1..100"));
  EXPECT_THAT(refusal("connect_timeout", 0.0), HasSubstr("connect_timeout is 0"));
  EXPECT_THAT(refusal("read_timeout", 61), HasSubstr("0.05..60"));
  EXPECT_THAT(refusal("time_offset", 61.0), HasSubstr("-60..60"));
  EXPECT_THAT(refusal("time_offset", std::stod("nan")), HasSubstr("-60..60"));
}

TEST(DriverParameters, OfTheWrongTypeAreRefusedWithNameAndType) {
  EXPECT_THAT(refusal("port", "abc"),
              StartsWith("Parameter /aibo/aibo_driver/port is the text 'abc'; it must be a whole number, 1..65535."));
  EXPECT_THAT(refusal("jpeg_quality", 85.5), HasSubstr("a whole number"));
  EXPECT_THAT(refusal("read_timeout", "1"), HasSubstr("a number of seconds"));
  EXPECT_THAT(refusal("stream_on_start", 1), HasSubstr("true or false"));
  EXPECT_THAT(refusal("host", 5), HasSubstr("host is 5; it must be"));
}

TEST(DriverParameters, AWholeNumberMayBeWrittenWithAPoint) {
  EXPECT_EQ(parse(one("jpeg_quality", 70.0)).client.jpeg_quality, 70);
}

TEST(DriverParameters, AreRefusedAllAtOnce) {
  XmlRpcValue values;
  values["port"] = 0;
  values["host"] = "aibo.local";
  values["read_timeout"] = 61;
  try {
    parse(values);
    FAIL() << "accepted";
  } catch (const aibo_client::InvalidArgumentException& error) {
    EXPECT_THAT(error.what(), HasSubstr("port is 0; it must be a whole number, 1..65535."));
    EXPECT_THAT(error.what(), HasSubstr("read_timeout is 61; it must be a number of seconds, 0.05..60."));
  }
}

TEST(DriverParameters, AreRefusedWhenTheTextMakesNoSense) {
  EXPECT_THAT(refusal("host", ""), HasSubstr("name or address"));
  EXPECT_THAT(refusal("host", "my robot"), HasSubstr("name or address"));
  EXPECT_THAT(refusal("frame_id", "/camera"), HasSubstr("not beginning with '/'"));
  for (const char* wrong : {"my-camera", "-camera", "camera-"}) {
    EXPECT_THAT(refusal("camera_name", wrong), HasSubstr("letters, digits and underscores"));
  }
  EXPECT_THAT(refusal("camera_info_url", "/home/me/camera.yaml"), HasSubstr("file:///"));
  EXPECT_THAT(refusal("color_tables", 3), HasSubstr("separated by blanks"));
  EXPECT_THAT(refusal("microphone_channels", 3), HasSubstr("1..2"));
  EXPECT_THAT(refusal("color_rate", 31), HasSubstr("images a second, 2..30"));
  EXPECT_THAT(refusal("take_picture_timeout", 0), HasSubstr("0.1..60"));
  EXPECT_THAT(refusal("reconnect_wait_max", 0), HasSubstr("0.01..60"));
}

TEST(DriverParameters, ReconnectWaitsFollowTheirMaximum) {
  const DriverParameters parameters = parse(one("reconnect_wait_max", 0.05));
  EXPECT_EQ(parameters.client.reconnect_wait_max, std::chrono::milliseconds(50));
  EXPECT_LE(parameters.client.reconnect_wait_min, parameters.client.reconnect_wait_max);
  XmlRpcValue both = one("reconnect_wait_max", 3);
  both["reconnect_wait_min"] = 3;
  EXPECT_EQ(parse(both).client.reconnect_wait_min, std::chrono::seconds(3));
  both["reconnect_wait_min"] = 4;
  EXPECT_THROW(parse(both), aibo_client::InvalidArgumentException);
}

TEST(DriverParameters, ThatTheDriverDoesNotHaveAreListed) {
  XmlRpcValue values;
  values["prot"] = 54321;
  values["diagnostic_period"] = 2.0;
  values["host"] = "robot";
  values["port"] = 54322;
  values["joint_speed_limit"] = 2.5;
  values["use_robot_time"] = true;
  values["namespace_of_others"]["port"] = 1;
  EXPECT_THAT(parse(values).unknown, ElementsAre("prot"));
}

}  // namespace
}  // namespace aibo_driver::node
