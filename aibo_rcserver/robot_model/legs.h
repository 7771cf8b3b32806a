/// @file legs.h
/// Where an ERS-7's feet are, and how its legs bend to put them there. Only this file and urdf/ers7.urdf have the
/// lengths of the legs; a test compares them. C++98, no I/O.
///
/// Lengths are in metres, angles in radians. Positions are relative to the middle of the four shoulders: x forward, y
/// to the left, z up.
#ifndef AIBO_RCSERVER_ROBOT_MODEL_LEGS_H
#define AIBO_RCSERVER_ROBOT_MODEL_LEGS_H

namespace robot_model {

/// The legs, in the order of the robot's table of joints.
enum Leg { LEFT_FRONT_LEG, LEFT_HIND_LEG, RIGHT_FRONT_LEG, RIGHT_HIND_LEG };

const int NUMBER_OF_LEGS = 4;
const int JOINTS_OF_A_LEG = 3;

inline bool isFront(Leg leg) {
  return leg == LEFT_FRONT_LEG || leg == RIGHT_FRONT_LEG;
}

inline bool isLeft(Leg leg) {
  return leg == LEFT_FRONT_LEG || leg == LEFT_HIND_LEG;
}

/// The joints of one leg. At zero, the leg points straight down. The signs are Sony's (robot_model.h).
struct LegAngles {
  double rotator;   ///< positive swings the leg forward
  double elevator;  ///< positive lifts the leg away from the body
  double knee;      ///< positive bends front legs forward, hind legs backward
};

struct Point {
  double x;
  double y;
  double z;
};

/// The radius of a foot, which is a ball.
const double FOOT_RADIUS = 0.013;

/// The identifier (robot_model.h) of a leg's joint.
/// @param number 0 rotator, 1 elevator, 2 knee
int legJointIdentifier(Leg leg, int number);

/// The intersection of the rotator's and elevator's axes.
Point findShoulder(Leg leg);

/// The axis of the knee.
Point findKnee(Leg leg, const LegAngles& angles);

/// The centre of the ball that is the foot.
Point findFoot(Leg leg, const LegAngles& angles);

/// How far the ball of a foot has rolled, forward and to the left, since all angles of its leg were 0. Seen from the
/// body, the point where a foot touches level ground moves like the sum of this way and findFoot().
Point findRolledWay(Leg leg, const LegAngles& angles);

/// How the leg bends to put its foot at a place, ignoring joint limits. Of several solutions, one with the foot below
/// the shoulder is preferred to one with the leg lifted over it, and of those, a bent knee to an overstretched one. (A
/// front leg is longest with the knee at 11.8 degrees, a hind leg at 18.9.)
/// @param foot the centre of the foot
/// @return the angles; if the place is too near or too far, those that come close
LegAngles findLegAngles(Leg leg, const Point& foot);

/// The corner of the belly beside this leg, raised by FOOT_RADIUS, so that the robot rests only on balls of one size.
/// The place is our estimate.
Point findBellyCorner(Leg leg);

}  // namespace robot_model

#endif  // AIBO_RCSERVER_ROBOT_MODEL_LEGS_H
