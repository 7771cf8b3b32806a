/// @file walk_commander.h
#ifndef AIBO_DRIVER_NODE_WALK_WALK_COMMANDER_H
#define AIBO_DRIVER_NODE_WALK_WALK_COMMANDER_H

#include <geometry_msgs/Twist.h>
#include <ros/node_handle.h>
#include <ros/steady_timer.h>

#include <string>

#include "aibo_client/rcserver_client.h"
#include "movement/mover.h"
#include "text/throttled_warnings.h"
#include "walk/walk_settings.h"

namespace aibo_driver::node {

/// The topic cmd_vel. The robot walks with the newest velocity, within the limits. The robot stops when no velocity has
/// come for a while. Only the velocities forward, to the left and around the vertical axis count.
///
/// Only one thread at a time may use an object of this class.
class WalkCommander {
 public:
  /// All arguments must outlive the commander.
  WalkCommander(const walk::WalkSettings& settings, aibo_client::RcServerClient& client, movement::Mover& mover)
      : settings_(settings), client_(client), mover_(mover) {}

  WalkCommander(const WalkCommander&) = delete;
  WalkCommander& operator=(const WalkCommander&) = delete;

  /// @param handle the joint commander's handle, so that neither commander overtakes the other
  void subscribe(const ros::NodeHandle& handle);

  void receive(const geometry_msgs::Twist& message, const movement::Order& order);

  /// Called when no velocity has come for WalkSettings::timeout.
  void runOut();

 private:
  const walk::WalkSettings& settings_;
  aibo_client::RcServerClient& client_;
  movement::Mover& mover_;
  ros::SteadyTimer timer_;
  ros::Subscriber subscriber_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_WALK_WALK_COMMANDER_H
