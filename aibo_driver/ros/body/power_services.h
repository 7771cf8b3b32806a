/// @file power_services.h
#ifndef AIBO_DRIVER_ROS_BODY_POWER_SERVICES_H
#define AIBO_DRIVER_ROS_BODY_POWER_SERVICES_H

#include <ros/node_handle.h>
#include <std_srvs/Trigger.h>

#include <chrono>

#include "aibo_driver/rcserver_client.h"

namespace aibo_driver::node {

/// The services shut_down and reboot. The robot does it only if its RCSERVER.CFG allows it.
class PowerServices {
 public:
  static constexpr std::chrono::milliseconds kTimeout{5000};

  /// @param client must outlive the services
  PowerServices(const ros::NodeHandle& handle, RcServerClient& client);

 private:
  bool shutDown(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool reboot(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);

  RcServerClient& client_;
  ros::ServiceServer shut_down_server_;
  ros::ServiceServer reboot_server_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_BODY_POWER_SERVICES_H
