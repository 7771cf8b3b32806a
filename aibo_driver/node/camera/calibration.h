/// @file calibration.h
#ifndef AIBO_DRIVER_NODE_CAMERA_CALIBRATION_H
#define AIBO_DRIVER_NODE_CAMERA_CALIBRATION_H

#include <ros/console.h>
#include <ros/node_handle.h>
#include <ros/service_server.h>
#include <sensor_msgs/CameraInfo.h>
#include <sensor_msgs/SetCameraInfo.h>

#include <cstdint>
#include <mutex>
#include <string>
#include <utility>

#include "text/throttled_warnings.h"

namespace aibo_driver::node {

/// The camera's calibration, with the service set_camera_info. The nominal calibration (nominal_calibration.h) is used
/// until a calibration is stored, and while the stored one does not fit the size of the robot's pictures.
///
/// The files are where camera_info_manager would have them. That package's service accepts and saves anything. This
/// service refuses what makes no sense (calibration_check.h), and keeps the old calibration.
class Calibration {
 public:
  /// @param camera_handle the camera's namespace
  /// @param camera_name the name in the file
  /// @param url the URL of the file: see calibrationFile()
  /// @param design the robot's design: see nominalCalibration()
  /// @throw Exception calibrationFile() throws it
  Calibration(const ros::NodeHandle& camera_handle, const std::string& camera_name, const std::string& url,
              const std::string& design);

  /// Call this for each picture, so that a calibration that does not fit is noticed even if nobody asks for it. Any
  /// thread may call it.
  void pictureCame(std::uint32_t width, std::uint32_t height);

  /// The calibration for a picture, without a header. It always has the picture's size. Any thread may call it.
  /// @param width, height the size of the picture, above 0
  sensor_msgs::CameraInfo infoFor(std::uint32_t width, std::uint32_t height);

 private:
  bool set(sensor_msgs::SetCameraInfo::Request& request, sensor_msgs::SetCameraInfo::Response& response);
  std::pair<std::uint32_t, std::uint32_t> pictureSize();
  std::string store(const sensor_msgs::CameraInfo& info);

  const std::string camera_name_;
  const std::string design_;
  const std::string file_;

  std::mutex mutex_;
  sensor_msgs::CameraInfo stored_;    ///< empty if no calibration is stored
  bool misfit_reported_ = false;      ///< a misfit was reported after the last change of stored_
  std::uint32_t picture_width_ = 0;   ///< the width of the latest picture; 0 before the first one
  std::uint32_t picture_height_ = 0;  ///< the height of the latest picture; 0 before the first one

  text::ThrottledWarnings warnings_{[](const std::string& text) { ROS_WARN_STREAM_NAMED("camera", text); }};
  text::ThrottledWarnings news_{[](const std::string& text) { ROS_INFO_STREAM_NAMED("camera", text); }};
  ros::ServiceServer service_;
};

/// The path of a calibration's file. Any thread may call this function.
/// @param url file:///FILE.yaml or package://PACKAGE/FILE.yaml, or the same with .ini. ${ROS_HOME} stands for
///   files::rosHome(), and ${NAME} for the camera's name. An empty url means
///   file://${ROS_HOME}/camera_info/${NAME}.yaml, as with camera_info_manager.
/// @param camera_name the camera's name
/// @throw InvalidArgumentException the url names no YAML or INI file, or the package does not exist
/// @throw FileException there is no home: see files::rosHome()
std::string calibrationFile(const std::string& url, const std::string& camera_name);

/// Writes a calibration to a YAML or INI file. If this fails, the file stays as it was (replace_file.h). A missing
/// folder is made.
/// @throw files::FileException the file cannot be written, or is an INI file, which has no such distortion model
/// @throw std::filesystem::filesystem_error its folder cannot be made
void saveCalibration(const sensor_msgs::CameraInfo& info, const std::string& camera_name, const std::string& file);

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_CAMERA_CALIBRATION_H
