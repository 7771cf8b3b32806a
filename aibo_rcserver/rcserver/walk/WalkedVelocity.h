/// @file WalkedVelocity.h
/// The robot's walking velocity, computed from the motion of its feet.
#ifndef AIBO_RCSERVER_RCSERVER_WALK_WALKED_VELOCITY_H
#define AIBO_RCSERVER_RCSERVER_WALK_WALKED_VELOCITY_H

#include "rcserver/walk/Gait.h"
#include "robot_model/legs.h"

/// Computes how the feet on the floor move the body, frame by frame, averaged between two reports.
///
/// The feet are where the planner puts them, after all limits. They are assumed not to slip.
class WalkedVelocity {
 public:
  /// @param gait must outlive this
  explicit WalkedVelocity(const Gait& gait);

  /// Call when the robot begins to move its legs, from these angles, at phase 0 of the step.
  /// @param legs the angles of the four legs, in the order of robot_model::Leg
  void Begin(const robot_model::LegAngles* legs);

  /// Call after a frame in which the robot did not walk.
  void HaveMoved(const robot_model::LegAngles* legs);

  /// Call after a frame in which the robot walked.
  /// @param phase of the step at the frame's end, 0..1
  void HaveWalked(const robot_model::LegAngles* legs, double phase);

  /// The velocity in the last frame in which the robot walked.
  const protocol::version2::Velocity& InLastFrame() const { return in_last_frame_; }

  /// The average since the last call; the last value if no frame has passed since. If no foot slips, the sum over all
  /// frames is the distance walked.
  /// @param walks true if the robot walks now
  protocol::version2::Velocity Take(bool walks);

 private:
  protocol::version2::Velocity VelocityTo(const robot_model::LegAngles* legs, double phase) const;

  const Gait& gait_;
  robot_model::LegAngles legs_[robot_model::NUMBER_OF_LEGS];
  double phase_;
  protocol::version2::Velocity in_last_frame_;
  protocol::version2::Velocity sum_;  ///< over frames
  int frames_;
  protocol::version2::Velocity last_;
};

#endif  // AIBO_RCSERVER_RCSERVER_WALK_WALKED_VELOCITY_H
