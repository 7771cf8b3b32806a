#ifndef AIBO_RCSERVER_RCSERVER_WALK_GAIT_H
#define AIBO_RCSERVER_RCSERVER_WALK_GAIT_H

#include "protocol/walk_requests.h"
#include "robot_model/legs.h"

/// Change of a walk's velocity in a second, relative to the highest velocity. Our choice, which all joints can follow.
const double SPEED_CHANGE = 1;

struct StepParameters {
  double period;  ///< s; in this time, each foot makes one step

  /// The share of the period in which a foot is on the floor. From 0.5 on, two feet always are on the floor.
  double duty;

  /// Share of the period for which a foot moves with the floor before it touches down and after it has lifted off. This
  /// is needed because motors lag, and a foot that still moves forward when it touches the floor drags the robot.
  double margin;

  /// In s; feet are placed where they would be this much later. Motors lag, so without this, feet on the floor would be
  /// too far ahead, and the robot would lean back.
  double lag;

  double height;         ///< m; how high the shoulders are above the floor
  double front_lift;     ///< m; how high a front foot is lifted in the middle of its way through the air
  double hind_lift;      ///< m; the same for a hind foot
  double front_ahead;    ///< m; where a front foot stands, ahead of its shoulder
  double hind_ahead;     ///< m; the same for a hind foot
  double front_outward;  ///< m; where a front foot stands, farther from the middle of the body than its shoulder
  double hind_outward;   ///< m; the same for a hind foot
  double nose_down;      ///< rad; how far the body leans forward

  /// The share, 0..0.5, of a foot's way to the front in which it changes from the floor's speed to its own. The change
  /// back takes the same share. The smaller it is, the lower the highest speed and the higher the acceleration.
  double easing;

  /// The share, 0..0.25, of a foot's way through the air in which it begins to rise. The end of the rise and both ends
  /// of the fall take the same share. It acts like `easing`.
  double lift_easing;
};

/// The angles of a leg that moves in waves, in radian, for each of its joints in the order of robot_model::LegAngles:
/// the mean, then the factors of the cosine and the sine of the phase, of twice the phase, and so on.
struct LegWaves {
  enum { HARMONICS = 4 };

  double angles[robot_model::JOINTS_OF_A_LEG][1 + 2 * HARMONICS];
};

struct WaveParameters {
  double period;      ///< s
  double hind_ahead;  ///< share of the period by which a hind leg is ahead of the front leg on its side
  double none;        ///< m/s; up to this speed, the robot trots
  double all;         ///< m/s; from this speed on, the legs move in waves alone
  double unseen;      ///< UnseenWay() if the legs move in waves alone
  double nose_up;     ///< radian; how far the body leans back if the legs move in waves alone
  LegWaves front;
  LegWaves hind;
};

/// The numbers of the gait. The defaults were found with the bench in test/physics, which measures falls, distances and
/// motor loads on many robots and floors. None of them has been tried on a real robot yet.
struct GaitParameters {
  GaitParameters();

  StepParameters in_place;  ///< the step without a forward velocity: standing, turning, walking sideways
  StepParameters forward;   ///< the step at highest.forward; lower velocities mix it with `in_place` (StepAt())
  StepParameters back;      ///< the step at highest.back, mixed in the same way
  WaveParameters waves;     ///< the gait above the speeds of the trot

  /// The highest velocities, each without the others. Combined velocities are limited further.
  protocol::version2::WalkLimits highest;
  double fastest;  ///< m/s; the highest velocity forward with little turning: see Gait::Limited()

  /// The same velocities for the legs. They may be higher, because the robot walks slower than its legs are commanded.
  protocol::version2::WalkLimits highest_of_legs;
  double fastest_of_legs;  ///< m/s; `fastest` for the legs
};

/// A trot: diagonal legs move together, half a period after the other two. A foot on the floor moves with the floor, on
/// a straight line around its middle; in the air, it goes back to the other end of that line, and touches down with the
/// speed of the floor. Knees are too slow for a trot at more than 200 mm/s. So above 160 mm/s, the angles of the joints
/// come nearer and nearer to waves that repeat in each step. The waves bend the hind knees and raise the nose.
///
/// A robot that leans more than it should tips over its diagonal pairs of feet: a swinging foot hits the floor early,
/// and the robot rocks. To prevent this, the feet can be placed nearer to the side to which the robot leans.
///
/// The gait has no state: the same arguments always give the same angles. A robot that stands still is a robot that
/// walks with velocity 0 and effort 0, whatever the phase is.
///
/// The angles are not limited. With a velocity from Limited() or LimitedForLegs(), the angles and their speeds are
/// within the limits and couplings of the joints. A test checks all velocities.
class Gait {
 public:
  explicit Gait(const GaitParameters& parameters = GaitParameters()) : parameters_(parameters) {}

  const GaitParameters& Parameters() const { return parameters_; }

  /// The highest velocity in this direction that the legs can walk. Forward, sideways and turning velocities, each
  /// divided by its highest value, add up to 1 at most; with the fastest value for forward, the others count twice.
  protocol::version2::Velocity Limited(const protocol::version2::Velocity& wanted) const {
    return Shortened(wanted, parameters_.highest, parameters_.fastest);
  }

  /// The same during a change of velocity: a robot that walks too fast to trot slows down before it turns.
  protocol::version2::Velocity LimitedInWalk(const protocol::version2::Velocity& wanted) const {
    return Narrowed(wanted, wanted.forward, parameters_.highest, parameters_.fastest);
  }

  /// The highest velocity for the legs. It may be higher than Limited(), because the robot walks slower than its legs
  /// are commanded.
  /// @param told the forward velocity that the robot was told
  protocol::version2::Velocity LimitedForLegs(const protocol::version2::Velocity& wanted, double told) const {
    return Narrowed(wanted, told, parameters_.highest_of_legs, parameters_.fastest_of_legs);
  }

  /// The numbers of a step with this velocity.
  StepParameters StepAt(const protocol::version2::Velocity& velocity) const;

  /// The way ahead that feet on the floor do not show, as a share of the way that they show. The values are the middle
  /// of many robots and floors on the bench.
  double UnseenWay(const protocol::version2::Velocity& velocity) const;

  /// How far the body leans forward on level ground, in radian.
  double NoseDown(const protocol::version2::Velocity& velocity) const;

  /// True while a leg's foot is on the floor.
  /// @param phase of the step, 0..1
  static bool IsOnFloor(const StepParameters& step, robot_model::Leg leg, double phase) {
    return LegPhase(leg, phase) < step.duty;
  }

  /// Computes the angles of the legs.
  /// @param phase of the step, 0..1
  /// @param velocity a velocity that Limited() or LimitedForLegs() has returned
  /// @param effort share of the lift, waves and shift, 0..1; less than 1 at the beginning and the end of a walk
  /// @param[out] angles the angles of the four legs, in radian, in the order of robot_model::Leg
  /// @param shift of all feet, in metres: x ahead, y to the left
  void FindPosture(double phase, const protocol::version2::Velocity& velocity, double effort,
                   robot_model::LegAngles* angles, const robot_model::Point& shift = robot_model::Point()) const;

 private:
  static double LegPhase(robot_model::Leg leg, double phase);
  static protocol::version2::Velocity Shortened(const protocol::version2::Velocity& wanted,
                                                const protocol::version2::WalkLimits& highest, double fastest);

  /// Keeps the forward velocity of a robot that walks too fast to trot, and shortens the other velocities.
  protocol::version2::Velocity Narrowed(const protocol::version2::Velocity& wanted, double told,
                                        const protocol::version2::WalkLimits& highest, double fastest) const;

  /// The share of the waves in the motion of the legs, 0..1.
  /// @param forward velocity in m/s
  double ShareOfWaves(double forward) const;

  /// Brings the angles nearer to the waves by a share of the difference.
  void AddWaves(robot_model::Leg leg, double phase, double share, robot_model::LegAngles* angles) const;

  GaitParameters parameters_;
};

#endif  // AIBO_RCSERVER_RCSERVER_WALK_GAIT_H
