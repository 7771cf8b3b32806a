/// @file stream_services.h
#ifndef AIBO_DRIVER_NODE_CAMERA_STREAM_SERVICES_H
#define AIBO_DRIVER_NODE_CAMERA_STREAM_SERVICES_H

#include <aibo_driver/TakePicture.h>
#include <ros/node_handle.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <functional>
#include <string>
#include <vector>

#include "aibo_client/rcserver_client.h"
#include "node/camera/stream_policy.h"
#include "node/driver_parameters.h"

namespace aibo_driver::node {

/// The services take_picture, set_streaming and toggle_streaming.
///
/// Each call gets an answer. If something cannot be done, success is false and message says why. The call itself never
/// fails.
class StreamServices {
 public:
  using ToMessage = std::function<sensor_msgs::CompressedImage(const aibo_client::Picture&)>;

  /// @param client, policy must outlive this object
  /// @param default_quality returns the default quality of take_picture, 1..100; any thread may call it
  /// @param to_message makes the message for take_picture's answer; any thread may call it
  StreamServices(const DriverParameters& parameters, aibo_client::RcServerClient& client, StreamPolicy& policy,
                 std::function<int()> default_quality, ToMessage to_message);

  /// @param handle for set_streaming and toggle_streaming, which do not wait
  /// @param picture_handle for take_picture, which waits for the robot
  void advertise(const ros::NodeHandle& handle, const ros::NodeHandle& picture_handle);

  // These functions carry out the services. They return true, because roscpp wants that. Any thread may call them.
  bool takePicture(TakePicture::Request& request, TakePicture::Response& response);
  bool setStreaming(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response);
  bool toggleStreaming(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);

 private:
  template <typename Response>
  bool answerStreaming(bool wanted, Response& response) const;

  const DriverParameters parameters_;
  const std::string picture_folder_;  ///< the folder in which save_to may write
  aibo_client::RcServerClient& client_;
  StreamPolicy& policy_;
  const std::function<int()> default_quality_;
  const ToMessage to_message_;
  std::vector<ros::ServiceServer> servers_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_CAMERA_STREAM_SERVICES_H
