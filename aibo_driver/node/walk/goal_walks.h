/// @file goal_walks.h
#ifndef AIBO_DRIVER_NODE_WALK_GOAL_WALKS_H
#define AIBO_DRIVER_NODE_WALK_GOAL_WALKS_H

#include <geometry_msgs/PoseStamped.h>
#include <ros/node_handle.h>
#include <ros/steady_timer.h>

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "aibo_client/rcserver_client.h"
#include "movement/mover.h"
#include "node/driver_parameters.h"
#include "walk/goal_controller.h"

namespace aibo_driver::node {

/// Walks to goals, by odometry: those of the topic goal and of the action go_to. A newer goal ends the walk to an older
/// one. Everything else that happens to the robot ends a walk, too, and nothing resumes it.
///
/// Only one thread at a time may use an object of this class.
class GoalWalks {
 public:
  /// The time between two calls of advance().
  static constexpr std::chrono::milliseconds kPeriod{100};

  /// The farthest goal that is not refused. Over a longer way, the errors of the odometry would be too large.
  static constexpr double kFarthest = 20;  ///< m

  /// How long a walk may come no closer to its goal before it is stopped.
  static constexpr std::chrono::seconds kPatience{20};

  /// Returns where the robot is in the frame odom. The result is empty if the robot has not said so for a while.
  using Odometer = std::function<std::optional<walk::PlanePose>()>;

  /// All arguments must outlive the object.
  GoalWalks(const DriverParameters& parameters, const aibo_client::RcServerClient& client, movement::Mover& mover,
            Odometer odometer, movement::Mover::Clock clock = std::chrono::steady_clock::now);

  /// Subscribes to the topic goal, and steers walks from now on.
  /// @param handle the handle of the walk commander, whose thread steers all walks
  void subscribe(const ros::NodeHandle& handle);

  /// How much of a walk was left when it was steered last.
  struct Left {
    double distance = 0;  ///< m
    double turn = 0;      ///< rad
  };

  /// A walk to a goal that was begun, or refused.
  struct Begun {
    movement::Mover::Answer answer;
    std::shared_ptr<const Left> left;  ///< null if the goal is refused. Read it on the thread that steers
  };

  /// Begins to walk to a goal. If it is refused, an earlier walk goes on.
  Begun begin(const geometry_msgs::PoseStamped& goal, const movement::Order& order);

  /// Steers the robot.
  void advance();

 private:
  /// A walk that has to be steered.
  struct Walk {
    movement::Mover::Answer begun;
    walk::GoalController controller;
    double least_left;
    movement::SteadyTime closer_at;
    std::shared_ptr<Left> left;
  };

  walk::PlanePose goalIn(const geometry_msgs::PoseStamped& goal) const;
  std::string steer();

  const DriverParameters& parameters_;
  const aibo_client::RcServerClient& client_;
  movement::Mover& mover_;
  const Odometer odometer_;
  const movement::Mover::Clock clock_;
  std::optional<Walk> walk_;
  ros::SteadyTimer timer_;
  ros::Subscriber subscriber_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_WALK_GOAL_WALKS_H
