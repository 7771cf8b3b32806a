/// @file driver_parameters.h
#ifndef AIBO_DRIVER_NODE_DRIVER_PARAMETERS_H
#define AIBO_DRIVER_NODE_DRIVER_PARAMETERS_H

#include <aibo_driver/AiboDriverConfig.h>
#include <ros/node_handle.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <chrono>
#include <string>
#include <vector>

#include "aibo_client/rcserver_client.h"
#include "camera/camera_options.h"
#include "movement/joint_command_filter.h"
#include "movement/joint_table.h"
#include "walk/walk_settings.h"

namespace aibo_driver::node {

/// The driver's private parameters. They are read once at the start. Some of them can be changed later: see
/// LiveSettings. docs/ros_interface.md describes each of them for users.
struct DriverParameters {
  /// The options of the client: host, port, jpeg_quality, time limits, waits before reconnecting, and whether motions
  /// may lack joints.
  aibo_client::ClientOptions client;
  AiboDriverConfig live = AiboDriverConfig::__getDefault__();  ///< those that can be changed later, as they begin
  bool stream_on_start = true;             ///< whether the stream is wanted before set_streaming is called
  double color_rate = 30.0;                ///< images per second of the colour detection, for camera::everyNthImageOf()
  std::string color_tables = "pink_ball";  ///< for loadColorTables()
  int microphone_channels = 2;             ///< channels of the topic microphone, 1..2
  bool sound_priority = false;             ///< pictures wait for what the microphones hear
  bool stream_on_demand = true;            ///< stream only while a camera topic has a subscriber
  std::string frame_id = "camera_optical_frame";
  std::string camera_name;                  ///< letters, digits and underscores
  std::string camera_info_url;              ///< may be empty: see calibrationFile()
  bool use_robot_time = true;               ///< stamp messages by the robot's frame numbers, if it sends them
  std::chrono::nanoseconds time_offset{0};  ///< added to every stamp; at most 60 s either way
  std::chrono::milliseconds take_picture_timeout{2000};  ///< 100 ms..60 s
  std::string picture_folder;  ///< the folder for save_to; may be empty: see files::pictureFolder()

  std::string robot = "ERS-7";                            ///< "ERS-7" or "ERS-210"
  double joint_speed_limit = movement::kUsualSpeedLimit;  ///< rad/s, 0.1..20; slower joints have limits of their own
  double motion_speed_limit = movement::kNoSpeedLimit;    ///< rad/s, 0.1..20, while a motion file is played
  double approach_speed = movement::kUsualApproachSpeed;  ///< rad/s, 0.05..20; see JointCommandFilter

  walk::WalkSettings walk;
  bool get_up = false;  ///< true: the robot gets up by itself after a fall (walk::GetUp)

  bool publish_footprint = true;  ///< publish tf from base_footprint to base_link; only for an ERS-7
  std::string frame_prefix;       ///< put before every frame; see frame()

  std::vector<std::string> unknown;  ///< parameters that the driver does not have; most likely they are misspelt

  /// The full name of one of the robot's frames. The links that model.launch makes have the same names.
  std::string frame(const std::string& name) const { return frame_prefix.empty() ? name : frame_prefix + "/" + name; }
};

/// Messages a second. The robot measures every 32 ms.
constexpr double kHighestTelemetryRate = 31.25;

/// Calls `visit` with each number that can be changed later: its name, its unit in words, and its member and range.
template <typename Visit>
void visitLiveNumbers(const Visit& visit) {
  visit("jpeg_quality", "", &AiboDriverConfig::jpeg_quality, 1, camera::kMaxQuality);
  visit("frame_rate", "pictures a second", &AiboDriverConfig::frame_rate, camera::kLowestFrameRate,
        camera::kCameraRate);
  visit("max_picture_age", "seconds", &AiboDriverConfig::max_picture_age, 0.05, 2.0);
  visit("telemetry_rate", "messages a second", &AiboDriverConfig::telemetry_rate, 0.0, kHighestTelemetryRate);
  visit("speed_scale", "parts of the speed limits", &AiboDriverConfig::speed_scale, 0.1, 1.0);
  visit("white_balance", "", &AiboDriverConfig::white_balance, 1, 3);
  visit("gain", "", &AiboDriverConfig::gain, 1, 3);
  visit("shutter_speed", "", &AiboDriverConfig::shutter_speed, 1, 3);
}

/// The nearest period, in OPEN-R frames of 8 ms, that the robot can keep evenly. The robot measures every 4 frames, so
/// the period is a multiple of 4. It is at most 65535, the largest number that fits into the request.
/// @param rate messages a second, 0 or more; 0 means no messages, and so does a period of 0
int telemetryPeriodOf(double rate);

/// The messages per second that a period gives.
double telemetryRateOf(int period);

/// Checks the parameters that a user gave. It needs no ROS master.
/// @param values a struct of parameters, or an invalid value when there are none
/// @param name_prefix the prefix of parameters' names in messages, such as "/aibo/aibo_driver/"
/// @param name_space the driver's namespace, not the root. The camera is named after it unless the user names the
///   camera, so that no two robots share a calibration: "/team/left" names the camera "team_left".
/// @throw InvalidArgumentException values have the wrong type or are out of range; the message names all of them and
///   says what is allowed
DriverParameters parseDriverParameters(const XmlRpc::XmlRpcValue& values, const std::string& name_prefix,
                                       const std::string& name_space);

/// Reads and checks the parameters in the namespace of `private_handle`.
/// @param handle the driver's namespace
/// @throw InvalidArgumentException values were refused: see parseDriverParameters()
DriverParameters readDriverParameters(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle);

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_DRIVER_PARAMETERS_H
