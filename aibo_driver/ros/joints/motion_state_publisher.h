/// @file motion_state_publisher.h
#ifndef AIBO_DRIVER_ROS_JOINTS_MOTION_STATE_PUBLISHER_H
#define AIBO_DRIVER_ROS_JOINTS_MOTION_STATE_PUBLISHER_H

#include <aibo_driver/MotionState.h>
#include <aibo_driver/RobotState.h>
#include <ros/node_handle.h>

#include <cstddef>
#include <cstdint>
#include <mutex>

#include "movement/mover.h"

namespace aibo_driver::node {

/// MotionState has so many ends at most.
constexpr std::size_t kEndsInMessage = 8;

/// The constant of EndedMovement.
std::uint8_t endConstant(movement::MovementEnd how);

/// As a message, with at most kEndsInMessage ends.
/// @param steady_now, now the same time by two clocks; the second one is that of the stamps
MotionState toMessage(const movement::Mover::State& state, movement::SteadyTime steady_now, const ros::Time& now);

/// What the robot can do now, as a message without a stamp.
RobotState toMessage(const movement::Mover::State& state);

/// Publishes the topics motion_state and robot_state.
class MotionStatePublisher {
 public:
  /// @param mover must outlive the publisher
  MotionStatePublisher(const ros::NodeHandle& handle, const movement::Mover& mover);

  /// Publishes what moves the robot and what it can do, if that has changed. If more has ended since the last call than
  /// fits into a message, there are several. From any thread.
  void publish();

 private:
  const movement::Mover& mover_;
  std::mutex mutex_;
  MotionState last_;
  std::size_t ends_ = 0;  ///< that were published
  RobotState last_robot_;
  ros::Publisher publisher_;
  ros::Publisher robot_publisher_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_JOINTS_MOTION_STATE_PUBLISHER_H
