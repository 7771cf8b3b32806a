/// @file body_frames.h
#ifndef AIBO_DRIVER_TOOLS_PLAYBACK_BODY_FRAMES_H
#define AIBO_DRIVER_TOOLS_PLAYBACK_BODY_FRAMES_H

#include <geometry_msgs/TransformStamped.h>
#include <nav_msgs/Odometry.h>
#include <ros/time.h>
#include <sensor_msgs/Imu.h>
#include <sensor_msgs/JointState.h>

#include <algorithm>
#include <array>
#include <cstddef>
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
  void receive(const sensor_msgs::JointState& joints) {
    for (std::size_t i = 0; i < std::min(joints.name.size(), joints.position.size()); ++i) {
      joints_[joints.name[i]] = joints.position[i];
    }
  }

  /// @param stamp the stamp of the transforms
  /// @return empty until all legs have been measured
  std::vector<geometry_msgs::TransformStamped> frames(const ros::Time& stamp) const {
    std::array<walk::LegAngles, walk::kLegs> legs{};
    for (std::size_t leg = 0; leg < walk::kLegs; ++leg) {
      double* const angles[] = {&legs[leg].rotator, &legs[leg].elevator, &legs[leg].knee};
      for (std::size_t joint = 0; joint < std::size(angles); ++joint) {
        const auto measured = joints_.find(node::legJointName(leg, joint));
        if (measured == joints_.end()) {
          return {};
        }
        *angles[joint] = measured->second;
      }
    }
    geometry_msgs::TransformStamped walked = frame("odom", "base_footprint", stamp);
    walked.transform.translation.x = odometry_.position.x;
    walked.transform.translation.y = odometry_.position.y;
    walked.transform.rotation = odometry_.orientation;
    geometry_msgs::TransformStamped body = frame("base_footprint", "base_link", stamp);
    body.transform = pose_.above(legs);
    return {walked, body};
  }

 private:
  geometry_msgs::TransformStamped frame(const char* parent, const char* child, const ros::Time& stamp) const {
    geometry_msgs::TransformStamped transform;
    transform.header.stamp = stamp;
    transform.header.frame_id = frame_prefix_ + parent;
    transform.child_frame_id = frame_prefix_ + child;
    return transform;
  }

  std::string frame_prefix_;
  geometry_msgs::Pose odometry_;
  node::BodyPose pose_;
  std::map<std::string, double> joints_;
};

}  // namespace aibo_driver::tools

#endif  // AIBO_DRIVER_TOOLS_PLAYBACK_BODY_FRAMES_H
