/// @file odometry_publisher.h
#ifndef AIBO_DRIVER_NODE_WALK_ODOMETRY_PUBLISHER_H
#define AIBO_DRIVER_NODE_WALK_ODOMETRY_PUBLISHER_H

#include <nav_msgs/Odometry.h>
#include <ros/node_handle.h>

#include "aibo_client/motion_end.h"
#include "aibo_client/telemetry.h"
#include "node/driver_parameters.h"
#include "node/robot_stamper.h"
#include "node/walk/walked_way.h"

namespace aibo_driver::node {

/// Makes the message. It has no header yet.
/// @param velocity the velocity with which the robot walks
nav_msgs::Odometry toMessage(const Odometry& odometry, const aibo_client::WalkVelocity& velocity);

/// Publishes the topic odom for a robot that reports how it walks. If wanted, it also publishes odom to base_footprint
/// in tf; a robot that does not walk then stands where it began. Both have the stamp of the measurement, like all other
/// frames that come from it.
///
/// Only one thread at a time may use it.
class OdometryPublisher {
 public:
  /// All arguments but the handle must outlive the object.
  OdometryPublisher(const ros::NodeHandle& handle, const DriverParameters& parameters, RobotStamper& stamper);

  /// Call this when the robot has measured something.
  void publish(const aibo_client::Telemetry& telemetry);

  /// Call this when the robot reports that a motion has ended.
  void motionEnded(const aibo_client::MotionEnd& end) { way_.motionEnded(end); }

  /// Call this when the robot reports its posture.
  void update(const aibo_client::MotorsAndPosture& state) { way_.update(state); }

 private:
  void publishTransform(const nav_msgs::Odometry& odom);

  const DriverParameters& parameters_;
  RobotStamper& stamper_;
  WalkedWay way_;
  ros::Publisher odom_;
  ros::Publisher tf_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_WALK_ODOMETRY_PUBLISHER_H
