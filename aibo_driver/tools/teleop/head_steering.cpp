#include "tools/teleop/head_steering.h"

#include <algorithm>

#include "robot_model/robot_model.h"

namespace teleop {
namespace {

// If messages come less often than this, the head turns more slowly.
constexpr double kLongestStep = 0.1;  // s

// A command is never further ahead of the head than this. The head may be slow, or somebody may hold it.
constexpr double kFurthestAhead = 0.3;  // rad

double advance(const char* joint, double target, double measured, double way) {
  const robot_model::RobotModel& model = *robot_model::findRobotModel("ERS-7");
  const robot_model::Joint& limits = model.joints[robot_model::findJointByName(model, joint)];
  const double ahead = std::clamp(target + way, measured - kFurthestAhead, measured + kFurthestAhead);
  return std::clamp(ahead, limits.lowest * 1e-6, limits.highest * 1e-6);
}

}  // namespace

void HeadSteering::measured(const HeadPosition& position) {
  measured_ = position;
}

std::optional<HeadPosition> HeadSteering::steer(const std::optional<HeadVelocity>& velocity, TimePoint now) {
  if (!velocity || !measured_) {
    target_.reset();
    return std::nullopt;
  }
  if (!target_) {
    target_ = measured_;
    last_ = now;
  }
  const double step = std::min(std::chrono::duration<double>(now - last_).count(), kLongestStep);
  last_ = now;
  target_->pan = advance("head_pan", target_->pan, measured_->pan, velocity->pan * step);
  target_->tilt = advance("head_tilt", target_->tilt, measured_->tilt, velocity->tilt * step);
  return target_;
}

}  // namespace teleop
