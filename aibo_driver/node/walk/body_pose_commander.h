/// @file body_pose_commander.h
#ifndef AIBO_DRIVER_NODE_WALK_BODY_POSE_COMMANDER_H
#define AIBO_DRIVER_NODE_WALK_BODY_POSE_COMMANDER_H

#include <geometry_msgs/Pose.h>
#include <ros/console.h>
#include <ros/node_handle.h>

#include <string>
#include <vector>

#include "movement/joint_table.h"
#include "movement/measured_joints.h"
#include "movement/mover.h"
#include "text/throttled_warnings.h"
#include "walk/body_offset.h"

namespace aibo_driver::node {

/// The topic body_pose. It raises, lowers and tilts the body of an ERS-7 that stands, by commands to the joints of its
/// legs. A robot that does not say that it stands is not moved, and neither is one that walks, takes a posture or plays
/// a motion.
///
/// Only one thread at a time may use an object of this class.
class BodyPoseCommander {
 public:
  /// The speed of the joint that has the longest way, in rad/s: 45 degrees per second. The robot takes its postures at
  /// this speed (POSTURE_SPEED in rcserver/walk/Walker.h), which we chose because the legs carry it.
  static constexpr double kSpeed = 0.785;

  /// All arguments must outlive the commander.
  BodyPoseCommander(const movement::JointTable& table, const movement::MeasuredJoints& measured, movement::Mover& mover)
      : table_(table), measured_(measured), mover_(mover) {}

  BodyPoseCommander(const BodyPoseCommander&) = delete;
  BodyPoseCommander& operator=(const BodyPoseCommander&) = delete;

  /// @param handle the joint commander's handle, so that neither commander overtakes the other
  void subscribe(const ros::NodeHandle& handle);

  void receive(const geometry_msgs::Pose& pose, const movement::Order& order);

 private:
  void requireStanding() const;
  std::vector<double> speedsTo(const std::vector<std::string>& joints, const std::vector<double>& positions) const;

  const movement::JointTable& table_;
  const movement::MeasuredJoints& measured_;
  movement::Mover& mover_;
  text::ThrottledWarnings warnings_{[](const std::string& text) { ROS_WARN_STREAM_NAMED("joints", text); }};
  ros::Subscriber subscriber_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_WALK_BODY_POSE_COMMANDER_H
