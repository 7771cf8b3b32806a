/// @file goal_walks.h
#ifndef AIBO_DRIVER_NODE_WALK_GOAL_WALKS_H
#define AIBO_DRIVER_NODE_WALK_GOAL_WALKS_H

#include <geometry_msgs/PoseStamped.h>

#include <chrono>
#include <functional>
#include <optional>

#include "aibo_client/rcserver_client.h"
#include "movement/mover.h"
#include "node/driver_parameters.h"
#include "walk/goal_controller.h"

namespace aibo_driver::node {

/// Walks to goals, by odometry. Everything else that happens to the robot ends a walk, and nothing resumes it.
///
/// Only one thread at a time may use an object of this class.
class GoalWalks {
 public:
  /// The time between two calls of Walk::advance().
  static constexpr std::chrono::milliseconds kPeriod{100};

  /// The farthest goal that is not refused. On a longer way, odometry would lose its way.
  static constexpr double kFarthest = 20;  ///< m

  /// How long a walk may come no closer to its goal before it is stopped.
  static constexpr std::chrono::seconds kPatience{20};

  /// Returns where the robot is in the frame odom. The result is empty if the robot has not said so for a while.
  using Odometer = std::function<std::optional<walk::PlanePose>()>;

  /// All arguments must outlive the object and its walks.
  GoalWalks(const DriverParameters& parameters, const aibo_client::RcServerClient& client, movement::Mover& mover,
            Odometer odometer, movement::Mover::Clock clock = std::chrono::steady_clock::now);

  class Walk {
   public:
    /// Steers the robot. Call this every kPeriod.
    /// @return how the walk has ended; null if it goes on
    const movement::EndedMovement* advance();

    /// Ends the walk in an orderly way.
    void stop(const std::string& reason) { walks_->mover_.cancel(begun_.id, reason); }

    const movement::Mover::Answer& begun() const { return begun_; }

    /// How much of the way was left at the last call of advance().
    double distanceLeft() const { return distance_left_; }  ///< m
    double turnLeft() const { return turn_left_; }          ///< rad

   private:
    friend class GoalWalks;

    Walk(GoalWalks& walks, movement::Mover::Answer begun, const walk::PlanePose& goal)
        : walks_(&walks), begun_(std::move(begun)), controller_(goal) {}

    bool comesNoCloser();

    GoalWalks* walks_;
    movement::Mover::Answer begun_;
    walk::GoalController controller_;
    bool is_stopping_ = false;
    double distance_left_ = 0;
    double turn_left_ = 0;
    double least_left_ = 0;
    std::optional<movement::SteadyTime> closer_at_;
  };

  /// Begins to walk to a goal, and ends other walks. If the goal cannot be walked to, the walk has ended as refused.
  Walk begin(const geometry_msgs::PoseStamped& goal, const movement::Order& order);

 private:
  walk::PlanePose goalIn(const geometry_msgs::PoseStamped& goal) const;

  const DriverParameters& parameters_;
  const aibo_client::RcServerClient& client_;
  movement::Mover& mover_;
  const Odometer odometer_;
  const movement::Mover::Clock clock_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_WALK_GOAL_WALKS_H
