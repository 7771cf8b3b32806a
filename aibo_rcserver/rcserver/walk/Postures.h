#ifndef AIBO_RCSERVER_RCSERVER_WALK_POSTURES_H
#define AIBO_RCSERVER_RCSERVER_WALK_POSTURES_H

#include "protocol/walk_requests.h"
#include "rcserver/walk/FallWatch.h"
#include "rcserver/walk/Gait.h"
#include "robot_model/legs.h"

/// Knows the leg angles of each posture, and the order of postures that leads to one of them from anywhere, so that the
/// robot never stands on folded legs.
///
/// Between standing and sitting, and between standing and lying, all joints move at once, and the feet slide over the
/// floor. All other routes are made of these two. From an unknown posture, the robot first lies down: it spreads its
/// legs until it lies on its belly, folds them without weight on them, and puts them down.
///
/// A robot that lies on a side rolls onto its belly: the legs below reach past its back, and then push against the
/// floor. If it lies on its back, the legs of one side reach past its back, so that it tips onto the other side.
class Postures {
 public:
  /// What the legs do at a time. The first values are those of protocol::version2::Posture.
  enum Stage {
    STAND = protocol::version2::POSTURE_STAND,
    SIT,
    REST,
    SPREAD,
    FOLD,
    TIP_LEFT,
    TIP_RIGHT,
    REACH_LEFT,
    REACH_RIGHT,
    PUSH_LEFT,
    PUSH_RIGHT,
    NUMBER_OF_STAGES
  };

  static const int MAX_ROUTE = 5;

  /// @param gait the gait, whose posture at zero velocity is standing
  explicit Postures(const Gait& gait);

  /// The angles of the four legs at the end of a stage, in the order of robot_model::Leg.
  const robot_model::LegAngles* Legs(int stage) const { return legs_[stage]; }

  /// True if this joint of a leg moves in a stage.
  /// @param number 0 rotator, 1 elevator, 2 knee
  static bool Moves(Stage stage, int number);

  /// True if the robot takes one of the postures in a stage, with its weight on its legs.
  static bool IsPosture(Stage stage) { return stage <= REST; }

  /// Finds the route to a posture.
  /// @param here the present angles of the four legs
  /// @param lies_down true if the robot has to lie down on the route
  /// @param[out] route room for MAX_ROUTE stages to go through one after the other; the last is the wanted posture
  /// @return the number of stages
  int FindRoute(const robot_model::LegAngles* here, protocol::version2::Posture wanted, bool lies_down,
                Stage* route) const;

  /// Finds the route from a side or the back onto the belly. Afterwards, the robot may lie on another side.
  /// @param verdict how the robot lies
  /// @param attempt 0, 1, 2, ...: from its back, the robot tips to one side, then to the other
  static int FindRouteToBelly(FallWatch::Verdict verdict, int attempt, Stage* route);

  /// True if the feet are below the body and near their places in a standing robot, so that it can stand up at once.
  bool Stands(const robot_model::LegAngles* here) const;

  /// True if the feet are near their places in this posture.
  bool Is(protocol::version2::Posture posture, const robot_model::LegAngles* here) const {
    return IsBetween(posture, posture, here);
  }

 private:
  bool IsBetween(protocol::version2::Posture from, protocol::version2::Posture to,
                 const robot_model::LegAngles* here) const;

  robot_model::LegAngles legs_[NUMBER_OF_STAGES][robot_model::NUMBER_OF_LEGS];
  robot_model::Point standing_feet_[robot_model::NUMBER_OF_LEGS];
};

#endif  // AIBO_RCSERVER_RCSERVER_WALK_POSTURES_H
