/// @file odometry_publisher.h
#ifndef AIBO_DRIVER_ROS_WALK_ODOMETRY_PUBLISHER_H
#define AIBO_DRIVER_ROS_WALK_ODOMETRY_PUBLISHER_H

#include <nav_msgs/Odometry.h>
#include <ros/node_handle.h>

#include "aibo_driver/motion_end.h"
#include "aibo_driver/telemetry.h"
#include "ros/driver_parameters.h"
#include "ros/robot_stamper.h"
#include "ros/walk/walked_way.h"

namespace aibo_driver::node {

/// As a message, but for its header.
/// @param velocity with which the robot walks
nav_msgs::Odometry toMessage(const Odometry& odometry, const WalkVelocity& velocity);

/// Publishes the topic odom, for a robot that says how it walks, and, if wanted, odom to base_footprint in tf: a robot
/// that does not walk stands where it began. Both have the stamp of the measurement, as all other frames of the robot
/// that come from it.
///
/// From one thread at a time.
class OdometryPublisher {
 public:
  /// All arguments but the handle must outlive the object.
  OdometryPublisher(const ros::NodeHandle& handle, const DriverParameters& parameters, RobotStamper& stamper);

  /// The robot has measured something.
  void publish(const Telemetry& telemetry);

  /// The robot reports that something has ended.
  void motionEnded(const MotionEnd& end) { way_.motionEnded(end); }

  /// The robot tells its posture.
  void update(const MotorsAndPosture& state) { way_.update(state); }

 private:
  void publishTransform(const nav_msgs::Odometry& odom);

  const DriverParameters& parameters_;
  RobotStamper& stamper_;
  WalkedWay way_;
  ros::Publisher odom_;
  ros::Publisher tf_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_WALK_ODOMETRY_PUBLISHER_H
