/// @file scene.h
/// The room around the simulated ERS-7, for camera and distance sensors.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_SCENE_SCENE_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_SCENE_SCENE_H

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "simulator/ers7/scene/shapes.h"

namespace simulated_ers7 {

/// Sizes and places are in metres, and times in seconds, in the frame of Scene. They are invented, but ball and bone
/// have about the size of the originals.

/// Opposite corners of the room.
constexpr double kLowestCorner[] = {-1.6, -1.9, 0};
constexpr double kHighestCorner[] = {3.2, 2.1, 2.5};

/// The soccer carpet: its centre, half its size, its lines.
constexpr double kCarpetX = 0.85;
constexpr double kCarpetHalfLength = 1.6;
constexpr double kCarpetHalfWidth = 1.25;
constexpr double kLineInset = 0.12;
constexpr double kLineHalfWidth = 0.0125;
constexpr double kCenterCircleRadius = 0.28;
constexpr double kPenaltyAreaDepth = 0.40;
constexpr double kPenaltyAreaHalfWidth = 0.55;

/// The ball on the halfway line.
constexpr double kBallRadius = 0.0425;
constexpr double kBallX = kCarpetX;
constexpr double kBallSwing = 0.16;
constexpr double kBallPeriod = 6.0;

/// The table, if the room has one: the middle of its top, half its size, and a board along its left side.
constexpr double kTableX = 0.2;
constexpr double kTableHalfLength = 0.8;
constexpr double kTableHalfWidth = 0.6;
constexpr double kTableHeight = 0.7;
constexpr double kBoardHeight = 0.3;  ///< above the table's top
constexpr double kBoardThickness = 0.02;

/// A part's material. light.h has its colours.
enum class Surface {
  kFloor,
  kWall,
  kCeiling,
  kBall,
  kBone,
  kStation,
  kStationDock,
  kStationPole,
  kBlueCube,
  kYellowCube,
  kWood
};

/// A shape of a body, in the body's frame.
struct Part {
  Shape shape;
  Surface surface;
};

/// An object on the floor, made of shapes that move together.
class Body {
 public:
  /// @param position the origin of the body's frame, in the room
  /// @param yaw the turn about the vertical, to the left, in radians
  Body(const Eigen::Vector3d& position, double yaw, std::vector<Part> parts);

  const Eigen::Vector3d& position() const { return position_; }
  void setPosition(const Eigen::Vector3d& position) { position_ = position; }

  /// The radius of the smallest ball around position() that contains the body.
  double reach() const { return reach_; }

  /// Height of the highest point in the room.
  double top() const { return position_.z() + top_; }

  const std::vector<Part>& parts() const { return parts_; }

  /// Conversions between the room's frame and the body's.
  Eigen::Vector3d pointToBody(const Eigen::Vector3d& point) const { return turnToBody(point - position_); }
  Eigen::Vector3d turnToBody(const Eigen::Vector3d& vector) const {
    return {cos_yaw_ * vector.x() + sin_yaw_ * vector.y(), cos_yaw_ * vector.y() - sin_yaw_ * vector.x(), vector.z()};
  }
  Eigen::Vector3d turnToRoom(const Eigen::Vector3d& vector) const {
    return {cos_yaw_ * vector.x() - sin_yaw_ * vector.y(), cos_yaw_ * vector.y() + sin_yaw_ * vector.x(), vector.z()};
  }

  /// Distance to the body's surface, negative inside.
  /// @param point a point in the body's frame
  double distanceInBody(const Eigen::Vector3d& point) const;

  /// Does the same for a point in the room.
  double signedDistance(const Eigen::Vector3d& point) const { return distanceInBody(pointToBody(point)); }

 private:
  Eigen::Vector3d position_;
  double cos_yaw_;
  double sin_yaw_;
  std::vector<Part> parts_;
  double reach_;
  double top_;
};

/// A set of bodies: bit i stands for bodies()[i]. The renderer skips bodies that do not matter.
using BodySet = std::uint8_t;

constexpr BodySet kAllBodies = 0xFF;

struct SceneHit {
  double distance;              ///< from the ray's origin
  Eigen::Vector3d point;        ///< in the room
  Eigen::Vector3d normal;       ///< has length 1, in the room, on the ray's side
  Eigen::Vector3d local_point;  ///< in the frame of the body
  Surface surface;
};

/// A living room with a small soccer carpet, a ball, a bone, a charging station and two toy cubes. It may have a table
/// over the origin, with a board along its left side.
///
/// x is the direction in which the robot looks at first, y is to its left, z is up, in metres. The floor is z = 0, and
/// the robot begins above the origin. The same time always gives the same scene. The class is not thread-safe.
class Scene {
 public:
  explicit Scene(bool has_table = false);

  /// Moves the ball, which rolls back and forth along the halfway line once in kBallPeriod.
  /// @param seconds since the robot was switched on
  void setTime(double seconds);

  /// The first hit of a ray from inside the room. There always is a hit, because the room is closed.
  /// @param among the bodies that count; the ray passes through all others
  SceneHit castRay(const Ray& ray, BodySet among = kAllBodies) const;

  /// At most eight bodies. The room itself is not one of them.
  const std::vector<Body>& bodies() const { return bodies_; }

  /// The point where a ray hits the same plane of the room as another ray.
  static SceneHit castRayAtPlane(const Ray& ray, const SceneHit& plane) {
    const double distance = (plane.point - ray.origin).dot(plane.normal) / ray.direction.dot(plane.normal);
    const Eigen::Vector3d point = ray.at(distance);
    return {distance, point, plane.normal, point, plane.surface};
  }

  /// Distance to the nearest body or wall, in metres; negative inside a body or beyond a wall. Floor, table and ceiling
  /// do not count.
  double clearance(const Eigen::Vector3d& point) const;

  /// The height of the table or floor at a place in the room, in metres.
  double groundAt(const Eigen::Vector2d& place) const;

  const Eigen::Vector3d& ballCenter() const;

 private:
  const bool has_table_;
  std::vector<Body> bodies_;
};

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_SCENE_SCENE_H
