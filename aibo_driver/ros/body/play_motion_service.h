/// @file play_motion_service.h
#ifndef AIBO_DRIVER_ROS_BODY_PLAY_MOTION_SERVICE_H
#define AIBO_DRIVER_ROS_BODY_PLAY_MOTION_SERVICE_H

#include <aibo_driver/PlayMotion.h>
#include <ros/node_handle.h>

#include <chrono>
#include <functional>
#include <string>

#include "aibo_driver/rcserver_client.h"

namespace aibo_driver::node {

/// The service play_motion: plays what is on the robot's memory stick, or stops it.
class PlayMotionService {
 public:
  static constexpr std::chrono::milliseconds kTimeout{2000};

  /// @param client must outlive the service
  /// @param beginning called before the robot is asked to play a motion; from the handle's callback queue. What it
  ///   throws, the caller of the service is told
  PlayMotionService(const ros::NodeHandle& handle, RcServerClient& client, std::function<void()> beginning);

 private:
  bool playMotion(PlayMotion::Request& request, PlayMotion::Response& response);
  std::string play(const std::string& name, int repetitions);
  std::string stop(const std::string& name);

  RcServerClient& client_;
  const std::function<void()> beginning_;
  ros::ServiceServer server_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_BODY_PLAY_MOTION_SERVICE_H
