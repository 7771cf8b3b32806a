#include "simulator/ers7/scene/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace simulated_ers7 {
namespace {

using Eigen::Vector3d;

const double kPi = std::acos(-1.0);

double reachOf(const Capsule& capsule) {
  return std::max(capsule.start.norm(), capsule.end.norm()) + capsule.radius;
}

double reachOf(const Box& box) {
  return (box.center.cwiseAbs() + box.half_size).norm();
}

double topOf(const Capsule& capsule) {
  return std::max(capsule.start.z(), capsule.end.z()) + capsule.radius;
}

double topOf(const Box& box) {
  return box.center.z() + box.half_size.z();
}

Capsule sphere(const Vector3d& center, double radius) {
  return {center, center, radius};
}

Body makeBall() {
  return Body({kBallX, 0, kBallRadius}, 0, {{sphere(Vector3d::Zero(), kBallRadius), Surface::kBall}});
}

Body makeBone() {
  const double knob = 0.021;
  const double shaft = 0.012;
  const double half_length = 0.052;
  const double spread = 0.016;
  std::vector<Part> parts = {{Capsule{{-half_length, 0, 0}, {half_length, 0, 0}, shaft}, Surface::kBone}};
  for (const double end : {-half_length, half_length}) {
    for (const double side : {-spread, spread}) {
      parts.push_back({sphere({end, side, 0}, knob), Surface::kBone});
    }
  }
  return Body({0.64, -0.13, knob}, 1.0, std::move(parts));
}

const Vector3d kStation(1.42, 0.42, 0);
constexpr double kStationYaw = 0.45;

/// A plate on which the robot lies, with a dock for its belly.
Body makeStation() {
  return Body(kStation, kStationYaw,
              {{Box{{0, 0, 0.012}, {0.15, 0.13, 0.012}}, Surface::kStation},
               {Box{{0.02, 0, 0.040}, {0.09, 0.055, 0.016}}, Surface::kStationDock},
               {Box{{0.12, 0, 0.060}, {0.028, 0.085, 0.036}}, Surface::kStation}});
}

/// The pole behind the station guides the robot home.
Body makeStationPole() {
  const double half_length = 0.105;
  const double foot = 0.09;
  const Vector3d position =
      kStation + Vector3d(0.12 * std::cos(kStationYaw), 0.12 * std::sin(kStationYaw), foot + half_length);
  return Body(position, kStationYaw,
              {{Capsule{{0, 0, -half_length}, {0, 0, half_length}, 0.018}, Surface::kStationPole}});
}

Body makeCube(double x, double y, double yaw, double size, Surface surface) {
  return Body({x, y, size / 2}, yaw, {{Box{Vector3d::Zero(), Vector3d::Constant(size / 2)}, surface}});
}

/// The table. The origin of its frame is in the middle of its top.
Body makeTable() {
  const double top = 0.02;  // half its thickness
  const double leg = 0.025;
  const double length = (kTableHeight - 2 * top) / 2;
  std::vector<Part> parts = {{Box{{0, 0, -top}, {kTableHalfLength, kTableHalfWidth, top}}, Surface::kWood}};
  for (const double x : {leg - kTableHalfLength, kTableHalfLength - leg}) {
    for (const double y : {leg - kTableHalfWidth, kTableHalfWidth - leg}) {
      parts.push_back({Box{{x, y, length - kTableHeight}, {leg, leg, length}}, Surface::kWood});
    }
  }
  return Body({kTableX, 0, kTableHeight}, 0, std::move(parts));
}

Body makeBoard() {
  const Vector3d half_size(kTableHalfLength, kBoardThickness / 2, kBoardHeight / 2);
  return Body({kTableX, kTableHalfWidth - half_size.y(), kTableHeight + half_size.z()}, 0,
              {{Box{Vector3d::Zero(), half_size}, Surface::kWood}});
}

/// Indices of bodies in bodies_.
constexpr size_t kBall = 0;
constexpr size_t kTable = 6;

SceneHit castRayAtRoom(const Ray& ray) {
  double distance = std::numeric_limits<double>::infinity();
  int hit_axis = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double speed = ray.direction[axis];
    if (speed == 0) {
      continue;
    }
    const double end = speed > 0 ? kHighestCorner[axis] : kLowestCorner[axis];
    const double there = (end - ray.origin[axis]) / speed;
    if (there < distance) {
      distance = there;
      hit_axis = axis;
    }
  }
  const bool ahead = ray.direction[hit_axis] > 0;
  Vector3d normal = Vector3d::Zero();
  normal[hit_axis] = ahead ? -1 : 1;
  const Surface surface = hit_axis != 2 ? Surface::kWall : ahead ? Surface::kCeiling : Surface::kFloor;
  const Vector3d point = ray.at(distance);
  return {distance, point, normal, point, surface};
}

}  // namespace

Body::Body(const Vector3d& position, double yaw, std::vector<Part> parts)
    : position_(position),
      cos_yaw_(std::cos(yaw)),
      sin_yaw_(std::sin(yaw)),
      parts_(std::move(parts)),
      reach_(0),
      top_(-std::numeric_limits<double>::infinity()) {
  for (const Part& part : parts_) {
    reach_ = std::max(reach_, std::visit([](const auto& shape) { return reachOf(shape); }, part.shape));
    top_ = std::max(top_, std::visit([](const auto& shape) { return topOf(shape); }, part.shape));
  }
}

double Body::distanceInBody(const Vector3d& point) const {
  double distance = std::numeric_limits<double>::infinity();
  for (const Part& part : parts_) {
    distance = std::min(distance, simulated_ers7::signedDistance(point, part.shape));
  }
  return distance;
}

Scene::Scene(bool has_table)
    : has_table_(has_table),
      bodies_{makeBall(),
              makeBone(),
              makeStation(),
              makeStationPole(),
              makeCube(2.05, -0.62, 0.5, 0.14, Surface::kBlueCube),
              makeCube(2.20, -0.40, -0.2, 0.11, Surface::kYellowCube)} {
  if (has_table_) {
    bodies_.insert(bodies_.end(), {makeTable(), makeBoard()});
  }
  setTime(0);
}

void Scene::setTime(double seconds) {
  const double y = kBallSwing * std::sin(2 * kPi * seconds / kBallPeriod);
  bodies_[kBall].setPosition({kBallX, y, kBallRadius});
}

const Vector3d& Scene::ballCenter() const {
  return bodies_[kBall].position();
}

double Scene::clearance(const Vector3d& point) const {
  double clearance = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 2; ++axis) {
    clearance = std::min({clearance, point[axis] - kLowestCorner[axis], kHighestCorner[axis] - point[axis]});
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const Body& body = bodies_[i];
    if (i != kTable && (body.position() - point).norm() - body.reach() < clearance) {
      clearance = std::min(clearance, body.signedDistance(point));
    }
  }
  return clearance;
}

double Scene::groundAt(const Eigen::Vector2d& place) const {
  const bool is_on_table =
      has_table_ && std::abs(place.x() - kTableX) <= kTableHalfLength && std::abs(place.y()) <= kTableHalfWidth;
  return is_on_table ? kTableHeight : 0;
}

SceneHit Scene::castRay(const Ray& ray, BodySet among) const {
  SceneHit nearest = castRayAtRoom(ray);
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    if ((among >> i & 1) == 0) {
      continue;
    }
    const Body& body = bodies_[i];
    const Vector3d to_body = body.position() - ray.origin;
    const double along = to_body.dot(ray.direction);
    if (to_body.squaredNorm() - along * along > body.reach() * body.reach()) {
      continue;  // the ray misses the body
    }
    const Ray local{-body.turnToBody(to_body), body.turnToBody(ray.direction)};
    for (const Part& part : body.parts()) {
      const auto hit = intersect(local, part.shape);
      if (hit && hit->distance < nearest.distance) {
        nearest = {hit->distance, ray.at(hit->distance), body.turnToRoom(hit->normal), local.at(hit->distance),
                   part.surface};
      }
    }
  }
  return nearest;
}

}  // namespace simulated_ers7
