/// @file shapes.h
/// The solid shapes of things in the scene, with functions for a ray caster.
/// Lengths in metres. All functions are pure.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_SCENE_SHAPES_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_SCENE_SHAPES_H

#include <Eigen/Core>
#include <optional>
#include <variant>

namespace simulated_ers7 {

/// A half line.
struct Ray {
  Eigen::Vector3d origin;
  Eigen::Vector3d direction;  ///< of length 1

  Eigen::Vector3d at(double distance) const { return origin + distance * direction; }
};

/// All points within `radius` of the line from `start` to `end`. A sphere if both are the same point.
struct Capsule {
  Eigen::Vector3d start;
  Eigen::Vector3d end;
  double radius;
};

/// A box with faces parallel to the axes.
struct Box {
  Eigen::Vector3d center;
  Eigen::Vector3d half_size;
};

using Shape = std::variant<Capsule, Box>;

/// The point where a ray hits a shape.
struct ShapeHit {
  double distance;         ///< from the ray's origin
  Eigen::Vector3d normal;  ///< outwards, of length 1
};

/// The point where `ray` enters `shape`; nothing if it misses it, or if its origin is inside or beyond the shape.
std::optional<ShapeHit> intersect(const Ray& ray, const Shape& shape);

/// Distance from `point` to the surface of `shape`, negative inside.
double signedDistance(const Eigen::Vector3d& point, const Shape& shape);

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_SCENE_SHAPES_H
