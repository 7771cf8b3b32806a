/// @file camera_publisher.h
#ifndef AIBO_DRIVER_NODE_CAMERA_CAMERA_PUBLISHER_H
#define AIBO_DRIVER_NODE_CAMERA_CAMERA_PUBLISHER_H

#include <aibo_driver/CameraState.h>
#include <ros/node_handle.h>
#include <sensor_msgs/CompressedImage.h>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <tuple>

#include "aibo_client/camera.h"
#include "node/camera/calibration.h"
#include "node/driver_parameters.h"
#include "node/robot_stamper.h"

namespace aibo_driver::node {

using aibo_client::Picture;

/// The state of the camera when it took a picture. It has no header.
CameraState cameraStateOf(const Picture& picture);

/// Publishes each picture as the robot sent it (image_raw/compressed), and a camera_info of its size with the same
/// header: see Calibration. If the camera's state has changed, or the picture is the first one of a connection, it also
/// publishes the state, latched (state).
class CameraPublisher {
 public:
  /// The format of all pictures. It makes image_transport's decoders output the same encoding as our image_raw. A plain
  /// "jpeg" means bgr8 to some releases of compressed_image_transport and rgb8 to others.
  static constexpr const char* kFormat = "bgr8; jpeg compressed bgr8";

  /// @param camera_handle the camera's namespace
  /// @param robot_clock must outlive the publisher; if it is null, the stamp of a picture is its time of arrival
  /// @param subscribers_changed called from camera_handle's callback queue when a subscriber comes or goes
  /// @throw InvalidArgumentException camera_info_url is wrong: see Calibration
  CameraPublisher(const ros::NodeHandle& camera_handle, const DriverParameters& parameters,
                  robot_time::RobotClock* robot_clock, const std::function<void()>& subscribers_changed);

  /// Publishes a picture to its subscribers. It never blocks. Only one thread at a time may call it.
  /// @param stamp the stamp from momentOf()
  /// @param is_wanted true if the caller needs the message, too
  /// @return the message; null if nobody needs it
  sensor_msgs::CompressedImageConstPtr publish(const Picture& picture, const ros::Time& stamp, bool is_wanted);

  /// Makes a message of a picture. The same picture gets the same header each time. Any thread may call this.
  sensor_msgs::CompressedImage toMessage(const Picture& picture) { return toMessage(picture, momentOf(picture).stamp); }

  /// When the picture was taken, and the stamp of its messages. Call this for each picture, even if nobody listens: all
  /// pictures show the robot's clock. Any thread may call it.
  RobotStamper::Moment momentOf(const Picture& picture) { return stamper_.momentOf(picture); }

  bool hasSubscribers() const;

 private:
  sensor_msgs::CompressedImage toMessage(const Picture& picture, const ros::Time& stamp) const;
  void publishCameraInfo(const Picture& picture, const ros::Time& stamp);
  void publishState(const Picture& picture, const ros::Time& stamp);

  const std::string frame_id_;
  RobotStamper stamper_;
  Calibration calibration_;
  ros::Publisher compressed_publisher_;
  ros::Publisher camera_info_publisher_;
  ros::Publisher state_publisher_;
  /// The connection of the last picture, and the camera's state then.
  std::tuple<std::uint64_t, int, int, std::optional<aibo_client::CameraSettings>> last_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_CAMERA_CAMERA_PUBLISHER_H
