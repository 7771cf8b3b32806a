#include "simulator/ers7/body/stance.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace simulated_ers7 {
namespace {

using Eigen::Vector3d;
using robot_model::FOOT_RADIUS;

/// Largest distance of the weight from the triangle of its supports, in metres (our choice). With a smaller value, a
/// robot that lifts a paw would tip onto that paw. A real robot does not tip, but leans away.
constexpr double kBalance = 0.02;

constexpr double kTolerance = 1e-6;

Vector3d toVector(const robot_model::Point& point) {
  return {point.x, point.y, point.z};
}

/// How far inside its supports the robot gets its weight when it leans, in metres (our choice).
constexpr double kLeaning = 0.005;

double above(const Floor& floor, const Vector3d& point) {
  return point.z() - floor.slope.dot(point.head<2>()) - floor.height;
}

double cross(const Vector3d& a, const Vector3d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Three supports in counterclockwise order.
struct Triangle {
  Triangle(const Vector3d& a, const Vector3d& b, const Vector3d& c)
      : corners{a, cross(b - a, c - a) > 0 ? b : c, cross(b - a, c - a) > 0 ? c : b} {}

  Vector3d normal() const { return (corners[1] - corners[0]).cross(corners[2] - corners[0]); }

  /// True if the supports are in line or above each other.
  bool isSteep() const { return normal().z() < kTolerance; }

  /// The distance of a point from a side, seen from above; positive inside.
  double inside(std::size_t line, const Vector3d& point) const {
    const Vector3d& from = corners[line];
    const Vector3d along = corners[(line + 1) % 3] - from;
    return cross(along, point - from) / along.head<2>().norm();
  }

  /// True if the body's origin is over the triangle, or at most kBalance beside it.
  bool carries() const {
    return std::min({inside(0, Vector3d::Zero()), inside(1, Vector3d::Zero()), inside(2, Vector3d::Zero())}) >=
           -kBalance;
  }

  Floor floor() const {
    const Vector3d up = normal();
    const Eigen::Vector2d slope = -up.head<2>() / up.z();
    return {slope, corners[0].z() - slope.dot(corners[0].head<2>())};
  }

  /// The body's origin, or a point towards the middle that is inside by kLeaning.
  Eigen::Vector2d weight() const {
    const Vector3d middle = (corners[0] + corners[1] + corners[2]) / 3;
    double share = 0;
    for (std::size_t line = 0; line < 3; ++line) {
      const double origin_inside = inside(line, Vector3d::Zero());
      if (origin_inside < kLeaning) {
        share = std::max(share, (kLeaning - origin_inside) / (inside(line, middle) - origin_inside));
      }
    }
    return (std::min(share, 1.0) * middle).head<2>();
  }

  std::array<Vector3d, 3> corners;
};

/// The pose of a body on this floor. The floor goes through the centres of its lowest supports.
Eigen::Isometry3d poseOver(const Floor& floor) {
  const Vector3d up = Vector3d(-floor.slope.x(), -floor.slope.y(), 1).normalized();
  const Vector3d ahead = (Vector3d::UnitX() - up.x() * up).normalized();
  Eigen::Matrix3d turn;
  turn << ahead.transpose(), up.cross(ahead).transpose(), up.transpose();
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.linear() = turn;
  pose.translation().z() = FOOT_RADIUS - floor.height * up.z();
  return pose;
}

}  // namespace

Vector3d footInBody(Leg leg, const LegAngles& angles) {
  return toVector(robot_model::findFoot(leg, angles));
}

Supports supportsOf(const std::array<LegAngles, kLegs>& legs) {
  Supports supports;
  for (std::size_t i = 0; i < kLegs; ++i) {
    const Leg leg = static_cast<Leg>(i);
    supports[i] = footInBody(leg, legs[i]);
    supports[kLegs + i] = toVector(robot_model::findBellyCorner(leg));
  }
  return supports;
}

Supports rolledBetween(const std::array<LegAngles, kLegs>& before, const std::array<LegAngles, kLegs>& now) {
  Supports rolled;
  rolled.fill(Vector3d::Zero());
  for (std::size_t i = 0; i < kLegs; ++i) {
    const Leg leg = static_cast<Leg>(i);
    rolled[i] =
        toVector(robot_model::findRolledWay(leg, now[i])) - toVector(robot_model::findRolledWay(leg, before[i]));
  }
  return rolled;
}

Floor floorUnder(const Supports& supports, const Eigen::Vector2d& slope) {
  Floor floor{slope, std::numeric_limits<double>::infinity()};
  for (const Vector3d& support : supports) {
    floor.height = std::min(floor.height, support.z() - slope.dot(support.head<2>()));
  }
  return floor;
}

// A plane is always found, because the corners of the belly are supports, too.
Rest restOn(const Supports& supports) {
  std::optional<Rest> best;
  for (std::size_t i = 0; i < supports.size(); ++i) {
    for (std::size_t j = i + 1; j < supports.size(); ++j) {
      for (std::size_t k = j + 1; k < supports.size(); ++k) {
        const Triangle triangle(supports[i], supports[j], supports[k]);
        if (triangle.isSteep() || !triangle.carries()) {
          continue;
        }
        const Floor floor = triangle.floor();
        if ((!best || floor.slope.norm() < best->floor.slope.norm()) &&
            std::all_of(supports.begin(), supports.end(),
                        [&](const Vector3d& support) { return above(floor, support) >= -kTolerance; })) {
          best = Rest{floor, triangle.weight()};
        }
      }
    }
  }
  const Eigen::Vector2d level = Eigen::Vector2d::Zero();
  return best.value_or(Rest{floorUnder(supports, level), level});
}

Stance stanceOver(const Floor& floor, const Supports& supports) {
  Stance stance;
  stance.body = poseOver(floor);
  for (std::size_t i = 0; i < kLegs; ++i) {
    stance.paw_down[i] = (stance.body * supports[i]).z() - FOOT_RADIUS <= kPawTravel;
  }
  return stance;
}

Stance standOn(const std::array<LegAngles, kLegs>& legs) {
  const Supports supports = supportsOf(legs);
  return stanceOver(restOn(supports).floor, supports);
}

}  // namespace simulated_ers7
