/// @file Gait.h
/// The motion of the legs when the robot walks.
#ifndef AIBO_RCSERVER_RCSERVER_WALK_GAIT_H
#define AIBO_RCSERVER_RCSERVER_WALK_GAIT_H

#include "protocol/walk_requests.h"
#include "robot_model/legs.h"

/// The numbers of the gait. The defaults were found with the bench in test/physics, which measures falls, distances and
/// motor loads. None has been tried on a robot yet.
struct GaitParameters {
  GaitParameters();

  double period;  ///< s; in this time, each foot makes one step

  /// Share of the period in which a foot is on the floor. From 0.5 on, two feet always are.
  double duty;

  /// Share of the period for which a foot moves with the floor before it touches down and after it has lifted off.
  /// Motors lag, and a foot that still moves forward when it touches the floor drags the robot.
  double margin;

  /// s; feet are placed where they would be this much later. Motors lag, so feet on the floor are ahead of their
  /// planned places, and the robot would lean back.
  double lag;

  double height;       ///< m; of the shoulders over the floor
  double lift;         ///< m; how high a foot is lifted in the middle of its way through the air
  double front_ahead;  ///< m; where a front foot stands, ahead of its shoulder
  double hind_ahead;   ///< m; the same for a hind foot
  double outward;      ///< m; where a foot stands, farther from the middle of the body than its shoulder
  double nose_down;    ///< rad; how far the body leans forward

  /// Share of its way to the front in which a foot changes from the floor's speed to its own. The change back takes the
  /// same share. 0..0.5; the smaller, the lower its highest speed and the higher its acceleration.
  double easing;

  /// Share of its way through the air in which a foot begins to rise. The end of the rise and both ends of the fall
  /// take the same share. 0..0.25; it acts like `easing`.
  double lift_easing;

  /// Highest velocities, each without the others. Combined velocities are limited further.
  protocol::version2::WalkLimits highest;
};

/// A trot: diagonal legs move together, half a period after the two others. A foot on the floor moves with the floor,
/// on a straight line around its middle; in the air, it goes back to the other end of that line, and touches down with
/// the speed of the floor.
///
/// A pure function: it has no state, and the same arguments give the same angles. A robot that stands still is a robot
/// that walks with velocity 0 and effort 0, whatever the phase is.
///
/// The angles are not limited. With a velocity from Limited(), the angles and their speeds are within the limits and
/// couplings of the joints. A test checks all velocities.
class Gait {
 public:
  explicit Gait(const GaitParameters& parameters = GaitParameters()) : parameters_(parameters) {}

  const GaitParameters& Parameters() const { return parameters_; }

  /// The highest velocity in this direction that the legs can walk. Forward, sideways and turning velocities, each
  /// divided by its highest value, add up to 1 at most.
  protocol::version2::Velocity Limited(const protocol::version2::Velocity& wanted) const;

  /// True while a leg's foot is on the floor.
  /// @param phase of the step, 0..1
  bool IsOnFloor(robot_model::Leg leg, double phase) const { return LegPhase(leg, phase) < parameters_.duty; }

  /// True while a leg's foot moves with the floor: while it is on the floor, and for the margin before and after. With
  /// a margin of a frame or more, a pair of legs always does so from one frame to the next.
  bool MovesWithFloor(robot_model::Leg leg, double phase) const;

  /// Computes the angles of the legs.
  /// @param phase of the step, 0..1
  /// @param velocity that Limited() has returned
  /// @param effort 0..1: share of the lift; less than 1 at the beginning and the end of a walk
  /// @param[out] angles of the four legs, in radian, in the order of robot_model::Leg
  void FindPosture(double phase, const protocol::version2::Velocity& velocity, double effort,
                   robot_model::LegAngles* angles) const;

 private:
  static double LegPhase(robot_model::Leg leg, double phase);
  double PlaceAt(double time) const;
  double Lift(double part) const;
  robot_model::Point FootMiddle(robot_model::Leg leg) const;

  GaitParameters parameters_;
};

#endif  // AIBO_RCSERVER_RCSERVER_WALK_GAIT_H
