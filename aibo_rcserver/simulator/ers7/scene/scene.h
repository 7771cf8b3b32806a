/// @file scene.h
/// The room around the simulated ERS-7, for its camera and its distance sensors.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_SCENE_SCENE_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_SCENE_SCENE_H

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "simulator/ers7/scene/shapes.h"

namespace simulated_ers7 {

/// @name Where things are
/// Metres and seconds, in the frame of Scene. Nothing here is measured, but ball and bone are about as large as those
/// that came with the robot.
/// @{

/// The two opposite corners of the room, between walls, floor and ceiling.
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
/// @}

/// The material of a part. light.h has its colours.
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
  kYellowCube
};

/// One shape of a body, in the body's own frame.
struct Part {
  Shape shape;
  Surface surface;
};

/// A thing on the floor: shapes that move together.
class Body {
 public:
  /// @param position of the origin of its frame in the room
  /// @param yaw rotation about the vertical to the left, in radian
  Body(const Eigen::Vector3d& position, double yaw, std::vector<Part> parts);

  const Eigen::Vector3d& position() const { return position_; }
  void setPosition(const Eigen::Vector3d& position) { position_ = position; }

  /// Radius of the ball around position() that contains the whole body.
  double reach() const { return reach_; }

  /// Height of its highest point in the room.
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

  /// Distance from a point to the body's surface, negative inside.
  /// @param point in the body's frame
  double distanceInBody(const Eigen::Vector3d& point) const;

  /// The same from a point of the room.
  double signedDistance(const Eigen::Vector3d& point) const { return distanceInBody(pointToBody(point)); }

 private:
  Eigen::Vector3d position_;
  double cos_yaw_;
  double sin_yaw_;
  std::vector<Part> parts_;
  double reach_;
  double top_;
};

/// A choice of bodies: bit i stands for bodies()[i]. It spares the renderer those that cannot matter.
using BodySet = std::uint8_t;

constexpr BodySet kAllBodies = 0xFF;

/// The end of a ray.
struct SceneHit {
  double distance;              ///< from the ray's origin
  Eigen::Vector3d point;        ///< in the room
  Eigen::Vector3d normal;       ///< of length 1, in the room, on the side of the ray's origin
  Eigen::Vector3d local_point;  ///< in the frame of the body that was hit
  Surface surface;
};

/// A living room with a small soccer carpet, a ball, a bone, a charging station and two toy cubes.
///
/// The frame: x in the direction in which the robot looks at first, y to its left, z up, metres. The floor is z = 0,
/// and the robot's body is over the origin. The same time always gives the same scene. Not thread-safe.
class Scene {
 public:
  Scene();

  /// Moves the ball, which rolls to and fro along the halfway line once in kBallPeriod.
  /// @param seconds since the robot was switched on
  void setTime(double seconds);

  /// The first thing that a ray from inside the room hits. The room is closed, so there always is one.
  /// @param among bodies that it may hit; it passes through the others
  SceneHit castRay(const Ray& ray, BodySet among = kAllBodies) const;

  /// Everything in the room except the room itself, at most eight bodies.
  const std::vector<Body>& bodies() const { return bodies_; }

  /// Where a ray leaves the room through a plane, given where another ray does.
  static SceneHit castRayAtPlane(const Ray& ray, const SceneHit& plane) {
    const double distance = (plane.point - ray.origin).dot(plane.normal) / ray.direction.dot(plane.normal);
    const Eigen::Vector3d point = ray.at(distance);
    return {distance, point, plane.normal, point, plane.surface};
  }

  /// Distance from a point in the room to the nearest body or wall, in metres; negative inside of a body or beyond a
  /// wall. Floor and ceiling do not count.
  double clearance(const Eigen::Vector3d& point) const;

  /// The current centre of the ball.
  const Eigen::Vector3d& ballCenter() const;

 private:
  std::vector<Body> bodies_;
};

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_SCENE_SCENE_H
