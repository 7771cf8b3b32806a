#include "walk/walk_settings.h"

#include <algorithm>
#include <cmath>

namespace aibo_driver::walk {

using aibo_client::WalkVelocity;

namespace {

/// Turns the direction of walking by `angle` to the left.
WalkVelocity turned(const WalkVelocity& velocity, double angle) {
  const double cosine = std::cos(angle);
  const double sine = std::sin(angle);
  return {cosine * velocity.forward - sine * velocity.left, sine * velocity.forward + cosine * velocity.left,
          velocity.turn};
}

/// How far the robot turns because it walks ahead.
double bend(const WalkVelocity& real, const WalkSettings& settings) {
  return settings.curve * std::max(real.forward, 0.0);
}

/// The factor that brings a value within its limit; at most 1. If the limit is 0, the value becomes 0 instead.
double factorFor(double limit, double* value) {
  if (limit <= 0) {
    *value = 0;
  }
  return std::abs(*value) > limit ? limit / std::abs(*value) : 1.0;
}

WalkVelocity limited(WalkVelocity velocity, const aibo_client::WalkLimits& limits) {
  const double ahead = velocity.forward < 0 ? limits.back : limits.forward;
  const double factor = std::min({factorFor(ahead, &velocity.forward), factorFor(limits.left, &velocity.left),
                                  factorFor(limits.turn, &velocity.turn)});
  return {velocity.forward * factor, velocity.left * factor, velocity.turn * factor};
}

}  // namespace

WalkVelocity realVelocity(const WalkVelocity& said, const WalkSettings& settings) {
  WalkVelocity real =
      turned({said.forward * settings.scale, said.left * settings.side_scale, said.turn}, settings.direction);
  real.turn = said.turn * settings.turn_scale + bend(real, settings);
  return real;
}

WalkVelocity velocityToSend(const WalkVelocity& wanted, const WalkSettings& settings,
                            const aibo_client::WalkLimits& robot) {
  const WalkVelocity real =
      limited(wanted, {settings.speed_limit, settings.speed_limit, settings.side_limit, settings.turn_limit});
  const WalkVelocity ahead = turned(real, -settings.direction);
  const WalkVelocity sent = {ahead.forward / settings.scale, ahead.left / settings.side_scale,
                             (real.turn - bend(real, settings)) / settings.turn_scale};
  const bool is_limited = robot.forward > 0 || robot.back > 0 || robot.left > 0 || robot.turn > 0;
  return is_limited ? limited(sent, robot) : sent;
}

}  // namespace aibo_driver::walk
