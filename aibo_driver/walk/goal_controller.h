/// @file goal_controller.h
#ifndef AIBO_DRIVER_WALK_GOAL_CONTROLLER_H
#define AIBO_DRIVER_WALK_GOAL_CONTROLLER_H

#include "aibo_client/walk.h"

namespace aibo_driver::walk {

/// A place on the floor and a direction, in the frame odom or relative to another pose.
struct PlanePose {
  double x = 0;    ///< m
  double y = 0;    ///< m
  double yaw = 0;  ///< rad, -pi..pi, counterclockwise
};

/// @param pose relative to `origin`
/// @return the same pose in the frame in which `origin` is given
PlanePose inFrameOf(const PlanePose& origin, const PlanePose& pose);

/// Steers a robot to a pose: it turns towards the place, walks there, and turns. It walks the last centimetres in any
/// direction, and stops within 5 cm and 0.1 rad of its goal. All numbers are our choice.
///
/// Only one thread at a time may use an object of this class.
class GoalController {
 public:
  /// @param goal in the frame odom
  explicit GoalController(const PlanePose& goal) : goal_(goal) {}

  /// The velocity with which the robot should walk on.
  /// @param here the robot's pose in the frame odom
  /// @return 0 if the robot should stop, because it is as close to the goal as it gets
  aibo_client::WalkVelocity velocityAt(const PlanePose& here);

  /// The distance from the goal's place, in m.
  double distanceFrom(const PlanePose& here) const;

  /// The angle by which the robot still has to turn to the goal's direction, in rad, -pi..pi.
  double turnFrom(const PlanePose& here) const;

 private:
  PlanePose goal_;
  bool is_there_ = false;  ///< true: the place is reached, and only the turn is left
};

}  // namespace aibo_driver::walk

#endif  // AIBO_DRIVER_WALK_GOAL_CONTROLLER_H
