#ifndef AIBO_RCSERVER_RCSERVER_WALK_WALK_PACE_H
#define AIBO_RCSERVER_RCSERVER_WALK_WALK_PACE_H

#include "protocol/walk_requests.h"
#include "rcserver/walk/FallWatch.h"
#include "rcserver/walk/Gait.h"
#include "robot_model/legs.h"

/// Decides, frame by frame, how a walking robot puts its feet.
///
/// The velocity approaches the wanted one by SPEED_CHANGE. Motors lag and yield, so the legs walk at a different
/// velocity from the one commanded. This velocity is measured, and the command is made faster, slower or more to one
/// side until the measured velocity is the wanted one. The accelerometer tells to which side the robot leans, and the
/// feet are placed nearer to that side.
class WalkPace {
 public:
  explicit WalkPace(const Gait& gait) : gait_(gait), now_() {}

  /// Begins a walk. The robot must be standing.
  void Begin() { now_ = State(); }

  /// Finds the angles of the legs for the next frame.
  /// @param wanted the velocity to approach; 0 if the walk ends
  /// @param ends true: the walk ends when the robot stands
  /// @param[out] legs in the order of robot_model::Leg; unchanged if the walk has ended
  /// @return false if the walk has ended
  bool NextFrame(const protocol::version2::Velocity& wanted, bool ends, robot_model::LegAngles* legs);

  /// Call this for each report of the sensors.
  /// @param walked the velocity that was measured
  /// @param frames number of frames since the last report
  void Measured(const protocol::version2::Velocity& walked, const FallWatch::Reading& reading, unsigned frames);

  /// The velocity that is commanded now, without the correction.
  const protocol::version2::Velocity& Commanded() const { return now_.velocity; }

  /// The phase of the step, 0..1.
  double Phase() const { return now_.phase; }

 private:
  // A walk begins with zeros.
  struct State {
    protocol::version2::Velocity velocity;
    protocol::version2::Velocity expected;    ///< what should be measured now
    protocol::version2::Velocity missing;     ///< the part of it that is not measured, smoothed
    protocol::version2::Velocity correction;  ///< added to `velocity`, so that `velocity` is measured
    robot_model::Point lean;                  ///< radian; to the front and to the left, beyond what should be, smoothed
    robot_model::Point shift;                 ///< how far the feet are shifted to where the robot leans
    double effort;
    double phase;
  };

  void ChangeVelocity(const protocol::version2::Velocity& wanted, bool ends);
  void CorrectVelocity();
  void CompareVelocity(const protocol::version2::Velocity& walked, double seconds);
  void FeelLean(const FallWatch::Reading& reading, double seconds);

  const Gait& gait_;
  State now_;
};

#endif  // AIBO_RCSERVER_RCSERVER_WALK_WALK_PACE_H
