/// @file scene.h
/// The room that the simulated ERS-7 lives in: what its camera sees and what its distance sensors measure.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_SCENE_SCENE_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_SCENE_SCENE_H

#include <Eigen/Core>
#include <vector>

#include "simulator/ers7/scene/shapes.h"

namespace simulated_ers7 {

/// What something is made of. Colours are the business of surface_colors.h.
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

/// A thing that stands or lies on the floor: shapes that move together.
class Body {
 public:
  /// @param position where the origin of its frame is in the room
  /// @param yaw how far it is turned about the vertical, in radian, to the left
  Body(const Eigen::Vector3d& position, double yaw, std::vector<Part> parts);

  const Eigen::Vector3d& position() const { return position_; }
  void setPosition(const Eigen::Vector3d& position) { position_ = position; }

  /// Radius of the ball around position() that holds all of the body.
  double reach() const { return reach_; }

  /// Height of its highest point in the room.
  double top() const { return position_.z() + top_; }

  const std::vector<Part>& parts() const { return parts_; }

  /// Between the room's frame and the body's.
  Eigen::Vector3d pointToBody(const Eigen::Vector3d& point) const { return turnToBody(point - position_); }
  Eigen::Vector3d turnToBody(const Eigen::Vector3d& vector) const;
  Eigen::Vector3d turnToRoom(const Eigen::Vector3d& vector) const;

  /// Distance from a point of the room to the body's surface, negative inside.
  double signedDistance(const Eigen::Vector3d& point) const;

 private:
  Eigen::Vector3d position_;
  double cos_yaw_;
  double sin_yaw_;
  std::vector<Part> parts_;
  double reach_;
  double top_;
};

/// Where a ray ends.
struct SceneHit {
  double distance;              ///< from the ray's origin
  Eigen::Vector3d point;        ///< in the room
  Eigen::Vector3d normal;       ///< of length 1, in the room, towards the side the ray came from
  Eigen::Vector3d local_point;  ///< in the frame of what was hit
  Surface surface;
};

/// A living room with a small soccer carpet, a ball, a bone, a charging station and two toy cubes.
///
/// The frame: x to where the robot looks at first, y to its left, z up, metres; the floor is z = 0 and the robot's
/// body stands over the origin. The same time always gives the same scene. Not thread-safe.
class Scene {
 public:
  Scene();

  /// Moves what moves: the ball rolls to and fro along the halfway line, once in kBallPeriod.
  /// @param seconds since the robot was switched on
  void setTime(double seconds);

  /// What a ray from inside the room meets first; as the room is closed, there always is something.
  SceneHit castRay(const Ray& ray) const;

  /// Everything in the room but the room itself.
  const std::vector<Body>& bodies() const { return bodies_; }

  /// Middle of the ball, now.
  const Eigen::Vector3d& ballCenter() const;

 private:
  std::vector<Body> bodies_;
};

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_SCENE_SCENE_H
