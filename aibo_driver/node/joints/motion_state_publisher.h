/// @file motion_state_publisher.h
#ifndef AIBO_DRIVER_NODE_JOINTS_MOTION_STATE_PUBLISHER_H
#define AIBO_DRIVER_NODE_JOINTS_MOTION_STATE_PUBLISHER_H

#include <aibo_driver/MotionState.h>
#include <aibo_driver/RobotState.h>
#include <ros/node_handle.h>

#include <cstddef>
#include <cstdint>
#include <mutex>
#include <vector>

#include "movement/mover.h"
#include "node/state_publisher.h"
#include "node/stop_memory.h"

namespace aibo_driver::node {

/// The largest number of ends in a MotionState.
constexpr std::size_t kEndsInMessage = 8;

/// The constant of EndedMovement for this end.
std::uint8_t endConstant(aibo_client::EndedHow how);

/// Makes a message with at most kEndsInMessage ends.
/// @param steady_now, now the same time on two clocks; the stamps are times of the second clock
MotionState toMessage(const movement::Mover::State& state, movement::SteadyTime steady_now, const ros::Time& now);

/// Makes the messages with the newest ends, at most kEndsInMessage in each. The last one is the present state.
/// @param fresh how many of the ends are new; at most those in the state
std::vector<MotionState> toMessages(const movement::Mover::State& state, std::size_t fresh,
                                    movement::SteadyTime steady_now, const ros::Time& now);

/// Makes a message, without a stamp, of what the robot can do now.
RobotState toMessage(const movement::Mover::State& state);

/// Publishes the topics motion_state and robot_state, and remembers who has stopped the robot.
class MotionStatePublisher {
 public:
  /// @param mover, stop_memory must outlive the publisher
  MotionStatePublisher(const ros::NodeHandle& handle, const movement::Mover& mover, StopMemory& stop_memory);

  /// Publishes what moves the robot and what the robot can do, if either has changed. If more movements have ended
  /// since the last call than fit into one message, several are published. Any thread may call this.
  void publish();

 private:
  const movement::Mover& mover_;
  StopMemory& stop_memory_;
  std::mutex mutex_;
  std::vector<movement::Movement> movements_;  ///< as last published
  std::size_t ends_ = 0;                       ///< how many movements had ended at the last publication
  ros::Publisher publisher_;
  StatePublisher<RobotState> robot_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_JOINTS_MOTION_STATE_PUBLISHER_H
