/// @file Postures.h
/// The postures that the robot can take, and the safe ways between them.
#ifndef AIBO_RCSERVER_RCSERVER_WALK_POSTURES_H
#define AIBO_RCSERVER_RCSERVER_WALK_POSTURES_H

#include "protocol/walk_requests.h"
#include "rcserver/walk/Gait.h"
#include "robot_model/legs.h"

/// Knows the leg angles of each posture, and the order in which to take postures to get to one from anywhere, so that
/// the robot never stands on folded legs.
///
/// Between standing and sitting, and between standing and lying, all joints move at once, and the feet slide over the
/// floor. All other ways are made of these. From an unknown posture, the robot first lies down. Its legs slide apart,
/// so that the feet stay around the body all the way down.
class Postures {
 public:
  /// Most postures on a way.
  static const int MAX_WAY = 3;

  /// @param gait its posture at zero velocity is standing
  explicit Postures(const Gait& gait);

  /// The angles of the four legs in a posture, in the order of robot_model::Leg.
  const robot_model::LegAngles* Legs(protocol::version2::Posture posture) const { return legs_[posture]; }

  /// Finds the way to a posture.
  /// @param here the angles of the four legs now
  /// @param[out] way room for MAX_WAY postures to take one after the other; the last is the wanted one
  /// @return the number of postures
  int FindWay(const robot_model::LegAngles* here, protocol::version2::Posture wanted,
              protocol::version2::Posture* way) const;

  /// True if the feet are below the body and near their places in the stand, so that the robot can stand up at once.
  bool Stands(const robot_model::LegAngles* here) const;

  /// True if the feet are near their places in this posture.
  bool Is(protocol::version2::Posture posture, const robot_model::LegAngles* here) const {
    return IsBetween(posture, posture, here);
  }

 private:
  bool IsBetween(protocol::version2::Posture from, protocol::version2::Posture to,
                 const robot_model::LegAngles* here) const;

  robot_model::LegAngles legs_[protocol::version2::POSTURE_REST + 1][robot_model::NUMBER_OF_LEGS];
  robot_model::Point standing_feet_[robot_model::NUMBER_OF_LEGS];
};

#endif  // AIBO_RCSERVER_RCSERVER_WALK_POSTURES_H
