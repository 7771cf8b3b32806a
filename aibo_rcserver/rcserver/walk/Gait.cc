#include "rcserver/walk/Gait.h"

#include <math.h>

#include <algorithm>

using protocol::version2::Velocity;
using robot_model::FOOT_RADIUS;
using robot_model::Leg;
using robot_model::LegAngles;
using robot_model::Point;

namespace {

// The position of a point that accelerates evenly for `easing`, moves on, and slows down evenly for `easing` at the
// end. Positions and times are shares of the whole.
// @param from its speed at both ends
double Eased(double time, double easing, double from) {
  const double top = (1 - easing * from) / (1 - easing);
  const double left = std::min(time, 1 - time);
  const double way = left < easing ? from * left + (top - from) * left * left / (2 * easing)
                                   : (from + top) / 2 * easing + top * (left - easing);
  return time < 0.5 ? way : 1 - way;
}

double Part(double value, double highest) {
  return fabs(value) / highest;
}

}  // namespace

GaitParameters::GaitParameters()
    : period(0.453),
      duty(0.503),
      margin(0.024),
      lag(0.045),
      height(0.115),
      lift(0.015),
      front_ahead(0.023),
      hind_ahead(0.0103),
      outward(0.0146),
      nose_down(-0.019),
      easing(0.187),
      lift_easing(0.06) {
  highest.forward = 0.15;
  highest.back = 0.1;
  highest.left = 0.06;
  highest.turn = 1.2;
}

Velocity Gait::Limited(const Velocity& wanted) const {
  const double highest = wanted.forward < 0 ? parameters_.highest.back : parameters_.highest.forward;
  const double sum = Part(wanted.forward, highest) + Part(wanted.left, parameters_.highest.left) +
                     Part(wanted.turn, parameters_.highest.turn);
  const double scale = sum > 1 ? 1 / sum : 1;
  const Velocity limited = {wanted.forward * scale, wanted.left * scale, wanted.turn * scale};
  return limited;
}

void Gait::FindPosture(double phase, const Velocity& velocity, double effort, LegAngles* angles) const {
  const double with_floor = parameters_.duty + 2 * parameters_.margin;
  const double sine = sin(parameters_.nose_down);
  const double cosine = cos(parameters_.nose_down);
  for (int i = 0; i < robot_model::NUMBER_OF_LEGS; ++i) {
    const Leg leg = static_cast<Leg>(i);
    const Point middle = FootMiddle(leg);
    const double time = LegPhase(leg, phase);
    const double in_air = (time - parameters_.duty) / (1 - parameters_.duty);
    const double lift = in_air >= 0 ? effort * Lift(in_air) : 0;
    // The time in seconds that the foot needs from here to the middle of its line at the floor's speed.
    const double ahead = PlaceAt(time + parameters_.margin) * with_floor * parameters_.period - parameters_.lag;
    const Point foot = {middle.x + ahead * (velocity.forward - velocity.turn * middle.y),
                        middle.y + ahead * (velocity.left + velocity.turn * middle.x), middle.z + lift};
    const Point in_body = {foot.x * cosine - foot.z * sine, foot.y, foot.x * sine + foot.z * cosine};
    findLegAngles(leg, in_body, &angles[i]);
  }
}

bool Gait::MovesWithFloor(Leg leg, double phase) const {
  const double since = LegPhase(leg, phase) + parameters_.margin;
  return since - floor(since) < parameters_.duty + 2 * parameters_.margin;
}

double Gait::LegPhase(Leg leg, double phase) {
  const bool is_first_pair = leg == robot_model::LEFT_FRONT_LEG || leg == robot_model::RIGHT_HIND_LEG;
  const double shifted = is_first_pair ? phase : phase + 0.5;
  return shifted - floor(shifted);
}

// Where a foot is on its line: 0.5 at the front end, -0.5 at the rear end.
// @param time since it has been at the front end, in parts of the period
double Gait::PlaceAt(double time) const {
  const double with_floor = parameters_.duty + 2 * parameters_.margin;
  time -= floor(time);
  if (time < with_floor) {
    return 0.5 - time / with_floor;
  }
  // The floor moves backward at this speed, in parts of the line and of the time that is left.
  const double speed = -(1 - with_floor) / with_floor;
  return Eased((time - with_floor) / (1 - with_floor), parameters_.easing, speed) - 0.5;
}

double Gait::Lift(double part) const {
  return parameters_.lift * Eased(2 * std::min(part, 1 - part), 2 * parameters_.lift_easing, 0);
}

// Seen from the middle of the shoulders, with z up.
Point Gait::FootMiddle(Leg leg) const {
  Point middle = findShoulder(leg);
  middle.x += isFront(leg) ? parameters_.front_ahead : parameters_.hind_ahead;
  middle.y += isLeft(leg) ? parameters_.outward : -parameters_.outward;
  middle.z = FOOT_RADIUS - parameters_.height;
  return middle;
}
