#include "walk/stance.h"

#include <algorithm>
#include <cmath>

namespace aibo_driver::walk {
namespace {

using Eigen::AngleAxisd;
using Eigen::Translation3d;
using Eigen::Vector3d;

// A foot that is at most this far above the floor touches it. The distance allows for the travel of the foot's switch,
// and for some error of the joints.
constexpr double kTouch = 0.003;  // m

// How far the accelerometer may be off. The value is our choice. The accelerometer's errors and slight motion stay
// below it, and a robot that somebody lifts tilts more.
constexpr double kTrust = 0.26;  // rad: 15 degrees

constexpr double kTolerance = 1e-6;  // m, for rounding errors

using Supports = std::array<Vector3d, 2 * kLegs>;  // the feet, then the corners of the belly

Vector3d toVector(const robot_model::Point& point) {
  return {point.x, point.y, point.z};
}

Supports supportsOf(const std::array<LegAngles, kLegs>& legs) {
  Supports supports;
  for (std::size_t i = 0; i < kLegs; ++i) {
    const Leg leg = static_cast<Leg>(i);
    supports[i] = footOf(leg, legs[i]);
    supports[kLegs + i] = toVector(robot_model::findBellyCorner(leg));
  }
  return supports;
}

/// The height of the lowest support in metres, from the body's origin. It is negative, because all supports are below
/// it.
double lowest(const Supports& supports, const Vector3d& up) {
  double height = up.dot(supports[0]);
  for (const Vector3d& support : supports) {
    height = std::min(height, up.dot(support));
  }
  return height;
}

/// The up direction of a body that stands on three supports and has no other support below them. Of all such
/// directions, this is the closest to `measured`.
Vector3d upOf(const Supports& supports, const Vector3d& measured) {
  Vector3d best = measured;
  double best_cosine = std::cos(kTrust);
  for (std::size_t i = 0; i < supports.size(); ++i) {
    for (std::size_t j = i + 1; j < supports.size(); ++j) {
      for (std::size_t k = j + 1; k < supports.size(); ++k) {
        Vector3d up = (supports[j] - supports[i]).cross(supports[k] - supports[i]).normalized();
        up *= up.dot(measured) < 0 ? -1 : 1;
        const double cosine = up.dot(measured);
        if (cosine > best_cosine && lowest(supports, up) >= up.dot(supports[i]) - kTolerance) {
          best = up;
          best_cosine = cosine;
        }
      }
    }
  }
  return best;
}

}  // namespace

Vector3d footOf(Leg leg, const LegAngles& angles) {
  return toVector(robot_model::findFoot(leg, angles));
}

Stance estimateStance(const std::array<LegAngles, kLegs>& legs, const Vector3d& acceleration) {
  const Supports supports = supportsOf(legs);
  const bool falls = !(acceleration.norm() > kTolerance);
  const Vector3d up = upOf(supports, falls ? Vector3d::UnitZ() : Vector3d(acceleration.normalized()));
  const double floor = lowest(supports, up);
  Stance stance;
  // The body is turned only by roll and pitch, so x still points ahead.
  stance.body = Translation3d(0, 0, robot_model::FOOT_RADIUS - floor) *
                AngleAxisd(std::atan2(-up.x(), std::hypot(up.y(), up.z())), Vector3d::UnitY()) *
                AngleAxisd(std::atan2(up.y(), up.z()), Vector3d::UnitX());
  for (std::size_t i = 0; i < kLegs; ++i) {
    stance.foot_on_floor[i] = up.dot(supports[i]) - floor <= kTouch;
  }
  return stance;
}

}  // namespace aibo_driver::walk
