/// @file joint_commander.h
#ifndef AIBO_DRIVER_ROS_JOINTS_JOINT_COMMANDER_H
#define AIBO_DRIVER_ROS_JOINTS_JOINT_COMMANDER_H

#include <ros/console.h>
#include <ros/node_handle.h>
#include <ros/steady_timer.h>
#include <sensor_msgs/JointState.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <chrono>
#include <string>
#include <vector>

#include "movement/joint_table.h"
#include "movement/mover.h"
#include "text/throttled_warnings.h"

namespace aibo_driver::node {

/// The topics that command joints: joint_command, JOINT_position_controller/command and joint_trajectory.
///
/// A message of joint_command goes to the robot at once and as a whole. A position_controller topic belongs to one
/// joint: what a node sends to these topics within kCollectingTime is sent together. A trajectory without points holds
/// everything.
///
/// From one thread at a time.
class JointCommander {
 public:
  /// How long commands to single joints are collected: half of the 8 ms in which the robot takes new positions.
  static constexpr std::chrono::milliseconds kCollectingTime{4};

  /// header.frame_id of a message of joint_command that the node look_at sends; that of others does not matter.
  static constexpr const char* kLookAt = "look_at";

  /// @param table, mover must outlive the commander
  JointCommander(const movement::JointTable& table, movement::Mover& mover) : table_(table), mover_(mover) {}

  JointCommander(const JointCommander&) = delete;
  JointCommander& operator=(const JointCommander&) = delete;

  /// @param handle whose callback queue one thread serves
  void subscribe(const ros::NodeHandle& handle);

  /// To be called when something begins to move, on the thread of the callback queue: moves it on from now on.
  void moveOn() { timer_.start(); }

  void receive(const sensor_msgs::JointState& message, const movement::Order& order);
  void receive(const trajectory_msgs::JointTrajectory& message, const movement::Order& order);

 private:
  void receivePosition(const std::string& joint, double position, const movement::Order& order);
  void sendCollected();

  const movement::JointTable& table_;
  movement::Mover& mover_;
  text::ThrottledWarnings warnings_{[](const std::string& text) { ROS_WARN_STREAM_NAMED("joints", text); }};
  sensor_msgs::JointState collected_;
  movement::Order collected_order_;
  ros::SteadyTimer collecting_;
  ros::SteadyTimer timer_;
  std::vector<ros::Subscriber> subscribers_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_JOINTS_JOINT_COMMANDER_H
