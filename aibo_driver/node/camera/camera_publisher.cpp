#include "node/camera/camera_publisher.h"

#include <image_transport/camera_common.h>
#include <sensor_msgs/CameraInfo.h>

#include <cstdint>

#include "node/state_publisher.h"

namespace aibo_driver::node {
namespace {

// The size of each subscriber's queue. At 30 pictures a second, a slow subscriber is at most 170 ms behind.
constexpr std::uint32_t kPictureQueueSize = 5;

}  // namespace

CameraState cameraStateOf(const Picture& picture) {
  CameraState state;
  state.frame_number = picture.frame_number.value_or(0);
  state.image_count = picture.image_count.value_or(0);
  state.width = static_cast<std::uint16_t>(picture.width);
  state.height = static_cast<std::uint16_t>(picture.height);
  if (picture.settings) {
    state.white_balance = static_cast<std::uint8_t>(picture.settings->white_balance);
    state.gain = static_cast<std::uint8_t>(picture.settings->gain);
    state.shutter_speed = static_cast<std::uint8_t>(picture.settings->shutter_speed);
    state.auto_exposure = static_cast<std::uint8_t>(picture.settings->auto_exposure);
    state.auto_white_balance = static_cast<std::uint8_t>(picture.settings->auto_white_balance);
  }
  return state;
}

CameraPublisher::CameraPublisher(const ros::NodeHandle& camera_handle, const DriverParameters& parameters,
                                 robot_time::RobotClock* robot_clock, const std::function<void()>& subscribers_changed)
    : frame_id_(parameters.frame(parameters.frame_id)),
      stamper_(robot_clock, parameters.time_offset),
      calibration_(camera_handle, parameters.camera_name, parameters.camera_info_url, parameters.robot) {
  ros::NodeHandle handle(camera_handle);
  const std::string image_topic = handle.resolveName("image_raw");
  const ros::SubscriberStatusCallback on_change = [subscribers_changed](const ros::SingleSubscriberPublisher&) {
    subscribers_changed();
  };
  // The names are built from the resolved base name, so that remapping image_raw remaps these two as well.
  compressed_publisher_ = handle.advertise<sensor_msgs::CompressedImage>(image_topic + "/compressed", kPictureQueueSize,
                                                                         on_change, on_change);
  camera_info_publisher_ = handle.advertise<sensor_msgs::CameraInfo>(image_transport::getCameraInfoTopic(image_topic),
                                                                     kPictureQueueSize, on_change, on_change);
  constexpr bool kLatched = true;
  state_publisher_ = handle.advertise<CameraState>("state", 10, kLatched);
}

// A message wakes roscpp's thread, which takes a lock. The question whether there are subscribers needs the same lock,
// so it is asked before the message is published.
sensor_msgs::CompressedImageConstPtr CameraPublisher::publish(const Picture& picture, const ros::Time& stamp,
                                                              bool is_wanted) {
  publishState(picture, stamp);
  calibration_.pictureCame(static_cast<std::uint32_t>(picture.width), static_cast<std::uint32_t>(picture.height));
  const bool has_listeners = compressed_publisher_.getNumSubscribers() > 0;
  if (camera_info_publisher_.getNumSubscribers() > 0) {
    publishCameraInfo(picture, stamp);
  }
  if (!has_listeners && !is_wanted) {
    return nullptr;
  }
  const auto message = boost::make_shared<const sensor_msgs::CompressedImage>(toMessage(picture, stamp));
  if (has_listeners) {
    compressed_publisher_.publish(message);
  }
  return message;
}

sensor_msgs::CompressedImage CameraPublisher::toMessage(const Picture& picture, const ros::Time& stamp) const {
  sensor_msgs::CompressedImage message;
  message.header.stamp = stamp;
  message.header.frame_id = frame_id_;
  message.format = kFormat;
  message.data = picture.jpeg;
  return message;
}

bool CameraPublisher::hasSubscribers() const {
  return compressed_publisher_.getNumSubscribers() > 0 || camera_info_publisher_.getNumSubscribers() > 0;
}

void CameraPublisher::publishCameraInfo(const Picture& picture, const ros::Time& stamp) {
  const auto message = boost::make_shared<sensor_msgs::CameraInfo>(
      calibration_.infoFor(static_cast<std::uint32_t>(picture.width), static_cast<std::uint32_t>(picture.height)));
  message->header.stamp = stamp;
  message->header.frame_id = frame_id_;
  camera_info_publisher_.publish(sensor_msgs::CameraInfoConstPtr(message));
}

void CameraPublisher::publishState(const Picture& picture, const ros::Time& stamp) {
  const std::tuple state(picture.connection_number, picture.width, picture.height, picture.settings);
  if (state != last_) {
    last_ = state;
    CameraState message = cameraStateOf(picture);
    message.header.stamp = stamp;
    message.header.frame_id = frame_id_;
    publishLatched(state_publisher_, message);
  }
}

}  // namespace aibo_driver::node
