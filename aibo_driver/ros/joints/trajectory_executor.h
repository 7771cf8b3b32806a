/// @file trajectory_executor.h
#ifndef AIBO_DRIVER_ROS_JOINTS_TRAJECTORY_EXECUTOR_H
#define AIBO_DRIVER_ROS_JOINTS_TRAJECTORY_EXECUTOR_H

#include <ros/console.h>
#include <ros/node_handle.h>
#include <ros/steady_timer.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "joints/joint_link.h"
#include "joints/joint_table.h"
#include "joints/measured_joints.h"
#include "joints/trajectory.h"
#include "joints/trajectory_clock.h"
#include "ros/throttled_warnings.h"

namespace aibo_driver::node {

/// Carries out joint_trajectory. Trajectory tells what is accepted and how it is interpolated.
///
/// Every kPeriod the robot is told where the joints are to be kLookahead later, to arrive by then. So it always knows
/// what comes next, a message that is late by less does not make it falter, and as it counts each time anew from the
/// arrival of the message, its clock and ours need not agree. Held up for longer, the trajectory goes on where it was.
/// If the connection is lost, the joints stop where they were last sent, which is at most kLookahead away, and the
/// trajectory is over.
///
/// A new trajectory replaces the one before, going on from where that one is. One without points stops the joints that
/// move. Everything runs on the callback queue of the handle, which must be served by one thread.
class TrajectoryExecutor {
 public:
  static constexpr std::chrono::milliseconds kPeriod{32};
  static constexpr std::chrono::milliseconds kLookahead{96};

  /// @param table, measured, link must outlive the executor
  /// @param slow_down as for Trajectory
  TrajectoryExecutor(const ros::NodeHandle& handle, const joints::JointTable& table,
                     const joints::MeasuredJoints& measured, joints::JointLink& link, bool slow_down);

  /// Ends the trajectory if it moves one of these joints, which are told something else now. From the thread of the
  /// callback queue.
  void yieldTo(const std::vector<joints::JointOrder>& orders);

  /// Ends the trajectory, if there is one. From the thread of the callback queue.
  void end(const std::string& reason);

 private:
  using SteadyTime = std::chrono::steady_clock::time_point;

  struct Running {
    joints::Trajectory trajectory;
    joints::TrajectoryClock clock;
    std::uint64_t connection = 0;
    bool end_sent = false;
  };

  void receive(const trajectory_msgs::JointTrajectory& message);
  void start(const trajectory_msgs::JointTrajectory& message);
  void hold();
  void goOn();
  std::vector<joints::Trajectory::Start> present(SteadyTime now) const;
  void send(const std::vector<std::size_t>& joints, const std::vector<double>& positions,
            std::chrono::milliseconds duration);

  const joints::JointTable& table_;
  const joints::MeasuredJoints& measured_;
  joints::JointLink& link_;
  const bool slow_down_;
  ThrottledWarnings warnings_{[](const std::string& text) { ROS_WARN_STREAM_NAMED("joints", text); }};
  std::optional<Running> running_;
  ros::SteadyTimer timer_;
  ros::Subscriber subscriber_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_JOINTS_TRAJECTORY_EXECUTOR_H
