/// @file Gait.h
/// How the legs move when the robot walks.
#ifndef AIBO_RCSERVER_RCSERVER_WALK_GAIT_H
#define AIBO_RCSERVER_RCSERVER_WALK_GAIT_H

#include "robot_model/legs.h"

/// How the body moves over the floor.
struct WalkVelocity {
  double forward;  ///< m/s
  double left;     ///< m/s
  double turn;     ///< rad/s, to the left
};

inline bool IsZero(const WalkVelocity& velocity) {
  return velocity.forward == 0 && velocity.left == 0 && velocity.turn == 0;
}

/// The numbers of the gait. The defaults were found with the bench in test/physics, which counts falls, ways and the
/// loads of the motors; none has been tried on a robot yet.
struct GaitParameters {
  GaitParameters();

  double period;  ///< s; in this time, each foot makes one step

  /// Share of the period in which a foot is on the floor. Two feet always are, from 0.5 on.
  double duty;

  double height;       ///< m; of the shoulders over the floor
  double lift;         ///< m; how high a foot is lifted in the middle of its way through the air
  double front_ahead;  ///< m; where a front foot stands, ahead of its shoulder
  double hind_ahead;   ///< m; the same for a hind foot
  double outward;      ///< m; where a foot stands, farther from the middle of the body than its shoulder
  double nose_down;    ///< rad; how far the body leans forward

  /// Share of its way through the air in which a foot turns from the floor's speed to its own; the same before it comes
  /// down. 0..0.5; the smaller, the lower its highest speed and the higher its acceleration.
  double easing;

  /// Share of its way through the air in which a foot begins to rise; the same for the end of its rise, the beginning
  /// of its fall and the end of its fall. 0..0.25; effects as of `easing`.
  double lift_easing;

  /// Highest velocities, each without the others. Less than that is left if several come together.
  double highest_forward;  ///< m/s
  double highest_back;     ///< m/s
  double highest_left;     ///< m/s, to either side
  double highest_turn;     ///< rad/s, in either direction
};

/// A trot: diagonal legs move together, half a period after the two others. A foot on the floor moves with the floor,
/// on a straight line around its middle; in the air, it goes back to the other end of that line, and touches down with
/// the speed of the floor.
///
/// A pure function: it has no state, and the same arguments give the same angles. A robot that stands still is a robot
/// that walks with velocity 0 and effort 0, whatever the phase is.
///
/// The angles are not limited. With a velocity that Limited() returns, they are within the limits and couplings of the
/// joints, and so are their speeds: a test sweeps them.
class Gait {
 public:
  explicit Gait(const GaitParameters& parameters = GaitParameters()) : parameters_(parameters) {}

  const GaitParameters& Parameters() const { return parameters_; }

  /// The velocity of the same direction that the legs can walk. Forward, sideways and turning share their speed: the
  /// parts of the highest velocities that they take add up to 1 at most.
  WalkVelocity Limited(const WalkVelocity& wanted) const;

  /// True while a leg's foot is on the floor.
  /// @param phase of the step, 0..1
  bool IsOnFloor(robot_model::Leg leg, double phase) const { return LegPhase(leg, phase) < parameters_.duty; }

  /// Where the legs are.
  /// @param phase of the step, 0..1
  /// @param velocity that Limited() has returned
  /// @param effort 0..1: how much of the lift is made; less than 1 to begin and to end a walk
  /// @param[out] angles of the four legs, in radian, in the order of robot_model::Leg
  void FindPosture(double phase, const WalkVelocity& velocity, double effort, robot_model::LegAngles* angles) const;

 private:
  static double LegPhase(robot_model::Leg leg, double phase);
  double WayThroughAir(double part) const;
  double Lift(double part) const;
  robot_model::Point FootMiddle(robot_model::Leg leg) const;

  GaitParameters parameters_;
};

#endif  // AIBO_RCSERVER_RCSERVER_WALK_GAIT_H
