#include "simulator/ers7/scene/shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace simulated_ers7 {
namespace {

using Eigen::Vector3d;

std::optional<ShapeHit> intersectSphere(const Ray& ray, const Vector3d& center, double radius) {
  const Vector3d offset = ray.origin - center;
  const double half_b = offset.dot(ray.direction);
  const double discriminant = half_b * half_b - offset.squaredNorm() + radius * radius;
  if (discriminant < 0) {
    return std::nullopt;
  }
  const double distance = -half_b - std::sqrt(discriminant);
  if (distance < 0) {
    return std::nullopt;
  }
  return ShapeHit{distance, (ray.at(distance) - center) / radius};
}

/// The lateral surface of a capsule, without its caps.
std::optional<ShapeHit> intersectMantle(const Ray& ray, const Capsule& capsule) {
  const Vector3d axis = capsule.end - capsule.start;
  const Vector3d offset = ray.origin - capsule.start;
  const double axis_axis = axis.squaredNorm();
  const double axis_direction = axis.dot(ray.direction);
  const double axis_offset = axis.dot(offset);
  const double a = axis_axis - axis_direction * axis_direction;
  if (a <= 0) {  // along the axis, a ray hits only the caps
    return std::nullopt;
  }
  const double half_b = axis_axis * offset.dot(ray.direction) - axis_offset * axis_direction;
  const double c = axis_axis * (offset.squaredNorm() - capsule.radius * capsule.radius) - axis_offset * axis_offset;
  const double discriminant = half_b * half_b - a * c;
  if (discriminant < 0) {
    return std::nullopt;
  }
  const double distance = (-half_b - std::sqrt(discriminant)) / a;
  const double along = (axis_offset + distance * axis_direction) / axis_axis;
  if (distance < 0 || along < 0 || along > 1) {
    return std::nullopt;
  }
  return ShapeHit{distance, (ray.at(distance) - (capsule.start + along * axis)) / capsule.radius};
}

std::optional<ShapeHit> nearer(const std::optional<ShapeHit>& left, const std::optional<ShapeHit>& right) {
  if (!left || (right && right->distance < left->distance)) {
    return right;
  }
  return left;
}

std::optional<ShapeHit> intersectShape(const Ray& ray, const Capsule& capsule) {
  const auto start_cap = intersectSphere(ray, capsule.start, capsule.radius);
  if (capsule.start == capsule.end) {
    return start_cap;
  }
  const auto caps = nearer(start_cap, intersectSphere(ray, capsule.end, capsule.radius));
  return nearer(caps, intersectMantle(ray, capsule));
}

std::optional<ShapeHit> intersectShape(const Ray& ray, const Box& box) {
  double enter = -std::numeric_limits<double>::infinity();
  double leave = std::numeric_limits<double>::infinity();
  int enter_axis = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double position = ray.origin[axis] - box.center[axis];
    const double speed = ray.direction[axis];
    if (speed == 0) {
      if (std::abs(position) > box.half_size[axis]) {
        return std::nullopt;
      }
      continue;
    }
    const double middle = -position / speed;
    const double half = box.half_size[axis] / std::abs(speed);
    if (middle - half > enter) {
      enter = middle - half;
      enter_axis = axis;
    }
    leave = std::min(leave, middle + half);
  }
  if (enter > leave || enter < 0) {
    return std::nullopt;
  }
  Vector3d normal = Vector3d::Zero();
  normal[enter_axis] = ray.direction[enter_axis] > 0 ? -1 : 1;
  return ShapeHit{enter, normal};
}

double distanceTo(const Vector3d& point, const Capsule& capsule) {
  const Vector3d axis = capsule.end - capsule.start;
  const Vector3d offset = point - capsule.start;
  const double length_squared = axis.squaredNorm();
  const double along = length_squared > 0 ? std::clamp(offset.dot(axis) / length_squared, 0.0, 1.0) : 0.0;
  return (offset - along * axis).norm() - capsule.radius;
}

double distanceTo(const Vector3d& point, const Box& box) {
  const Vector3d beyond = (point - box.center).cwiseAbs() - box.half_size;
  return beyond.cwiseMax(0).norm() + std::min(beyond.maxCoeff(), 0.0);
}

}  // namespace

std::optional<ShapeHit> intersect(const Ray& ray, const Shape& shape) {
  return std::visit([&ray](const auto& solid) { return intersectShape(ray, solid); }, shape);
}

double signedDistance(const Eigen::Vector3d& point, const Shape& shape) {
  return std::visit([&point](const auto& solid) { return distanceTo(point, solid); }, shape);
}

}  // namespace simulated_ers7
