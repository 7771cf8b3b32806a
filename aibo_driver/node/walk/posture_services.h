/// @file posture_services.h
#ifndef AIBO_DRIVER_NODE_WALK_POSTURE_SERVICES_H
#define AIBO_DRIVER_NODE_WALK_POSTURE_SERVICES_H

#include <ros/node_handle.h>
#include <std_srvs/Trigger.h>

#include <chrono>
#include <vector>

#include "aibo_client/walk.h"
#include "movement/mover.h"

namespace aibo_driver::node {

/// The services stand, sit and rest. Each is answered when the robot has taken the posture. If the robot cannot take
/// it, success is false and message says why. A newer posture ends an older one.
class PostureServices {
 public:
  /// How long the change from one posture to another may take. The robot needs only a fraction of this time.
  static constexpr std::chrono::milliseconds kEndTimeout{30000};

  /// @param mover must outlive the services
  explicit PostureServices(movement::Mover& mover) : mover_(mover) {}

  PostureServices(const PostureServices&) = delete;
  PostureServices& operator=(const PostureServices&) = delete;

  /// @param handle whose callback queue several threads serve, so that a newer call does not wait for an older one
  void advertise(const ros::NodeHandle& handle);

  /// Takes a posture and waits until the robot has taken it.
  /// @return true, because roscpp wants that
  bool take(aibo_client::Posture posture, const movement::Order& order, std_srvs::Trigger::Response& response);

 private:
  movement::Mover& mover_;
  std::vector<ros::ServiceServer> servers_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_WALK_POSTURE_SERVICES_H
