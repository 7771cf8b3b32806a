#include "rcserver/joints/JointPath.h"

#include <math.h>
#include <stdlib.h>

#include <algorithm>

namespace {

// The number of speeds strictly between two that are `difference` apart, if each frame adds `acceleration`.
int FramesOfRamp(int difference, int acceleration) {
  return difference > 0 ? (difference - 1) / acceleration : 0;
}

// 1 + 2 + ... + n. Sums of distances can exceed 32 bits, so they are doubles. For any motion, they are still exact
// whole numbers.
double SumUpTo(int n) {
  return 0.5 * n * (n + 1.0);
}

}  // namespace

JointPath::JointPath()
    : position_(0),
      step_(0),
      target_(0),
      frames_left_(0),
      step_limit_(1),
      acceleration_(1),
      wanted_acceleration_(1),
      is_following_(false),
      fraction_of_step_(0) {}

void JointPath::Place(int position) {
  position_ = position;
  step_ = 0;
  Aim(position);
}

void JointPath::LimitStep(int step) {
  step_limit_ = step;
  Review();
}

void JointPath::LimitAcceleration(int acceleration) {
  wanted_acceleration_ = acceleration;
  acceleration_ = std::max(acceleration_, acceleration);
  Review();
}

void JointPath::Aim(int target) {
  is_following_ = false;
  target_ = target;
  fraction_of_step_ = 0;
  frames_left_ = FewestFrames();
}

void JointPath::Follow(int target, int acceleration) {
  acceleration_ = std::max(acceleration_, acceleration);
  target_ = target;
  fraction_of_step_ = 0;
  frames_left_ = 1;
  is_following_ = true;
}

void JointPath::Stop(int acceleration) {
  acceleration_ = std::max(acceleration_, acceleration);
  Aim(position_ + BrakingDistance(step_));
}

int JointPath::WantedStep() {
  if (is_following_) {
    return FollowingStep();
  }
  if (frames_left_ == 0) {
    return 0;
  }
  int cruise = CruisingStep();
  const double distance = DistanceIn(frames_left_, cruise);
  const double missing = target_ - position_ - distance;
  if (missing > 0) {
    // The ideal speed lies between this one and the next higher one, so some frames use the higher one.
    fraction_of_step_ += missing / (DistanceIn(frames_left_, cruise + 1) - distance);
    if (fraction_of_step_ >= 1) {
      fraction_of_step_ -= 1;
      ++cruise;
    }
  }
  return StepTowards(cruise);
}

int JointPath::BrakingStep() const {
  return step_ > 0 ? std::max(step_ - acceleration_, 0) : std::min(step_ + acceleration_, 0);
}

JointPath::Span JointPath::SpanAfter(int step) const {
  const int next = position_ + step;
  const int stop = next + BrakingDistance(step);
  const Span span = {std::min(next, stop), std::max(next, stop)};
  return span;
}

JointPath::Span JointPath::BrakingSpan() const {
  const int stop = position_ + BrakingDistance(step_);
  const Span span = {std::min(position_, stop), std::max(position_, stop)};
  return span;
}

void JointPath::Advance(int step) {
  position_ += step;
  step_ = step;
  frames_left_ = std::max(frames_left_ - 1, 0);
  is_following_ = false;
  Review();
}

// Applies a lower acceleration limit as soon as possible, and plans a later arrival if the planned one has become
// impossible.
void JointPath::Review() {
  const bool stops_within_a_frame = step_ >= -wanted_acceleration_ && step_ <= wanted_acceleration_;
  if (stops_within_a_frame) {
    acceleration_ = wanted_acceleration_;
  }
  if (!CanArriveIn(frames_left_)) {
    frames_left_ = FewestFrames();
  }
}

// The distance that the joint covers in this number of frames, stop included, with this cruising speed. The distance
// grows with the speed. The result is valid only if the joint can stop in that many frames.
double JointPath::DistanceIn(int frames, int cruise) const {
  // Backward motion is mirrored forward motion.
  const int sign = cruise < 0 ? -1 : 1;
  const int speed = sign * step_;
  const int top = sign * cruise;

  int first_ramp = FramesOfRamp(abs(top - speed), acceleration_);
  int last_ramp = FramesOfRamp(top, acceleration_);
  if (speed < top) {
    // If there is no time to reach the cruising speed, the ramps meet below it.
    const double meeting = floor(((frames + 1.0) * acceleration_ - speed) / (2.0 * acceleration_));
    const int rising = meeting < frames ? static_cast<int>(meeting) : frames;
    first_ramp = std::min(first_ramp, rising);
    last_ramp = std::min(last_ramp, frames - rising);
  }
  const double change = speed < top ? acceleration_ : -acceleration_;
  const double first = static_cast<double>(first_ramp) * speed + change * SumUpTo(first_ramp);
  const double middle = static_cast<double>(frames - first_ramp - last_ramp) * top;
  const double last = acceleration_ * SumUpTo(last_ramp);
  return sign * (first + middle + last);
}

// If the joint can arrive in a number of frames, it can also arrive in any higher number.
bool JointPath::CanArriveIn(int frames) const {
  const bool can_stop = abs(step_) <= (frames + 1.0) * acceleration_;
  const double distance = target_ - position_;
  return can_stop && DistanceIn(frames, -step_limit_) <= distance && distance <= DistanceIn(frames, step_limit_);
}

int JointPath::FewestFrames() const {
  if (CanArriveIn(0)) {
    return 0;
  }
  int too_few = 0;
  int enough = 1;
  while (!CanArriveIn(enough)) {
    too_few = enough;
    enough *= 2;
  }
  while (enough - too_few > 1) {
    const int middle = too_few + (enough - too_few) / 2;
    (CanArriveIn(middle) ? enough : too_few) = middle;
  }
  return enough;
}

// The highest cruising speed that does not take the joint past its target by the time of its arrival.
int JointPath::CruisingStep() const {
  const double distance = target_ - position_;
  int low = -step_limit_;
  int too_high = step_limit_ + 1;
  while (too_high - low > 1) {
    const int middle = low + (too_high - low) / 2;
    (DistanceIn(frames_left_, middle) <= distance ? low : too_high) = middle;
  }
  return low;
}

// The first step of the motion whose distance is DistanceIn(frames_left_, cruise).
int JointPath::StepTowards(int cruise) const {
  const int sign = cruise < 0 ? -1 : 1;
  const int speed = sign * step_;
  const int top = sign * cruise;
  const int still_stops = frames_left_ > top / acceleration_ ? top : frames_left_ * acceleration_;
  return sign * std::max(std::min(still_stops, speed + acceleration_), speed - acceleration_);
}

// The step to the target or, beyond the limits, the nearest step within them. A joint that is too fast brakes.
int JointPath::FollowingStep() const {
  const int limit = step_limit_ - step_limit_ / 32;  // a motor at its highest speed has no torque left
  const int step = std::min(std::max(target_ - position_, -limit), limit);
  return std::min(std::max(step, step_ - acceleration_), step_ + acceleration_);
}

int JointPath::BrakingDistance(int step) const {
  const int frames = FramesOfRamp(abs(step), acceleration_);
  const double distance = static_cast<double>(frames) * abs(step) - acceleration_ * SumUpTo(frames);
  return static_cast<int>(step < 0 ? -distance : distance);
}
