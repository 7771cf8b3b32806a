/// @file driver_parameters.h
#ifndef AIBO_DRIVER_ROS_DRIVER_PARAMETERS_H
#define AIBO_DRIVER_ROS_DRIVER_PARAMETERS_H

#include <ros/node_handle.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <chrono>
#include <string>
#include <vector>

#include "aibo_driver/rcserver_client.h"
#include "movement/joint_command_filter.h"
#include "movement/joint_table.h"
#include "ros/walk/walk_settings.h"

namespace aibo_driver::node {

/// The driver's private parameters, read once at start. Some of them can be changed later: see LiveSettings.
/// docs/ros_interface.md describes each of them for users.
struct DriverParameters {
  ClientOptions client;         ///< host, port, jpeg_quality, time limits, reconnect waits, missing joints of motions
  bool stream_on_start = true;  ///< whether the stream is wanted before set_streaming is called
  std::string resolution = "208x160";      ///< of the stream, for resolutionOf()
  double frame_rate = 30.0;                ///< pictures per second of the stream, for everyNthImageOf()
  std::string transport = "tcp";           ///< of the stream's pictures, for transportOf()
  bool adaptive = false;                   ///< lower quality and rate to keep max_picture_age
  double max_picture_age = 0.15;           ///< s, 0.05..2
  CameraSettings camera;                   ///< of the camera, with Sony's numbers
  double color_rate = 30.0;                ///< of the colour detection, images per second, for everyNthImageOf()
  std::string color_tables = "pink_ball";  ///< for ColorTableService::loadAtStart()
  bool stream_on_demand = false;           ///< stream only while a camera topic has a subscriber
  std::string frame_id = "camera_optical_frame";
  std::string camera_name;                               ///< letters, digits and underscores
  std::string camera_info_url;                           ///< empty: as for calibrationFile()
  bool use_robot_time = true;                            ///< stamp by the robot's frame numbers, if it sends them
  std::chrono::nanoseconds time_offset{0};               ///< added to every stamp; at most 60 s either way
  std::chrono::milliseconds take_picture_timeout{2000};  ///< 100 ms..60 s
  std::string picture_folder;                            ///< for save_to; empty: see files::pictureFolder()

  std::string robot = "ERS-7";    ///< or "ERS-210"
  double telemetry_rate = 31.25;  ///< 0..31.25 messages a second, joint_states and sensors; 0: none
  double joint_speed_limit = movement::kUsualSpeedLimit;  ///< rad/s, 0.1..20; slower joints have limits of their own
  double speed_scale = 1.0;                               ///< 0.1..1, of the speed limits
  double approach_speed = movement::kUsualApproachSpeed;  ///< rad/s, 0.05..20; see JointCommandFilter
  bool slow_down = false;  ///< slow down a trajectory that is too fast, instead of refusing it

  WalkSettings walk;

  bool publish_footprint = true;  ///< tf from base_footprint to base_link; only of an ERS-7
  std::string frame_prefix;       ///< put before every frame; see frame()

  std::vector<std::string> unknown;  ///< given parameters that the driver does not have: most likely misspelt

  /// The full name of one of the robot's frames, as robot_state_publisher makes it with the same tf_prefix.
  std::string frame(const std::string& name) const { return frame_prefix.empty() ? name : frame_prefix + "/" + name; }
};

/// The nearest period that the robot can keep evenly: a multiple of the 4 OPEN-R frames of 8 ms in which it measures,
/// at most the 65535 frames that a request can hold.
/// @param rate messages a second, 0 or more; 0 means none, as does a period of 0
int telemetryPeriodOf(double rate);

/// The messages per second of such a period.
double telemetryRateOf(int period);

/// Checks the parameters that a user gave. Needs no ROS master.
/// @param values a struct of parameters, or an invalid value when there are none
/// @param name_prefix for a parameter's name in messages, such as "/aibo/aibo_driver/"
/// @param name_space the driver's, not the root. The camera has its name unless another is given, so that no two robots
///   share a calibration: "/team/left" names the camera "team_left".
/// @throw InvalidArgumentException values have the wrong type or are out of range; the message names all of them, and
///   says what is allowed
DriverParameters parseDriverParameters(const XmlRpc::XmlRpcValue& values, const std::string& name_prefix,
                                       const std::string& name_space);

/// Reads and checks the parameters in the namespace of `private_handle`.
/// @param handle the driver's namespace
/// @throw InvalidArgumentException as parseDriverParameters()
DriverParameters readDriverParameters(const ros::NodeHandle& handle, const ros::NodeHandle& private_handle);

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_DRIVER_PARAMETERS_H
