/// @file robot_stamper.h
#ifndef AIBO_DRIVER_ROS_ROBOT_STAMPER_H
#define AIBO_DRIVER_ROS_ROBOT_STAMPER_H

#include <ros/time.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>

#include "aibo_driver/colors.h"
#include "aibo_driver/picture.h"
#include "aibo_driver/telemetry.h"
#include "robot_time/robot_clock.h"

namespace aibo_driver::node {

/// Stamps the messages of one stream, pictures or telemetry, with the time on ROS' clock when the robot took or
/// measured them. A message without a frame number, as from a version 1 server, is stamped with its arrival. No stamp
/// is later than the arrival of its message, whatever the frame number says, except for the nanoseconds that tell
/// messages apart that arrive together, and for `time_offset`.
///
/// The time is computed on the steady clock and mapped to ROS' clock when the stamp is first asked for. So when ROS'
/// clock is set, the stamps follow at once; with a simulated clock they are as fine as its steps. Stamps of different
/// messages strictly increase. Only when ROS' clock is set back by more than kClockStep do they follow it back:
/// otherwise they would stand still until the clock has caught up. Every function may be called from any thread.
class RobotStamper {
 public:
  using SteadyTime = std::chrono::steady_clock::time_point;

  /// A smaller step is jitter between the two clocks; a bigger one means that somebody has set ROS' clock.
  static constexpr std::chrono::seconds kClockStep{1};

  /// @param robot_clock must outlive the stamper; null: every message is stamped with its arrival
  /// @param time_offset added to every stamp
  /// @param ros_now, steady_now the clocks
  RobotStamper(robot_time::RobotClock* robot_clock, std::chrono::nanoseconds time_offset,
               std::function<ros::Time()> ros_now = ros::Time::now,
               std::function<SteadyTime()> steady_now = std::chrono::steady_clock::now);

  /// The same picture gets the same stamp as long as it is among the kRemembered latest. Never before the epoch, even
  /// while a simulated clock has not begun to run.
  ros::Time stamp(const Picture& picture) {
    return stamp(picture.connection_number, picture.frame_number, picture.first_byte_time);
  }

  /// When the robot took the picture, on the steady clock, up to the shortest delay of a message (RobotClock). Nothing
  /// without a frame number or a clock of the robot.
  std::optional<SteadyTime> takenAt(const Picture& picture);

  /// As for a picture.
  ros::Time stamp(const Telemetry& telemetry) {
    return stamp(telemetry.connection_number, telemetry.frame_number, telemetry.arrival);
  }

  /// The same.
  ros::Time stamp(const DetectedColors& colors) {
    return stamp(colors.connection_number, colors.frame_number, colors.arrival);
  }

 private:
  static constexpr std::size_t kRemembered = 16;

  struct Stamped {
    SteadyTime arrival;
    std::optional<std::uint32_t> frame_number;  ///< distinguishes messages that arrive together
    SteadyTime taken;
    ros::Time stamp;
  };

  /// Computes what is not among the latest.
  Stamped find(std::uint64_t connection_number, std::optional<std::uint32_t> frame_number, SteadyTime arrival);
  ros::Time stamp(std::uint64_t connection_number, std::optional<std::uint32_t> frame_number, SteadyTime arrival);
  ros::Time toRosTime(SteadyTime time) const;

  robot_time::RobotClock* const robot_clock_;
  const std::chrono::nanoseconds time_offset_;
  const std::function<ros::Time()> ros_now_;
  const std::function<SteadyTime()> steady_now_;

  std::mutex mutex_;
  std::array<Stamped, kRemembered> latest_;  ///< a ring
  std::size_t count_ = 0;                    ///< stamps given so far
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_ROBOT_STAMPER_H
