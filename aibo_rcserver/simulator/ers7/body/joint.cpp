#include "simulator/ers7/body/joint.h"

#include <algorithm>
#include <cmath>

#include "simulator/openr_host/clock.h"

namespace simulated_ers7 {
namespace {

/// The duty with the standard gain, if the distance to the command is the joint's movement in a frame at its highest
/// speed.
constexpr double kStiffness = 1.0 / 3;

/// The share of the difference by which a frame brings the motor nearer to the speed that its duty gives. With
/// kStiffness, the motor would overshoot if the share were larger.
constexpr double kResponse = 0.75;

/// A joint is at rest below these values, in microradians and microradians per frame. No sensor resolves less, and a
/// joint at rest keeps the picture still.
constexpr double kStandstill = 1;

word encoderSteps(double position, const robot_model::Joint& model) {
  const double steps = std::round((position - model.mechanical_lowest) / Joint::kEncoderStep);
  return static_cast<word>(std::max(0.0, std::min(steps, 65535.0)));
}

}  // namespace

Joint::Joint(const robot_model::Joint& model, int position)
    : model_(model),
      highest_step_(model.highest_speed * openr_host::kFrameSeconds),
      reference_(position),
      position_(position) {
  readings_.fill(read(0));
}

OStatus Joint::setGains(const robot_model::PidGains& gains) {
  if (!gains_) {
    return oGAIN_DISABLED;
  }
  gains_ = gains;
  return oSUCCESS;
}

void Joint::passFrame(int error_of_reading) {
  drive();
  move();
  std::rotate(readings_.begin(), readings_.begin() + 1, readings_.end());
  readings_.back() = read(error_of_reading);
}

void Joint::drive() {
  duty_ = 0;
  if (isDriven()) {
    const double stiffness = kStiffness * gains_->proportional / model_.gains.proportional;
    duty_ = std::clamp(stiffness * (reference_ - position_) / highest_step_, -1.0, 1.0);
  }
}

void Joint::move() {
  if (jammed_ || !isDriven()) {
    step_ = 0;
    return;
  }
  step_ += kResponse * (duty_ * highest_step_ - step_);
  position_ += step_;
  if (std::abs(reference_ - position_) < kStandstill && std::abs(step_) < kStandstill) {
    position_ = reference_;
    step_ = 0;
  }
  const double stop =
      std::max<double>(model_.mechanical_lowest, std::min<double>(position_, model_.mechanical_highest));
  if (stop != position_) {
    position_ = stop;
    step_ = 0;
  }
}

OJointValue Joint::read(int error_of_reading) const {
  OJointValue value = {};
  value.value = static_cast<slongword>(std::lround(position_)) + error_of_reading;
  value.signal = encoderSteps(value.value, model_);
  value.pwmDuty = static_cast<sword>(std::lround(duty_ * kFullDuty));
  value.refValue = reference_;
  value.refSignal = encoderSteps(reference_, model_);
  return value;
}

}  // namespace simulated_ers7
