/// @file travel.h
/// Where the simulated robot is in its room, and how its legs take it there.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_BODY_TRAVEL_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_BODY_TRAVEL_H

#include <Eigen/Geometry>
#include <array>

#include "simulator/ers7/body/head_kinematics.h"
#include "simulator/ers7/body/stance.h"
#include "simulator/ers7/scene/scene.h"

namespace simulated_ers7 {

/// A place on the floor, in the room's frame (scene.h).
struct Place {
  double x = 0;    ///< metres
  double y = 0;    ///< metres
  double yaw = 0;  ///< radian to the left; grows beyond a full turn
};

/// What the robot lies on.
enum class Side { kFeet, kLeft, kRight, kBack };

/// Friction of feet and belly on the floor: no more than this part of the weight pushes the robot along. Our choice,
/// for rubber on a carpet.
constexpr double kFriction = 0.6;

/// The robot begins at rest over the room's origin and faces along x. The same movements always lead to the same place.
///
/// Feet (and the belly) that touch the floor stay where they are, so the body moves as the legs push it. Friction
/// limits how fast it speeds up, slows down and turns. Feet that pull against each other slip, and the strongest win:
/// in each frame the robot moves in the way that wastes the least energy in friction. What it would bump into, walls
/// and the bodies of the scene, stops it.
///
/// Simplifications: The weight is in the body's origin and does not move with the legs. Feet share it equally; one that
/// is up to kPawTravel over the floor bears less. Feet do not roll on their balls. Nothing bounces. The body tips as in
/// tipping.h; it never falls over by itself. Obstacles are felt by the trunk and the head only: the legs pass through
/// what is lower, and the ball is not pushed.
class Travel {
 public:
  Travel(const std::array<LegAngles, kLegs>& legs, const HeadAngles& head);

  /// 8 ms pass.
  /// @param legs,head their angles now
  /// @param scene what may stand in the way
  void passFrame(const std::array<LegAngles, kLegs>& legs, const HeadAngles& head, const Scene& scene);

  /// Somebody lifts the robot, which takes half a second, and holds it level, or sets it down in the same place.
  void lift(bool lifted) {
    is_lifted_ = lifted;
    is_settled_ = false;
  }

  /// The robot falls on a side or its back, or is put back on its feet; each takes half a second. It does not travel
  /// there, and its paws are not on the floor.
  void lie(Side side) {
    wanted_side_ = side;
    is_settled_ = false;
  }

  const Place& place() const { return place_; }

  /// The body in the room.
  const Stance& stance() const { return stance_; }

  /// The acceleration of the body in the room in m/s^2, without gravity. It is smoothed like that of a sensor with a
  /// bandwidth of 8 Hz, which is our choice: without that, each foot that touches the floor would be a blow.
  const Eigen::Vector3d& acceleration() const { return acceleration_; }

 private:
  /// How far the body moves in a frame, along x and y of its own, and how far it turns.
  using Step = Eigen::Vector3d;

  /// What is felt when it bumps into something: the middles of balls around chest, rump and head, in the room.
  using Bumpers = std::array<Eigen::Vector3d, 3>;

  bool isOnFeet() const { return held_ == 0 && raised_ == 0; }
  void travel(const std::array<LegAngles, kLegs>& legs, const HeadAngles& head, const Scene& scene);
  void passFrameOfHolding();
  Eigen::Isometry3d poseInPlace() const;
  Step push(const Supports& before, const Supports& now) const;
  void move(const Step& step);
  Bumpers bumpers() const;
  void stopAtObstacles(const Bumpers& before, const Scene& scene);
  void feelAcceleration(const Eigen::Vector3d& before);

  std::array<LegAngles, kLegs> legs_;
  Supports supports_;  ///< in the body
  HeadAngles head_;
  Floor floor_;
  Place place_;
  Stance stance_;
  Step step_ = Step::Zero();  ///< of the last frame
  Eigen::Vector3d velocity_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d acceleration_ = Eigen::Vector3d::Zero();
  bool is_settled_ = false;  ///< the last frame changed nothing, so neither does the next one if no joint moves

  bool is_lifted_ = false;
  Side wanted_side_ = Side::kFeet;
  Eigen::Quaterniond hold_ = Eigen::Quaterniond::Identity();  ///< attitude in which it is held, or lies
  Side side_ = Side::kFeet;                                   ///< of hold_
  double held_ = 0;                                           ///< 0: stands freely, 1: is in the attitude hold_
  double raised_ = 0;                                         ///< metres
};

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_BODY_TRAVEL_H
