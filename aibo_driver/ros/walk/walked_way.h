/// @file walked_way.h
#ifndef AIBO_DRIVER_ROS_WALK_WALKED_WAY_H
#define AIBO_DRIVER_ROS_WALK_WALKED_WAY_H

#include <cstdint>
#include <optional>

#include "aibo_driver/motion_end.h"
#include "aibo_driver/motors_and_posture.h"
#include "aibo_driver/telemetry.h"
#include "ros/walk/odometry.h"
#include "ros/walk/walk_settings.h"

namespace aibo_driver::node {

/// The way that a robot has gone, from what its telemetry says.
///
/// It begins at 0, never jumps, and is never reset. Over a break of the connection the robot stays where it was last,
/// and so it does when it is carried: only the covariance says that it may be elsewhere.
///
/// From one thread at a time.
class WalkedWay {
 public:
  /// @param settings must outlive the object
  explicit WalkedWay(const WalkSettings& settings) : settings_(settings) {}

  /// @return false if the telemetry does not say how the robot walks
  bool update(const Telemetry& telemetry);

  /// The robot reports that something has ended. If it fell or was lifted, it may be anywhere. Of a robot that tells
  /// its posture, that counts instead.
  void motionEnded(const MotionEnd& end);

  /// The robot tells its posture. When it has fallen or is lifted, also while it stands, it may be anywhere.
  void update(const MotorsAndPosture& state);

  const Odometry& odometry() const { return odometry_; }

  /// With which it walked when it was measured last; the real one.
  WalkVelocity velocity() const { return last_ ? last_->velocity : WalkVelocity(); }

 private:
  /// What was measured last.
  struct Sample {
    WalkVelocity velocity;  ///< the real one
    std::uint64_t connection_number = 0;
    std::uint32_t frame_number = 0;
  };

  void advance(const Sample& last, const Sample& sample);

  const WalkSettings& settings_;
  Odometry odometry_;
  std::optional<Sample> last_;
  PostureNow posture_ = PostureNow::kUnknown;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_WALK_WALKED_WAY_H
