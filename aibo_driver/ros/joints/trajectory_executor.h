/// @file trajectory_executor.h
#ifndef AIBO_DRIVER_ROS_JOINTS_TRAJECTORY_EXECUTOR_H
#define AIBO_DRIVER_ROS_JOINTS_TRAJECTORY_EXECUTOR_H

#include <ros/console.h>
#include <ros/node_handle.h>
#include <ros/steady_timer.h>
#include <ros/time.h>
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
#include "ros/throttled_warnings.h"

namespace aibo_driver::node {

/// How long to wait before a trajectory begins. From any thread.
/// @param stamp header.stamp of the message, whatever it contains; 0 means at once
/// @param now by the same clock
/// @return 0 to an hour; 0 also for a stamp of up to 1 s ago
/// @throw InvalidArgumentException the stamp is more than 1 s ago, or more than an hour ahead
std::chrono::nanoseconds waitBeforeStart(const ros::Time& stamp, const ros::Time& now);

/// Carries out the trajectories of the topic joint_trajectory. See Trajectory for what is accepted, and how it is
/// interpolated.
///
/// Every kPeriod it tells the robot where the joints should be kLookahead later, to arrive by then. So the robot always
/// knows what comes next, and a message that is late by less than that does not make it falter. The robot counts the
/// time from the arrival of each message, so its clock and ours need not agree. If the driver is held up for longer,
/// the trajectory resumes where it was. If the connection is lost, the trajectory is over, and the joints stop where
/// they were last sent, which is at most kLookahead away.
///
/// A new trajectory replaces the one before, beginning where that one is now. A trajectory without points stops the
/// joints that move.
///
/// From one thread at a time.
class TrajectoryExecutor {
 public:
  static constexpr std::chrono::milliseconds kPeriod{32};
  static constexpr std::chrono::milliseconds kLookahead{96};

  /// @param table, measured, link must outlive the executor
  /// @param slow_down as for Trajectory
  TrajectoryExecutor(const joints::JointTable& table, const joints::MeasuredJoints& measured, joints::JointLink& link,
                     bool slow_down);

  /// @param handle whose callback queue one thread serves
  void subscribe(const ros::NodeHandle& handle);

  /// Begins a trajectory. A refusal is logged.
  void receive(const trajectory_msgs::JointTrajectory& message);

  /// Ends the trajectory if it moves one of these joints, which are about to be commanded otherwise.
  void yieldTo(const joints::JointOrders& orders);

  /// Ends the trajectory, if there is one.
  /// @param reason for the log: completes "The trajectory ends early: "
  void end(const std::string& reason);

 private:
  using SteadyTime = std::chrono::steady_clock::time_point;

  struct Running {
    joints::Trajectory trajectory;
    joints::TrajectoryClock clock;
    std::uint64_t connection = 0;
    bool end_sent = false;
  };

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
