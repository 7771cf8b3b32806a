/// @file camera_state_publisher.h
#ifndef AIBO_DRIVER_ROS_CAMERA_CAMERA_STATE_PUBLISHER_H
#define AIBO_DRIVER_ROS_CAMERA_CAMERA_STATE_PUBLISHER_H

#include <aibo_driver/CameraState.h>
#include <ros/node_handle.h>
#include <ros/time.h>
#include <std_msgs/Header.h>

#include <optional>
#include <string>

#include "aibo_driver/picture.h"

namespace aibo_driver::node {

/// The state of the camera when it took a picture.
/// @param header of the picture
CameraState cameraStateOf(const Picture& picture, const std_msgs::Header& header);

/// True if both have the same size and settings, whichever pictures they are of.
bool isSameState(const CameraState& one, const CameraState& other);

/// Publishes the camera's state, latched, with the first picture that has it (camera/state).
class CameraStatePublisher {
 public:
  /// @param camera_handle the camera's namespace
  explicit CameraStatePublisher(const ros::NodeHandle& camera_handle);

  /// To be called for each picture. Never blocks. From one thread at a time.
  /// @param stamp, frame_id of the picture's messages
  void update(const Picture& picture, const ros::Time& stamp, const std::string& frame_id);

 private:
  ros::Publisher publisher_;
  std::optional<CameraState> last_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_CAMERA_CAMERA_STATE_PUBLISHER_H
