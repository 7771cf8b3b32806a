/// @file joint_commander.h
#ifndef AIBO_DRIVER_NODE_JOINTS_JOINT_COMMANDER_H
#define AIBO_DRIVER_NODE_JOINTS_JOINT_COMMANDER_H

#include <ros/console.h>
#include <ros/node_handle.h>
#include <ros/steady_timer.h>
#include <ros/time.h>
#include <sensor_msgs/JointState.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <chrono>
#include <string>
#include <vector>

#include "movement/joint_table.h"
#include "movement/mover.h"
#include "movement/trajectory.h"
#include "text/throttled_warnings.h"

namespace aibo_driver::node {

/// How long to wait before a trajectory begins. Any thread may call this function.
/// @param stamp header.stamp of the message, with any value; 0 means at once
/// @param now the time of the same clock
/// @return -1 s to one hour; it is below 0 if the trajectory should have begun already
/// @throw InvalidArgumentException the stamp is more than 1 s in the past, or more than an hour in the future
std::chrono::nanoseconds waitBeforeStart(const ros::Time& stamp, const ros::Time& now);

/// Makes a request of the message, without its stamp and without a check. Any thread may call this function.
movement::TrajectoryRequest toRequest(const trajectory_msgs::JointTrajectory& message);

/// The topics that command joints: joint_command, JOINT_position_controller/command and joint_trajectory.
///
/// A message of joint_command goes to the robot at once and as a whole. Each position_controller topic belongs to one
/// joint. Messages that a node sends to several of these topics within kCollectingTime go to the robot together. A
/// trajectory without points stops all joints where they are.
///
/// Only one thread at a time may use an object of this class.
class JointCommander {
 public:
  /// How long commands to single joints are collected. It is half of the 8 ms after which the robot takes new
  /// positions.
  static constexpr std::chrono::milliseconds kCollectingTime{4};

  /// The header.frame_id of the messages of joint_command that the node look_at sends. Other frame_ids have no meaning.
  static constexpr const char* kLookAt = "look_at";

  /// @param table, mover must outlive the commander
  JointCommander(const movement::JointTable& table, movement::Mover& mover) : table_(table), mover_(mover) {}

  JointCommander(const JointCommander&) = delete;
  JointCommander& operator=(const JointCommander&) = delete;

  /// @param handle a handle whose callback queue is served by one thread
  void subscribe(const ros::NodeHandle& handle);

  /// Call this on the thread of the callback queue when a movement begins. From then on, the commander calls
  /// Mover::advance().
  void moveOn() { timer_.start(); }

  void receive(const sensor_msgs::JointState& message, const movement::Order& order);
  void receive(const trajectory_msgs::JointTrajectory& message, const movement::Order& order);
  void receivePosition(const std::string& joint, double position, const movement::Order& order);

 private:
  void command(const sensor_msgs::JointState& message, const movement::Order& order);
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

#endif  // AIBO_DRIVER_NODE_JOINTS_JOINT_COMMANDER_H
