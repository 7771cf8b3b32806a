/// @file calibration.h
#ifndef AIBO_DRIVER_ROS_CAMERA_CALIBRATION_H
#define AIBO_DRIVER_ROS_CAMERA_CALIBRATION_H

#include <camera_info_manager/camera_info_manager.h>
#include <ros/node_handle.h>
#include <ros/service_server.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/SetCameraInfo.h>

#include <string>

namespace aibo_driver::node {

/// The camera's calibration, with the service set_camera_info.
///
/// Files are found as camera_info_manager finds them. Its own service would accept and save anything, so this one takes
/// its place: it refuses what cannot be a calibration of the robot's camera, and keeps the old one.
class Calibration {
 public:
  /// @param camera_handle the camera's namespace
  /// @param camera_name the name in the file
  /// @param url of the file, as camera_info_manager understands it
  /// @throw InvalidArgumentException camera_info_manager does not understand the url
  Calibration(const ros::NodeHandle& camera_handle, const std::string& camera_name, const std::string& url);

  /// From any thread.
  sensor_msgs::CameraInfo cameraInfo() { return manager_.getCameraInfo(); }

  /// From any thread.
  bool isCalibrated() { return manager_.isCalibrated(); }

 private:
  bool set(sensor_msgs::SetCameraInfo::Request& request, sensor_msgs::SetCameraInfo::Response& response);

  const std::string camera_name_;
  camera_info_manager::CameraInfoManager manager_;
  std::string file_;
  ros::ServiceServer service_;
};

/// Finds out why a message cannot be a calibration of the robot's camera: a size that is not from 1x1 to that of the
/// largest picture (jpeg_inspector.h); a distortion model other than plumb_bob, rational_polynomial, equidistant and
/// none; more than 14 coefficients; numbers that are not finite. From any thread.
/// @return the problem, for a message to the user; empty if there is none
std::string problemOf(const sensor_msgs::CameraInfo& info);

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_CAMERA_CALIBRATION_H
