/// @file camera_publisher.h
#ifndef AIBO_DRIVER_ROS_CAMERA_CAMERA_PUBLISHER_H
#define AIBO_DRIVER_ROS_CAMERA_CAMERA_PUBLISHER_H

#include <ros/node_handle.h>
#include <sensor_msgs/CompressedImage.h>

#include <functional>
#include <optional>
#include <string>

#include "aibo_driver/picture.h"
#include "ros/camera/calibration.h"
#include "ros/driver_parameters.h"
#include "ros/robot_stamper.h"

namespace aibo_driver::node {

/// Publishes each picture as the robot sent it (image_raw/compressed), and camera_info of its size with the same
/// header: see Calibration.
class CameraPublisher {
 public:
  /// The format of all pictures. It makes image_transport's decoders deliver the encoding of our own image_raw. A plain
  /// "jpeg" means bgr8 to some releases of compressed_image_transport and rgb8 to others.
  static constexpr const char* kFormat = "bgr8; jpeg compressed bgr8";

  /// @param camera_handle the camera's namespace
  /// @param robot_clock must outlive the publisher; null: pictures are stamped with their arrival
  /// @param subscribers_changed called from camera_handle's callback queue when a subscriber comes or goes
  /// @throw InvalidArgumentException as Calibration, for camera_info_url
  CameraPublisher(const ros::NodeHandle& camera_handle, const DriverParameters& parameters,
                  robot_time::RobotClock* robot_clock, const std::function<void()>& subscribers_changed);

  /// Publishes a picture to those who listen. Never blocks. From one thread at a time.
  /// @param is_wanted the caller needs the message, too
  /// @return the message; null if it was not made, because nobody needs it
  sensor_msgs::CompressedImageConstPtr publish(const Picture& picture, bool is_wanted);

  /// The picture as a message. The same picture gets the same header each time. From any thread.
  sensor_msgs::CompressedImage toMessage(const Picture& picture);

  /// The stamp of the picture's messages. To be called for each picture, whether anybody listens or not: the robot's
  /// clock is known from all of them. From any thread.
  ros::Time stamp(const Picture& picture) { return stamper_.stamp(picture); }

  const std::string& frameId() const { return frame_id_; }

  /// As RobotStamper::takenAt(). From any thread.
  std::optional<RobotStamper::SteadyTime> takenAt(const Picture& picture) { return stamper_.takenAt(picture); }

  bool hasSubscribers() const;

 private:
  void publishCameraInfo(const Picture& picture);

  const std::string frame_id_;
  RobotStamper stamper_;
  Calibration calibration_;
  ros::Publisher compressed_publisher_;
  ros::Publisher camera_info_publisher_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_CAMERA_CAMERA_PUBLISHER_H
