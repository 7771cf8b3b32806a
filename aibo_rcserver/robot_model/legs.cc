#include "robot_model/legs.h"

#include <math.h>

#include <algorithm>

namespace robot_model {

namespace {

// The left front leg, from Tekkotsu's kinematic table of the ERS-7. The other legs are mirrored, except for the hind
// shanks.
const Point SHOULDER = {0.065, 0.0625, 0};
const Point KNEE = {0.009, 0, -0.0695};  // from the shoulder
const Point FRONT_FOOT = {-0.00503, 0.0047, -0.06524};
const Point HIND_FOOT = {-0.013529, 0.0047, -0.06628};  // as if it were a front leg
const Point BELLY = {0.085, 0.035, -0.032};

double sideOf(Leg leg) {
  return isLeft(leg) ? 1 : -1;
}

double endOf(Leg leg) {
  return isFront(leg) ? 1 : -1;
}

// Converts a place of the left front leg to another leg, and back.
Point mirrored(Leg leg, const Point& point) {
  const Point result = {endOf(leg) * point.x, sideOf(leg) * point.y, point.z};
  return result;
}

const Point& shankOf(Leg leg) {
  return isFront(leg) ? FRONT_FOOT : HIND_FOOT;
}

// The angle of a place in the plane of the leg: 0 is straight down, positive is forward.
double angleOf(const Point& point) {
  return atan2(point.x, -point.z);
}

double lengthOf(const Point& point) {
  return sqrt(point.x * point.x + point.z * point.z);
}

// The place in the body to which elevator and rotator turn a place of the leg.
// @param point relative to the shoulder, for the left front leg, straight down
Point turnedAboutShoulder(Leg leg, const Point& point, const LegAngles& angles) {
  const double rotator = endOf(leg) * angles.rotator;
  const double outward = point.y * cos(angles.elevator) - point.z * sin(angles.elevator);
  const double up = point.y * sin(angles.elevator) + point.z * cos(angles.elevator);
  const Point turned = {SHOULDER.x + point.x * cos(rotator) - up * sin(rotator), SHOULDER.y + outward,
                        SHOULDER.z + point.x * sin(rotator) + up * cos(rotator)};
  return mirrored(leg, turned);
}

// Finds rotator and elevator for a given angle of the knee, which puts the foot at the right distance from the
// shoulder.
// @param way from the shoulder to the foot, for the left front leg
// @return false if the elevator cannot move the foot far enough sideways
bool turnLeg(Leg leg, const Point& way, double knee, LegAngles* angles) {
  const Point& shank = shankOf(leg);
  const double forward = KNEE.x + shank.x * cos(knee) - shank.z * sin(knee);
  const double up = KNEE.z + shank.x * sin(knee) + shank.z * cos(knee);

  // The rotator does not move the foot sideways, and the elevator does not move it forward or back.
  const double sine = way.y / sqrt(shank.y * shank.y + up * up);
  const double elevator = asin(std::min(std::max(sine, -1.0), 1.0)) - atan2(shank.y, -up);
  const double lifted = shank.y * sin(elevator) + up * cos(elevator);

  angles->rotator = endOf(leg) * atan2(forward * way.z - lifted * way.x, forward * way.x + lifted * way.z);
  angles->elevator = elevator;
  angles->knee = knee;
  return fabs(sine) <= 1;
}

}  // namespace

int legJointIdentifier(Leg leg, int number) {
  return 10 * (leg + 1) + 1 + number;
}

Point findShoulder(Leg leg) {
  return mirrored(leg, SHOULDER);
}

Point findKnee(Leg leg, const LegAngles& angles) {
  return turnedAboutShoulder(leg, KNEE, angles);
}

Point findFoot(Leg leg, const LegAngles& angles) {
  const Point& shank = shankOf(leg);
  const Point from_shoulder = {KNEE.x + shank.x * cos(angles.knee) - shank.z * sin(angles.knee), KNEE.y + shank.y,
                               KNEE.z + shank.x * sin(angles.knee) + shank.z * cos(angles.knee)};
  return turnedAboutShoulder(leg, from_shoulder, angles);
}

Point findRolledWay(Leg leg, const LegAngles& angles) {
  const Point way = {FOOT_RADIUS * (angles.rotator + endOf(leg) * angles.knee),
                     FOOT_RADIUS * sideOf(leg) * angles.elevator, 0};
  return way;
}

LegAngles findLegAngles(Leg leg, const Point& foot) {
  Point way = mirrored(leg, foot);  // from the shoulder to the foot
  way.x -= SHOULDER.x;
  way.y -= SHOULDER.y;
  way.z -= SHOULDER.z;

  // In the plane of the leg, only the knee changes the foot's distance.
  const Point& shank = shankOf(leg);
  const double square = way.x * way.x + way.y * way.y + way.z * way.z - shank.y * shank.y;
  const double upper = lengthOf(KNEE);
  const double lower = lengthOf(shank);
  const double cosine = (square - upper * upper - lower * lower) / (2 * upper * lower);
  const double stretched = angleOf(KNEE) - angleOf(shank);
  const double bent = acos(std::min(std::max(cosine, -1.0), 1.0));

  LegAngles angles;
  LegAngles overstretched;
  const bool is_bent = turnLeg(leg, way, stretched + bent, &angles);
  return !is_bent && turnLeg(leg, way, stretched - bent, &overstretched) ? overstretched : angles;
}

Point findBellyCorner(Leg leg) {
  return mirrored(leg, BELLY);
}

}  // namespace robot_model
