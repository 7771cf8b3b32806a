/// @file camera_state_publisher.h
#ifndef AIBO_DRIVER_NODE_CAMERA_CAMERA_STATE_PUBLISHER_H
#define AIBO_DRIVER_NODE_CAMERA_CAMERA_STATE_PUBLISHER_H

#include <aibo_driver/CameraState.h>
#include <ros/node_handle.h>
#include <ros/time.h>
#include <std_msgs/Header.h>

#include <cstdint>
#include <optional>
#include <string>

#include "aibo_client/camera.h"

namespace aibo_driver::node {

/// The state of the camera when it took a picture.
/// @param header the header of the picture's message
CameraState cameraStateOf(const aibo_client::Picture& picture, const std_msgs::Header& header);

/// True if two states have the same size and settings, even if they belong to different pictures.
bool isSameState(const CameraState& one, const CameraState& other);

/// Publishes the camera's state (camera/state), latched, when it changes. It is also published for the first picture of
/// a connection, so that the frame number is one of this connection.
class CameraStatePublisher {
 public:
  /// @param camera_handle the camera's namespace
  explicit CameraStatePublisher(const ros::NodeHandle& camera_handle);

  /// Call this for each picture. It never blocks. Only one thread at a time may call it.
  /// @param stamp, frame_id the stamp and frame of the picture's messages
  void update(const aibo_client::Picture& picture, const ros::Time& stamp, const std::string& frame_id);

 private:
  ros::Publisher publisher_;
  std::optional<CameraState> last_;
  std::uint64_t connection_ = 0;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_CAMERA_CAMERA_STATE_PUBLISHER_H
