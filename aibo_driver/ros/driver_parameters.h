/// @file driver_parameters.h
#ifndef AIBO_DRIVER_ROS_DRIVER_PARAMETERS_H
#define AIBO_DRIVER_ROS_DRIVER_PARAMETERS_H

#include <ros/node_handle.h>
#include <xmlrpcpp/XmlRpcValue.h>

#include <chrono>
#include <string>
#include <vector>

#include "aibo_driver/rcserver_client.h"

namespace aibo_driver::node {

/// The driver's private parameters, read once at start. Some of them can be changed later: see LiveSettings.
/// docs/ros_interface.md describes each of them for users.
struct DriverParameters {
  ClientOptions client;           ///< host, port, jpeg_quality, the time limits and the reconnect waits
  bool stream_on_start = true;    ///< whether the stream is wanted before set_streaming is called
  bool stream_on_demand = false;  ///< stream only while a camera topic has a subscriber
  std::string frame_id = "camera_optical_frame";
  std::string camera_name = "aibo";                      ///< letters, digits and underscores
  std::string camera_info_url;                           ///< empty: camera_info_manager's own default
  bool use_robot_time = true;                            ///< stamp by the robot's frame numbers, if it sends them
  std::chrono::nanoseconds time_offset{0};               ///< added to every stamp; at most 60 s either way
  std::chrono::milliseconds take_picture_timeout{2000};  ///< 100 ms..60 s

  std::string robot = "ERS-7";     ///< or "ERS-210"
  double telemetry_rate = 31.25;   ///< 0..31.25 messages a second, joint_states and sensors; 0: none
  double joint_speed_limit = 3.0;  ///< rad/s, 0.1..20; a joint that cannot move that fast has its own limit
  double speed_scale = 1.0;        ///< 0.1..1, of the speed limits
  double approach_speed = 0.5;     ///< rad/s, 0.05..20; for the first motion of each joint, see JointCommandFilter
  bool slow_down = false;          ///< slow down a trajectory that is too fast, instead of refusing it

  bool publish_footprint = true;  ///< tf from base_footprint to base_link; only of an ERS-7

  std::vector<std::string> unknown;  ///< given parameters that the driver does not have: most likely misspelt
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
/// @throw InvalidArgumentException values have the wrong type or are out of range; the message names all of them, and
///   says what is allowed
DriverParameters parseDriverParameters(const XmlRpc::XmlRpcValue& values, const std::string& name_prefix);

/// Reads and checks the parameters in the namespace of `private_handle`.
/// @throw InvalidArgumentException as parseDriverParameters()
DriverParameters readDriverParameters(const ros::NodeHandle& private_handle);

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_DRIVER_PARAMETERS_H
