/// @file legs.h
/// Where the feet of an ERS-7 are, and how its legs have to bend to put them there. The only place with the lengths of
/// its legs, beside urdf/ers7.urdf, which a test compares with it. Used by both sides; C++98, no I/O.
///
/// Metres and radian. Positions are in the body: x forward, y to the left, z up, with the origin in the middle of the
/// four shoulders.
#ifndef AIBO_RCSERVER_ROBOT_MODEL_LEGS_H
#define AIBO_RCSERVER_ROBOT_MODEL_LEGS_H

namespace robot_model {

/// In the order of the joints in the robot's table.
enum Leg { LEFT_FRONT_LEG, LEFT_HIND_LEG, RIGHT_FRONT_LEG, RIGHT_HIND_LEG };

const int NUMBER_OF_LEGS = 4;
const int JOINTS_OF_A_LEG = 3;

/// True for the two front legs.
inline bool isFront(Leg leg) {
  return leg == LEFT_FRONT_LEG || leg == RIGHT_FRONT_LEG;
}

/// True for the two left legs.
inline bool isLeft(Leg leg) {
  return leg == LEFT_FRONT_LEG || leg == LEFT_HIND_LEG;
}

/// Angles of the three joints of one leg; at zero it is straight down. Signs are Sony's (robot_model.h).
struct LegAngles {
  double rotator;   ///< positive swings the leg forward
  double elevator;  ///< positive lifts it away from the body
  double knee;      ///< positive bends front legs forward, hind legs backward
};

/// A place in the body.
struct Point {
  double x;
  double y;
  double z;
};

/// Radius of a foot, which is a ball.
const double FOOT_RADIUS = 0.013;

/// The joint of the leg that is `number` joints away from the body: 0 rotator, 1 elevator, 2 knee.
/// @return its identifier (robot_model.h)
int legJointIdentifier(Leg leg, int number);

/// Where the rotator and the elevator meet.
Point findShoulder(Leg leg);

/// The axis of the knee.
Point findKnee(Leg leg, const LegAngles& angles);

/// Centre of the foot's ball.
Point findFoot(Leg leg, const LegAngles& angles);

/// How the leg has to bend so that the centre of its foot is there. Of all ways to reach it, this is the one with the
/// foot below the shoulder, not lifted over it, and, if there are still two, with the knee bent, not overstretched. (A
/// leg is longest with the knee at 11.8 degrees in front and 18.9 behind.) The joints' limits are not looked at.
/// @param foot its centre
/// @param[out] angles that reach it, or, if it is too far from or too near to the shoulder, that come close
/// @return true if the leg reaches it
bool findLegAngles(Leg leg, const Point& foot, LegAngles* angles);

/// The corner of the belly beside this leg, raised by FOOT_RADIUS, so that all that the robot can rest on are balls of
/// the same size. Our choice, from the look of the body.
Point findBellyCorner(Leg leg);

}  // namespace robot_model

#endif  // AIBO_RCSERVER_ROBOT_MODEL_LEGS_H
