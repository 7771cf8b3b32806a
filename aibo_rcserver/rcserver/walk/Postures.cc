#include "rcserver/walk/Postures.h"

#include <math.h>

#include <algorithm>

using namespace protocol::version2;
using namespace robot_model;

namespace {

const double DEGREE = 3.14159265358979323846 / 180;

// In the sitting posture, the body leans back by 25 degrees, and all paws are on the floor. A lying robot is on its
// belly.
const LegAngles FRONT_SITS = {-35 * DEGREE, 5 * DEGREE, 15 * DEGREE};
const LegAngles HIND_SITS = {60 * DEGREE, 5 * DEGREE, 115 * DEGREE};
const LegAngles FRONT_RESTS = {65 * DEGREE, 10 * DEGREE, 30 * DEGREE};
const LegAngles HIND_RESTS = {-65 * DEGREE, 10 * DEGREE, 30 * DEGREE};

// How the robot rolls over; for left legs, a hind leg's rotator has the other sign. Found with the bench in
// test/physics. A leg turned by PAST_BACK ends above the back, and a leg spread by WIDE does not carry the robot.
const double PAST_BACK = 115 * DEGREE;
const double WIDE = 85 * DEGREE;
const LegAngles REACHES = {PAST_BACK, 2 * DEGREE, 5 * DEGREE};
const LegAngles PUSHES = {PAST_BACK, WIDE, 5 * DEGREE};
const LegAngles KEEPS_AWAY = {0, 0, 20 * DEGREE};
const LegAngles FOLDED = {90 * DEGREE, WIDE, 30 * DEGREE};
const LegAngles LEANS = {20 * DEGREE, 40 * DEGREE, 20 * DEGREE};

// Largest distance of a foot from a route, in metres, at which the robot still counts as on it. The value is our
// choice: more than load and joint slip cause, less than the length of a shank.
const double NEAR = 0.03;

// The number of places on a route that are checked. They are less than NEAR apart.
const int PLACES = 16;

// The range of foot positions in which the robot counts as standing, from half crouched to straight legs. Our choice.
const double LOWEST_STAND = -0.07;  // m; foot below the body's origin
const double STAND_SLANT = 0.03;    // m; difference in height between two feet
const double STAND_AROUND = 0.06;   // m; from the foot's place, seen from above

double Distance(const Point& a, const Point& b) {
  return sqrt((a.x - b.x) * (a.x - b.x) + (a.y - b.y) * (a.y - b.y) + (a.z - b.z) * (a.z - b.z));
}

LegAngles Between(const LegAngles& from, const LegAngles& to, double part) {
  const LegAngles angles = {from.rotator + (to.rotator - from.rotator) * part,
                            from.elevator + (to.elevator - from.elevator) * part,
                            from.knee + (to.knee - from.knee) * part};
  return angles;
}

LegAngles ForEnd(const LegAngles& angles, bool front) {
  const LegAngles result = {front ? angles.rotator : -angles.rotator, angles.elevator, angles.knee};
  return result;
}

}  // namespace

const int Postures::MAX_ROUTE;

Postures::Postures(const Gait& gait) {
  const Velocity none = {0, 0, 0};
  gait.FindPosture(0, none, 0, legs_[POSTURE_STAND]);
  for (int i = 0; i < NUMBER_OF_LEGS; ++i) {
    const bool front = isFront(static_cast<Leg>(i));
    const bool left = isLeft(static_cast<Leg>(i));
    legs_[0][i] = legs_[STAND][i];  // no posture has this number
    legs_[SIT][i] = front ? FRONT_SITS : HIND_SITS;
    legs_[REST][i] = front ? FRONT_RESTS : HIND_RESTS;
    legs_[FOLD][i] = ForEnd(FOLDED, front);
    legs_[SPREAD][i] = ForEnd(PUSHES, front);
    legs_[TIP_RIGHT][i] = ForEnd(left ? REACHES : LEANS, front);
    legs_[TIP_LEFT][i] = ForEnd(left ? LEANS : REACHES, front);
    legs_[REACH_LEFT][i] = ForEnd(left ? REACHES : KEEPS_AWAY, front);
    legs_[REACH_RIGHT][i] = ForEnd(left ? KEEPS_AWAY : REACHES, front);
    legs_[PUSH_LEFT][i] = ForEnd(left ? PUSHES : KEEPS_AWAY, front);
    legs_[PUSH_RIGHT][i] = ForEnd(left ? KEEPS_AWAY : PUSHES, front);
    standing_feet_[i] = findFoot(static_cast<Leg>(i), legs_[STAND][i]);
  }
}

bool Postures::Moves(Stage stage, int number) {
  return stage == SPREAD ? number == 1 : stage == FOLD ? number != 1 : true;
}

int Postures::FindRoute(const LegAngles* here, Posture wanted, bool lies_down, Stage* route) const {
  const bool stands = !lies_down && Stands(here);
  const bool sits = !lies_down && !stands && IsBetween(POSTURE_STAND, POSTURE_SIT, here);
  const bool rests = !lies_down && !stands && IsBetween(POSTURE_STAND, POSTURE_REST, here);
  int count = 0;
  if (!stands && !sits && !rests) {
    route[count++] = SPREAD;
    route[count++] = FOLD;
    if (wanted != POSTURE_REST) {
      route[count++] = REST;
    }
  }
  const bool comes_from_other_side = wanted == POSTURE_SIT ? !sits && !stands : wanted == POSTURE_REST && sits;
  if (comes_from_other_side) {
    route[count++] = STAND;
  }
  route[count++] = static_cast<Stage>(wanted);
  return count;
}

int Postures::FindRouteToBelly(FallWatch::Verdict verdict, int attempt, Stage* route) {
  switch (verdict) {
    case FallWatch::ON_LEFT_SIDE:
      route[0] = REACH_LEFT;
      route[1] = PUSH_LEFT;
      return 2;
    case FallWatch::ON_RIGHT_SIDE:
      route[0] = REACH_RIGHT;
      route[1] = PUSH_RIGHT;
      return 2;
    default:
      route[0] = attempt % 2 == 0 ? TIP_RIGHT : TIP_LEFT;
      return 1;
  }
}

bool Postures::Stands(const LegAngles* here) const {
  double lowest = 0;
  double highest = -1;
  for (int i = 0; i < NUMBER_OF_LEGS; ++i) {
    const Leg leg = static_cast<Leg>(i);
    const Point foot = findFoot(leg, here[i]);
    const Point& standing = standing_feet_[i];
    lowest = std::min(lowest, foot.z);
    highest = std::max(highest, foot.z);
    if (fabs(foot.x - standing.x) > STAND_AROUND || fabs(foot.y - standing.y) > STAND_AROUND) {
      return false;
    }
  }
  return highest <= LOWEST_STAND && highest - lowest <= STAND_SLANT;
}

// True if at some place on the way from one posture to the other, all feet are near.
bool Postures::IsBetween(Posture from, Posture to, const LegAngles* here) const {
  for (int place = 0; place <= PLACES; ++place) {
    double farthest = 0;
    for (int i = 0; i < NUMBER_OF_LEGS; ++i) {
      const Leg leg = static_cast<Leg>(i);
      const LegAngles there = Between(legs_[from][i], legs_[to][i], static_cast<double>(place) / PLACES);
      farthest = std::max(farthest, Distance(findFoot(leg, here[i]), findFoot(leg, there)));
    }
    if (farthest <= NEAR) {
      return true;
    }
  }
  return false;
}
