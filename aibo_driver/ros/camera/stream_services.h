/// @file stream_services.h
#ifndef AIBO_DRIVER_ROS_CAMERA_STREAM_SERVICES_H
#define AIBO_DRIVER_ROS_CAMERA_STREAM_SERVICES_H

#include <aibo_driver/TakePicture.h>
#include <ros/callback_queue.h>
#include <ros/node_handle.h>
#include <ros/spinner.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <functional>
#include <string>

#include "aibo_driver/rcserver_client.h"
#include "ros/camera/stream_policy.h"
#include "ros/driver_parameters.h"

namespace aibo_driver::node {

/// The services take_picture, set_streaming and toggle_streaming, and the latched topic streaming.
///
/// Each call is answered: what cannot be done is told by success = false and a message, never by a failed call.
/// take_picture, which waits for the robot, has threads of its own, so that nobody else waits with it.
class StreamServices {
 public:
  using ToMessage = std::function<sensor_msgs::CompressedImage(const Picture&)>;

  /// Publishes at once that the stream is off.
  /// @param client, policy must outlive this object
  /// @param to_message makes the message that take_picture answers with; thread-safe
  StreamServices(const ros::NodeHandle& handle, const DriverParameters& parameters, RcServerClient& client,
                 StreamPolicy& policy, ToMessage to_message);

  /// A take_picture() that waits must have been ended before, by stopping the client.
  ~StreamServices();

  StreamServices(const StreamServices&) = delete;
  StreamServices& operator=(const StreamServices&) = delete;

  /// Never blocks. From one thread at a time.
  void publishStreaming(bool streaming);

 private:
  bool takePicture(TakePicture::Request& request, TakePicture::Response& response);
  bool setStreaming(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response);
  bool toggleStreaming(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);

  /// What a call that wanted the stream on or off is answered.
  /// @return true if it is as wanted, or will be without the caller's doing
  bool describeStream(bool wanted, std::string* message) const;

  const DriverParameters parameters_;
  RcServerClient& client_;
  StreamPolicy& policy_;
  const ToMessage to_message_;

  ros::Publisher streaming_publisher_;
  ros::ServiceServer set_streaming_server_;
  ros::ServiceServer toggle_streaming_server_;
  ros::CallbackQueue take_picture_queue_;
  ros::ServiceServer take_picture_server_;
  ros::AsyncSpinner take_picture_threads_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_CAMERA_STREAM_SERVICES_H
