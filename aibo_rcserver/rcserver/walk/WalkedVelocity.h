/// @file WalkedVelocity.h
/// How fast the robot walks, by what its feet do.
#ifndef AIBO_RCSERVER_RCSERVER_WALK_WALKED_VELOCITY_H
#define AIBO_RCSERVER_RCSERVER_WALK_WALKED_VELOCITY_H

#include "rcserver/walk/Gait.h"
#include "robot_model/legs.h"

/// Finds out how the feet on the floor move the body, frame by frame, on average between two reports.
///
/// The feet are where the planner has them, after all limits. They are taken to stand still on the floor.
class WalkedVelocity {
 public:
  /// @param gait must outlive this
  explicit WalkedVelocity(const Gait& gait);

  /// The robot begins to move its legs, from here, at phase 0 of the step.
  /// @param legs the angles of the four legs, in the order of robot_model::Leg
  void Begin(const robot_model::LegAngles* legs);

  /// A frame has passed in which it did not walk.
  void HaveMoved(const robot_model::LegAngles* legs);

  /// A frame has passed in which it walked.
  /// @param phase of the step at its end, 0..1
  void HaveWalked(const robot_model::LegAngles* legs, double phase);

  /// The average since the last call; the last value if no frame has passed since. The sum over all calls is the way,
  /// if no foot has slipped.
  /// @param walks the robot walks now
  protocol::version2::Velocity Take(bool walks);

 private:
  protocol::version2::Velocity VelocityTo(const robot_model::LegAngles* legs, double phase) const;

  const Gait& gait_;
  robot_model::LegAngles legs_[robot_model::NUMBER_OF_LEGS];
  double phase_;
  protocol::version2::Velocity sum_;  ///< over frames
  int frames_;
  protocol::version2::Velocity last_;
};

#endif  // AIBO_RCSERVER_RCSERVER_WALK_WALKED_VELOCITY_H
