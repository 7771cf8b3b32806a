/// @file motor_service.h
#ifndef AIBO_DRIVER_ROS_BODY_MOTOR_SERVICE_H
#define AIBO_DRIVER_ROS_BODY_MOTOR_SERVICE_H

#include <ros/node_handle.h>
#include <std_srvs/SetBool.h>

#include <chrono>
#include <functional>

#include "aibo_driver/rcserver_client.h"

namespace aibo_driver::node {

/// The service motors: the joints hold and move, or can be moved by hand.
class MotorService {
 public:
  static constexpr std::chrono::milliseconds kTimeout{2000};

  /// @param client must outlive the service
  /// @param switching called before the robot is asked to switch, whatever becomes of it; from the handle's callback
  ///   queue
  MotorService(const ros::NodeHandle& handle, RcServerClient& client, std::function<void()> switching);

 private:
  bool setMotors(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response);

  RcServerClient& client_;
  const std::function<void()> switching_;
  ros::ServiceServer server_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_BODY_MOTOR_SERVICE_H
