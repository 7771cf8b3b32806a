/// @file walk_odometry.h
#ifndef AIBO_DRIVER_WALK_WALK_ODOMETRY_H
#define AIBO_DRIVER_WALK_WALK_ODOMETRY_H

#include <cstdint>
#include <optional>

#include "aibo_client/orders.h"
#include "aibo_client/telemetry.h"
#include "aibo_client/walk.h"
#include "walk/odometry.h"
#include "walk/walk_settings.h"

namespace aibo_driver::walk {

/// Where a robot has walked to, computed from its telemetry.
///
/// The position begins at 0, never jumps, and is never reset. If the connection breaks or somebody carries the robot,
/// the robot keeps its last position. Only the covariance says that the robot may be elsewhere.
///
/// Only one thread at a time may use an object of this class.
class WalkOdometry {
 public:
  /// @param settings must outlive the object
  explicit WalkOdometry(const WalkSettings& settings) : settings_(settings) {}

  /// @return false if the telemetry does not say how the robot walks
  bool update(const aibo_client::Telemetry& telemetry);

  /// Call this when the robot reports that a motion has ended. If the robot fell or was lifted, it may be anywhere. If
  /// the robot reports its posture, the posture counts instead.
  void motionEnded(const aibo_client::ActivityEnd& end);

  /// Call this when the robot reports its posture. A robot that has fallen or is lifted may be anywhere, even if it was
  /// only standing before.
  void update(const aibo_client::MotorsAndPosture& state);

  const Odometry& odometry() const { return odometry_; }

  /// The real velocity when the robot was measured last.
  aibo_client::WalkVelocity velocity() const { return last_ ? last_->velocity : aibo_client::WalkVelocity(); }

 private:
  /// The last measurement.
  struct Sample {
    aibo_client::WalkVelocity velocity;  ///< the real velocity
    std::uint64_t connection_number = 0;
    std::uint32_t frame_number = 0;
  };

  void advance(const Sample& last, const Sample& sample);

  const WalkSettings& settings_;
  Odometry odometry_;
  std::optional<Sample> last_;
  aibo_client::PostureNow posture_ = aibo_client::PostureNow::kUnknown;
};

}  // namespace aibo_driver::walk

#endif  // AIBO_DRIVER_WALK_WALK_ODOMETRY_H
