/// @file shapes.h
/// Solid shapes for a ray caster, in metres.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_SCENE_SHAPES_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_SCENE_SHAPES_H

#include <Eigen/Core>
#include <optional>
#include <variant>

namespace simulated_ers7 {

struct Ray {
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;  ///< has length 1

  Eigen::Vector3d at(double distance) const { return origin + distance * direction; }
};

/// All points within `radius` of the line from `start` to `end`; a sphere if these are the same.
struct Capsule {
  Eigen::Vector3d start;
  Eigen::Vector3d end;
  double radius;
};

/// A box that is parallel to the axes.
struct Box {
  Eigen::Vector3d center;
  Eigen::Vector3d half_size;
};

using Shape = std::variant<Capsule, Box>;

struct ShapeHit {
  double distance;         ///< from the ray's origin
  Eigen::Vector3d normal;  ///< outwards, of length 1
};

/// Where `ray` enters `shape`; empty if it misses the shape or begins inside it or beyond it.
std::optional<ShapeHit> intersect(const Ray& ray, const Shape& shape);

/// The distance of a point from the surface; negative inside.
double signedDistance(const Eigen::Vector3d& point, const Shape& shape);

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_SCENE_SHAPES_H
