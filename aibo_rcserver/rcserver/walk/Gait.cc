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

// Where a foot is on its line: 0.5 at the front end, -0.5 at the rear end.
// @param time since it has been at the front end, in parts of the period
double PlaceAt(const StepParameters& step, double time) {
  const double with_floor = step.duty + 2 * step.margin;
  time -= floor(time);
  if (time < with_floor) {
    return 0.5 - time / with_floor;
  }
  // The floor moves backward at this speed, in parts of the line and of the time that is left.
  const double speed = -(1 - with_floor) / with_floor;
  return Eased((time - with_floor) / (1 - with_floor), step.easing, speed) - 0.5;
}

// Seen from the middle of the shoulders, with z up.
Point FootMiddle(const StepParameters& step, Leg leg) {
  const double outward = isFront(leg) ? step.front_outward : step.hind_outward;
  Point middle = findShoulder(leg);
  middle.x += isFront(leg) ? step.front_ahead : step.hind_ahead;
  middle.y += isLeft(leg) ? outward : -outward;
  middle.z = FOOT_RADIUS - step.height;
  return middle;
}

double Lift(const StepParameters& step, Leg leg, double part) {
  const double highest = isFront(leg) ? step.front_lift : step.hind_lift;
  return highest * Eased(2 * std::min(part, 1 - part), 2 * step.lift_easing, 0);
}

// All numbers of a step.
double StepParameters::*const NUMBERS[] = {
    &StepParameters::period,        &StepParameters::duty,         &StepParameters::margin,
    &StepParameters::lag,           &StepParameters::height,       &StepParameters::front_lift,
    &StepParameters::hind_lift,     &StepParameters::front_ahead,  &StepParameters::hind_ahead,
    &StepParameters::front_outward, &StepParameters::hind_outward, &StepParameters::nose_down,
    &StepParameters::easing,        &StepParameters::lift_easing};

}  // namespace

// The numbers of a step are in the order of StepParameters.
GaitParameters::GaitParameters() {
  const StepParameters turning = {0.4437, 0.5105, 0.0145, 0.0266, 0.1148,  0.0156, 0.0151,
                                  0.0197, 0.0008, 0.0163, 0.0195, -0.0052, 0.1237, 0.0368};
  const StepParameters fast = {0.54,   0.5038, 0.0054, 0.0384, 0.1232,  0.0129, 0.0165,
                               0.0105, 0.0045, 0.0161, 0.0117, -0.0725, 0.1314, 0.0458};
  const StepParameters backing = {0.4461, 0.5129, 0.0076, 0.0368, 0.1152, 0.0146, 0.0158,
                                  0.0135, 0.0130, 0.0117, 0.0218, 0.0022, 0.1067, 0.0381};
  in_place = turning;
  forward = fast;
  back = backing;
  highest.forward = 0.2;
  highest.back = 0.15;
  highest.left = 0.08;
  highest.turn = 1.5;
  highest_of_legs.forward = 1.05 * highest.forward;
  highest_of_legs.back = 1.06 * highest.back;
  highest_of_legs.left = 1.15 * highest.left;
  highest_of_legs.turn = 1.08 * highest.turn;
}

Velocity Gait::Shortened(const Velocity& wanted, const protocol::version2::WalkLimits& highest) {
  const double sum = Part(wanted.forward, wanted.forward < 0 ? highest.back : highest.forward) +
                     Part(wanted.left, highest.left) + Part(wanted.turn, highest.turn);
  const double scale = sum > 1 ? 1 / sum : 1;
  const Velocity limited = {wanted.forward * scale, wanted.left * scale, wanted.turn * scale};
  return limited;
}

StepParameters Gait::StepAt(const Velocity& velocity) const {
  const bool is_back = velocity.forward < 0;
  const StepParameters& other = is_back ? parameters_.back : parameters_.forward;
  const double highest = is_back ? parameters_.highest.back : parameters_.highest.forward;
  const double share = std::min(Part(velocity.forward, highest), 1.0);
  const double part = share * share;  // at half the speed, the numbers for turning are still the better ones
  StepParameters step = parameters_.in_place;
  for (size_t i = 0; i < sizeof(NUMBERS) / sizeof(NUMBERS[0]); ++i) {
    step.*NUMBERS[i] += part * (other.*NUMBERS[i] - step.*NUMBERS[i]);
  }
  return step;
}

void Gait::FindPosture(double phase, const Velocity& velocity, double effort, LegAngles* angles) const {
  const StepParameters step = StepAt(velocity);
  const double with_floor = step.duty + 2 * step.margin;
  const double sine = sin(step.nose_down);
  const double cosine = cos(step.nose_down);
  for (int i = 0; i < robot_model::NUMBER_OF_LEGS; ++i) {
    const Leg leg = static_cast<Leg>(i);
    const Point middle = FootMiddle(step, leg);
    const double time = LegPhase(leg, phase);
    const double in_air = (time - step.duty) / (1 - step.duty);
    const double lift = in_air >= 0 ? effort * Lift(step, leg, in_air) : 0;
    // The time in seconds that the foot needs from here to the middle of its line at the floor's speed.
    const double ahead = PlaceAt(step, time + step.margin) * with_floor * step.period - step.lag;
    const Point foot = {middle.x + ahead * (velocity.forward - velocity.turn * middle.y),
                        middle.y + ahead * (velocity.left + velocity.turn * middle.x), middle.z + lift};
    const Point in_body = {foot.x * cosine - foot.z * sine, foot.y, foot.x * sine + foot.z * cosine};
    findLegAngles(leg, in_body, &angles[i]);
  }
}

double Gait::LegPhase(Leg leg, double phase) {
  const bool is_first_pair = leg == robot_model::LEFT_FRONT_LEG || leg == robot_model::RIGHT_HIND_LEG;
  const double shifted = is_first_pair ? phase : phase + 0.5;
  return shifted - floor(shifted);
}
