#include "rcserver/walk/WalkPace.h"

#include <math.h>

#include <algorithm>

#include "robot_model/robot_model.h"

using protocol::version2::Velocity;
using protocol::version2::WalkLimits;
using namespace robot_model;

namespace {

const double FRAME = FRAME_MILLISECONDS * 1e-3;  // s

// How fast the correction of the velocity grows with what is missing, in 1/s, and the time in s over which the missing
// velocity is smoothed. With this choice, a lasting error of the legs is made up for within a step, and the swaying of
// a step has little effect.
const double CORRECTION_RATE = 3;
const double SMOOTHING = 0.25;

// Largest correction, as a share of the highest velocity. Our choice.
const double CORRECTION_LIMIT = 0.3;

// In s, from the planned to the measured motion of the legs: commands wait for up to 8 frames, and servos lag by 3.
const double DELAY = 0.09;

// The feet go to the side to which the robot leans more than it should: by this many metres for each radian, within
// this time in s, and at most this far. Found with the bench: the robot rocks the least.
const double BALANCE = 0.24;
const double BALANCE_TIME = 0.8;
const double BALANCE_LIMIT = 0.015;

// In m; if the feet have been shifted by more than this, the ground slopes by 3 degrees or more, and a robot that walks
// too fast to trot may fall.
const double STEEP = 0.0125;

const double GRAVITY = 9.81;  // m/s^2

const Velocity NO_VELOCITY = {0, 0, 0};

double Towards(double value, double target, double step) {
  return value + std::min(std::max(target - value, -step), step);
}

// A value that follows another value with a delay of this time.
double Following(double value, double target, double time, double seconds) {
  return value + (target - value) * seconds / (time + seconds);
}

double Corrected(double correction, double missing, double highest) {
  const double limit = CORRECTION_LIMIT * highest;
  return std::min(std::max(correction + CORRECTION_RATE * missing * FRAME, -limit), limit);
}

double Balanced(double shift, double lean) {
  const double next = Following(shift, BALANCE * lean, BALANCE_TIME, FRAME);
  return std::min(std::max(next, -BALANCE_LIMIT), BALANCE_LIMIT);
}

Velocity Following(const Velocity& value, const Velocity& target, double time, double seconds) {
  const Velocity result = {Following(value.forward, target.forward, time, seconds),
                           Following(value.left, target.left, time, seconds),
                           Following(value.turn, target.turn, time, seconds)};
  return result;
}

Velocity Towards(const Velocity& value, const Velocity& target, const Velocity& step) {
  const Velocity result = {Towards(value.forward, target.forward, step.forward),
                           Towards(value.left, target.left, step.left), Towards(value.turn, target.turn, step.turn)};
  return result;
}

}  // namespace

bool WalkPace::NextFrame(const Velocity& wanted, bool ends, LegAngles* legs) {
  ChangeVelocity(wanted, ends);
  const bool stops = ends && now_.velocity.isZero() && now_.correction.isZero();
  if (stops && now_.effort == 0) {
    return false;
  }
  const Velocity sum = {now_.velocity.forward + now_.correction.forward, now_.velocity.left + now_.correction.left,
                        now_.velocity.turn + now_.correction.turn};
  const Velocity velocity = gait_.LimitedForLegs(sum, now_.velocity.forward);
  const double period = gait_.StepAt(velocity).period;
  now_.effort = Towards(now_.effort, stops ? 0 : 1, FRAME / (period / 2));
  now_.phase += FRAME / period;
  now_.phase -= floor(now_.phase);
  now_.shift.x = Balanced(now_.shift.x, now_.lean.x);
  now_.shift.y = Balanced(now_.shift.y, now_.lean.y);
  gait_.FindPosture(now_.phase, velocity, now_.effort, legs, now_.shift);
  return true;
}

void WalkPace::Measured(const Velocity& walked, const FallWatch::Reading& reading, unsigned frames) {
  CompareVelocity(walked, frames * FRAME);
  FeelLean(reading, frames * FRAME);
}

void WalkPace::ChangeVelocity(const Velocity& wanted, bool ends) {
  const WalkLimits& limits = gait_.Parameters().highest;
  Velocity target = wanted;
  if (std::max(fabs(now_.shift.x), fabs(now_.shift.y)) > STEEP) {
    target.forward = std::min(target.forward, limits.forward);
  }
  const bool is_back = now_.velocity.forward < 0 || (now_.velocity.forward == 0 && target.forward < 0);
  const double step = SPEED_CHANGE * FRAME;
  const Velocity most = {step * (is_back ? limits.back : limits.forward), step * limits.left, step * limits.turn};
  now_.velocity = gait_.LimitedInWalk(Towards(now_.velocity, target, most));
  if (ends) {
    now_.correction = Towards(now_.correction, NO_VELOCITY, most);
  } else {
    CorrectVelocity();
  }
}

// Corrects the velocity a little in each frame, because a foot must not jump.
void WalkPace::CorrectVelocity() {
  const WalkLimits& limits = gait_.Parameters().highest;
  now_.correction.forward = Corrected(now_.correction.forward, now_.missing.forward, limits.forward);
  now_.correction.left = Corrected(now_.correction.left, now_.missing.left, limits.left);
  now_.correction.turn = Corrected(now_.correction.turn, now_.missing.turn, limits.turn);
}

// Compares the measured velocity with the commanded one, which the legs follow with a delay.
void WalkPace::CompareVelocity(const Velocity& walked, double seconds) {
  now_.expected = Following(now_.expected, now_.velocity, DELAY, seconds);
  const Velocity missing = {now_.expected.forward - walked.forward, now_.expected.left - walked.left,
                            now_.expected.turn - walked.turn};
  now_.missing = Following(now_.missing, missing, SMOOTHING, seconds);
}

// Averages the accelerometer, which shows gravity only on average, because each foot that touches down shakes the body.
void WalkPace::FeelLean(const FallWatch::Reading& reading, double seconds) {
  if (reading.up > 0) {  // without an accelerometer, it is 0
    const double ahead = -reading.forward / GRAVITY - gait_.NoseDown(now_.velocity);
    now_.lean.x = Following(now_.lean.x, ahead, SMOOTHING, seconds);
    now_.lean.y = Following(now_.lean.y, -reading.left / GRAVITY, SMOOTHING, seconds);
  }
}
