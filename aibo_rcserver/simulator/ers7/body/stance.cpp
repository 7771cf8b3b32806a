#include "simulator/ers7/body/stance.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "simulator/ers7/body/head_kinematics.h"

namespace simulated_ers7 {
namespace {

using Eigen::Vector3d;
using robot_model::FOOT_RADIUS;

/// How far outside its three supports the weight may be, in metres. Our choice: with less, a robot that lifts a paw
/// would tip over onto it. A real robot prevents that by leaning away.
constexpr double kBalance = 0.02;

constexpr double kTolerance = 1e-6;

Vector3d toVector(const robot_model::Point& point) {
  return {point.x, point.y, point.z};
}

/// A plane in the body: z = slope_x * x + slope_y * y + height.
struct Plane {
  double slope_x;
  double slope_y;
  double height;

  double slope() const { return std::hypot(slope_x, slope_y); }
  double below(const Vector3d& point) const { return point.z() - (slope_x * point.x() + slope_y * point.y() + height); }
};

using Supports = std::array<Vector3d, 2 * kLegs>;  ///< the feet, then the belly's corners

double cross(const Vector3d& a, const Vector3d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Distance of the body's origin to the left of the line from a to b, seen from above.
double leftOf(const Vector3d& a, const Vector3d& b) {
  return cross(a, b) / (b - a).head<2>().norm();
}

/// Whether the body's origin is over the triangle, or at most kBalance beside it.
bool carry(const Vector3d& a, const Vector3d& b, const Vector3d& c) {
  const double lefts[] = {leftOf(a, b), leftOf(b, c), leftOf(c, a)};
  return *std::min_element(std::begin(lefts), std::end(lefts)) >= -kBalance ||
         *std::max_element(std::begin(lefts), std::end(lefts)) <= kBalance;
}

bool isSteep(const Vector3d& normal) {
  return std::abs(normal.z()) < kTolerance;  // the three are in line, or above each other
}

Plane planeThrough(const Vector3d& point, const Vector3d& normal) {
  const double slope_x = -normal.x() / normal.z();
  const double slope_y = -normal.y() / normal.z();
  return {slope_x, slope_y, point.z() - slope_x * point.x() - slope_y * point.y()};
}

/// The most level plane through three supports that carry the body and have no other support below them. With the
/// belly's corners there always is one.
Plane supportingPlane(const Supports& supports) {
  std::optional<Plane> best;
  for (std::size_t i = 0; i < supports.size(); ++i) {
    for (std::size_t j = i + 1; j < supports.size(); ++j) {
      for (std::size_t k = j + 1; k < supports.size(); ++k) {
        const Vector3d normal = (supports[j] - supports[i]).cross(supports[k] - supports[i]);
        if (isSteep(normal) || !carry(supports[i], supports[j], supports[k])) {
          continue;
        }
        const Plane plane = planeThrough(supports[i], normal);
        if (std::all_of(supports.begin(), supports.end(),
                        [&](const Vector3d& support) { return plane.below(support) >= -kTolerance; })) {
          best = !best || plane.slope() < best->slope() ? plane : *best;
        }
      }
    }
  }
  return best.value_or(Plane{0, 0, FOOT_RADIUS - kStandingHeight});
}

/// The pose of a body with the centres of its supports in this plane.
Eigen::Isometry3d poseOver(const Plane& plane) {
  const Vector3d up = Vector3d(-plane.slope_x, -plane.slope_y, 1).normalized();
  const Vector3d ahead = (Vector3d::UnitX() - up.x() * up).normalized();
  Eigen::Matrix3d turn;
  turn << ahead.transpose(), up.cross(ahead).transpose(), up.transpose();
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = turn;
  pose.translation().z() = FOOT_RADIUS - plane.height * up.z();
  return pose;
}

}  // namespace

Vector3d footInBody(Leg leg, const LegAngles& angles) {
  return toVector(robot_model::findFoot(leg, angles));
}

Stance standOn(const std::array<LegAngles, kLegs>& legs) {
  Supports supports;
  for (std::size_t i = 0; i < kLegs; ++i) {
    const Leg leg = static_cast<Leg>(i);
    supports[i] = footInBody(leg, legs[i]);
    supports[kLegs + i] = toVector(robot_model::findBellyCorner(leg));
  }
  Stance stance;
  stance.body = poseOver(supportingPlane(supports));
  for (std::size_t i = 0; i < kLegs; ++i) {
    stance.paw_down[i] = (stance.body * supports[i]).z() - FOOT_RADIUS <= kPawTravel;
  }
  return stance;
}

}  // namespace simulated_ers7
