/// @file motion_state_publisher.h
#ifndef AIBO_DRIVER_ROS_JOINTS_MOTION_STATE_PUBLISHER_H
#define AIBO_DRIVER_ROS_JOINTS_MOTION_STATE_PUBLISHER_H

#include <aibo_driver/MotionState.h>
#include <ros/node_handle.h>

#include <cstdint>
#include <mutex>

#include "ros/joints/joint_mover.h"

namespace aibo_driver::node {

/// The constant of MotionState.
std::uint8_t endConstant(movement::MovementEnd how);

/// As a message.
/// @param steady_now, now the same time by two clocks; the second one is that of the stamps
MotionState toMessage(const JointMover::State& state, JointMover::SteadyTime steady_now, const ros::Time& now);

/// Publishes the topic motion_state.
class MotionStatePublisher {
 public:
  /// @param mover must outlive the publisher
  MotionStatePublisher(const ros::NodeHandle& handle, const JointMover& mover);

  /// Publishes what moves the robot, if that has changed. From any thread.
  void publish();

 private:
  const JointMover& mover_;
  std::mutex mutex_;
  MotionState last_;
  ros::Publisher publisher_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_JOINTS_MOTION_STATE_PUBLISHER_H
