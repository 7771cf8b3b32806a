/// @file odometry_publisher.h
#ifndef AIBO_DRIVER_NODE_WALK_ODOMETRY_PUBLISHER_H
#define AIBO_DRIVER_NODE_WALK_ODOMETRY_PUBLISHER_H

#include <nav_msgs/Odometry.h>
#include <ros/node_handle.h>

#include <chrono>
#include <mutex>
#include <optional>

#include "aibo_client/orders.h"
#include "aibo_client/telemetry.h"
#include "node/driver_parameters.h"
#include "node/robot_stamper.h"
#include "walk/goal_controller.h"
#include "walk/walk_odometry.h"

namespace aibo_driver::node {

/// Makes the message. It has no header yet.
/// @param velocity the velocity with which the robot walks
nav_msgs::Odometry toMessage(const walk::Odometry& odometry, const aibo_client::WalkVelocity& velocity);

/// Publishes the topic odom for a robot that reports how it walks. If wanted, it also publishes odom to base_footprint
/// in tf; a robot that cannot walk then stays where it began. Both have the stamp of the measurement, like all other
/// frames that come from it.
///
/// Only one thread at a time may use it, except for here().
class OdometryPublisher {
 public:
  /// All arguments except the handle must outlive the object.
  OdometryPublisher(const ros::NodeHandle& handle, const DriverParameters& parameters, RobotStamper& stamper);

  /// Call this when the robot has measured something.
  void publish(const aibo_client::Telemetry& telemetry);

  /// Call this when the robot reports that a motion has ended.
  void motionEnded(const aibo_client::ActivityEnd& end) { walked_.motionEnded(end); }

  /// Call this when the robot reports its posture.
  void update(const aibo_client::MotorsAndPosture& state) { walked_.update(state); }

  /// Where the robot is in the frame odom. The result is empty if the robot has not said so within kFresh. Any thread
  /// may call this function.
  std::optional<walk::PlanePose> here() const;

 private:
  /// How old a measurement may be. The robot itself waits just as long for the next velocity of a walk.
  static constexpr std::chrono::milliseconds kFresh{500};

  void publishTransform(const nav_msgs::Odometry& odom);

  const DriverParameters& parameters_;
  RobotStamper& stamper_;
  walk::WalkOdometry walked_;
  ros::Publisher odom_;
  ros::Publisher tf_;
  mutable std::mutex mutex_;  ///< guards the members below
  walk::PlanePose here_;
  std::optional<std::chrono::steady_clock::time_point> measured_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_WALK_ODOMETRY_PUBLISHER_H
