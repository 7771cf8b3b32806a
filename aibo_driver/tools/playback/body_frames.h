/// @file body_frames.h
#ifndef AIBO_DRIVER_TOOLS_PLAYBACK_BODY_FRAMES_H
#define AIBO_DRIVER_TOOLS_PLAYBACK_BODY_FRAMES_H

#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Odometry.h>
#include <ros/time.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/JointState.h>

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "node/body/body_pose.h"

namespace aibo_driver::tools {

/// Makes the driver's own part of tf again, from the recorded measurements: odom, base_footprint, base_link. If the
/// recording has no odom, the robot stays where it is.
class BodyFrames {
 public:
  /// @param frame_prefix the text before the names of all frames
  explicit BodyFrames(std::string frame_prefix) : frame_prefix_(std::move(frame_prefix)) {
    odometry_.orientation.w = 1;
  }

  void receive(const nav_msgs::Odometry& odometry) { odometry_ = odometry.pose.pose; }
  void receive(const sensor_msgs::Imu& imu) { pose_.accelerate(imu.linear_acceleration, imu.header.stamp); }
  void receive(const sensor_msgs::JointState& joints);

  /// @param stamp the stamp of the transforms
  /// @return empty until all legs have been measured
  std::vector<geometry_msgs::TransformStamped> frames(const ros::Time& stamp) const;

 private:
  geometry_msgs::TransformStamped frame(const char* parent, const char* child, const ros::Time& stamp) const;

  std::string frame_prefix_;
  geometry_msgs::Pose odometry_;
  node::BodyPose pose_;
  std::map<std::string, double> joints_;
};

}  // namespace aibo_driver::tools

#endif  // AIBO_DRIVER_TOOLS_PLAYBACK_BODY_FRAMES_H
