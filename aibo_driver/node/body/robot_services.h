/// @file robot_services.h
#ifndef AIBO_DRIVER_NODE_BODY_ROBOT_SERVICES_H
#define AIBO_DRIVER_NODE_BODY_ROBOT_SERVICES_H

#include <aibo_driver/DeleteMotion.h>
#include <aibo_driver/ListMotions.h>
#include <aibo_driver/PlayMotion.h>
#include <aibo_driver/UploadMotion.h>
#include <ros/node_handle.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <chrono>
#include <string>
#include <vector>

#include "aibo_client/rcserver_client.h"
#include "movement/mover.h"

namespace aibo_driver::node {

/// The services that the robot carries out: stop, release, motors, play_motion, list_motions, upload_motion,
/// delete_motion, shut_down and reboot.
///
/// Each call waits for the robot's answer. If something cannot be done, success is false and message says why. The call
/// itself never fails.
///
/// The name of a motion is enough to call it: see files::motionFileName().
class RobotServices {
 public:
  /// How long each kind of call waits for the robot's answer. A memory stick is slow. Calls that move the robot wait
  /// for Mover::kTimeout.
  static constexpr std::chrono::milliseconds kFileTimeout{5000};
  static constexpr std::chrono::milliseconds kUploadTimeout{15000};
  static constexpr std::chrono::milliseconds kPowerTimeout{5000};

  /// @param client, mover must outlive the services
  RobotServices(aibo_client::RcServerClient& client, movement::Mover& mover) : client_(client), mover_(mover) {}

  /// @param stop_handle for stop, release and motors, which wait for no other service
  /// @param motion_handle for play_motion
  /// @param handle for the other services
  void advertise(const ros::NodeHandle& stop_handle, const ros::NodeHandle& motion_handle,
                 const ros::NodeHandle& handle);

  // These functions carry out the services. All of them return true, because roscpp wants that.
  bool stop(const movement::Order& order, std_srvs::Trigger::Response& response);
  bool release(const movement::Order& order, std_srvs::Trigger::Response& response);
  bool setMotors(const movement::Order& order, bool on, std_srvs::SetBool::Response& response);
  bool playMotion(const movement::Order& order, const PlayMotion::Request& request, PlayMotion::Response& response);
  bool listMotions(ListMotions::Request& request, ListMotions::Response& response);
  bool uploadMotion(UploadMotion::Request& request, UploadMotion::Response& response);
  bool deleteMotion(DeleteMotion::Request& request, DeleteMotion::Response& response);
  bool shutDown(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);
  bool reboot(std_srvs::Trigger::Request& request, std_srvs::Trigger::Response& response);

 private:
  aibo_client::RcServerClient& client_;
  movement::Mover& mover_;
  std::vector<ros::ServiceServer> servers_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_BODY_ROBOT_SERVICES_H
