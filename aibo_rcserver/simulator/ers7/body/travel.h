/// @file travel.h
/// The simulated robot's place in its room, and its movement by its legs.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_BODY_TRAVEL_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_BODY_TRAVEL_H

#include <Eigen/Geometry>
#include <array>

#include "simulator/ers7/body/head_kinematics.h"
#include "simulator/ers7/body/stance.h"
#include "simulator/ers7/scene/scene.h"

namespace simulated_ers7 {

/// A place in the room's frame (scene.h).
struct Place {
  double x = 0;    ///< metres
  double y = 0;    ///< metres
  double yaw = 0;  ///< radians to the left; not limited to a full turn
};

/// The side on which the robot lies or stands.
enum class Side { kFeet, kLeft, kRight, kBack };

/// The friction of feet and belly, as the largest share of the weight that pushes the robot along. Our choice, for
/// rubber on a carpet.
constexpr double kFriction = 0.6;

/// The robot begins at rest over the room's origin and faces along x. The same movements always lead to the same place.
///
/// Feet roll, and belly and feet stay where they touch the floor, so the legs push the body. Friction limits how fast
/// the body speeds up, slows down and turns. Feet that pull against each other slip: in each frame, the robot moves so
/// that friction takes as little energy as possible. Walls and the scene's bodies stop the robot.
///
/// On a table, a foot beyond the edge carries nothing. If the body then tips too far, or its weight is beyond the edge,
/// the robot falls off, and lies on its side on the floor.
///
/// Simplifications: The weight stays in the body's origin. The feet share it equally, but a foot up to kPawTravel above
/// the floor carries less. Nothing bounces. The body tips (stance.h) but never falls over by itself.
/// Only trunk and head collide with obstacles. The legs pass through lower things, and nothing pushes the ball.
class Travel {
 public:
  /// @param ground height of the table or floor under it, in metres
  Travel(const std::array<LegAngles, kLegs>& legs, const HeadAngles& head, double ground = 0);

  /// Call this after each frame of 8 ms.
  /// @param legs,head the present angles of legs and head
  /// @param scene the scene, which may have obstacles
  void passFrame(const std::array<LegAngles, kLegs>& legs, const HeadAngles& head, const Scene& scene);

  /// Lifts the robot and holds it level, or sets it down in the same place. Either takes half a second.
  void lift(bool lifted) {
    is_lifted_ = lifted;
    is_settled_ = false;
  }

  /// Drops the robot on a side or its back, or puts it back on its feet. Either takes half a second. A lying robot does
  /// not travel, and its paws are not on the floor.
  void lie(Side side) {
    wanted_side_ = side;
    is_settled_ = false;
  }

  const Place& place() const { return place_; }

  const Stance& stance() const { return stance_; }

  /// True from the moment at which the robot falls off a table.
  bool hasFallenOff() const { return has_fallen_off_; }

  /// True while a foot or a part of the belly is beyond an edge.
  bool isOverEdge() const { return is_beyond_edge_; }

  /// True while something stops the body.
  bool isStopped() const { return is_stopped_; }

  /// The body's acceleration in the room, in m/s^2, without gravity. It is smoothed to a bandwidth of 8 Hz (our
  /// choice); without this, each foot that touches the floor would cause a spike.
  const Eigen::Vector3d& acceleration() const { return acceleration_; }

 private:
  /// The body's movement in a frame: along its own x and y, and its turn.
  using Step = Eigen::Vector3d;

  /// The centres of balls around chest, rump and head, in the room.
  using Bumpers = std::array<Eigen::Vector3d, 3>;

  bool isOnFeet() const { return held_ == 0 && raised_ == 0; }
  bool isOverEdge(const Eigen::Vector2d& place, const Scene& scene) const { return scene.groundAt(place) < ground_; }
  void loseGround(const Scene& scene);
  void fallOff(const Scene& scene);
  void travel(const std::array<LegAngles, kLegs>& legs, const HeadAngles& head, const Scene& scene);
  void passFrameOfHolding();
  Eigen::Isometry3d poseInPlace() const;
  Step push(const Supports& before, const Supports& now, const Supports& rolled) const;
  void move(const Step& step);
  Bumpers bumpers() const;
  void stopAtObstacles(const Bumpers& before, const Scene& scene);
  void feelAcceleration(const Eigen::Vector3d& before);

  std::array<LegAngles, kLegs> legs_;
  Supports supports_;            ///< in the body's frame; a support beyond an edge is moved away from the floor
  double ground_;                ///< height of what the robot stands on, in metres
  bool is_beyond_edge_ = false;  ///< a support is beyond an edge
  bool has_fallen_off_ = false;
  bool is_stopped_ = false;
  HeadAngles head_;
  Floor floor_;
  Place place_;
  Stance stance_;
  Step step_ = Step::Zero();
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d acceleration_ = Eigen::Vector3d::Zero();
  bool is_settled_ = false;  ///< nothing changes until a joint moves

  bool is_lifted_ = false;
  Side wanted_side_ = Side::kFeet;
  Eigen::Quaterniond hold_ = Eigen::Quaterniond::Identity();  ///< the attitude of the held or lying robot
  Side side_ = Side::kFeet;                                   ///< the side that hold_ is for
  double held_ = 0;                                           ///< 0: it stands freely; 1: it has the attitude hold_
  double raised_ = 0;                                         ///< metres
};

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_BODY_TRAVEL_H
