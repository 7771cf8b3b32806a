/// @file robot_stamper.h
#ifndef AIBO_DRIVER_NODE_ROBOT_STAMPER_H
#define AIBO_DRIVER_NODE_ROBOT_STAMPER_H

#include <ros/time.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>

#include "aibo_client/camera.h"
#include "robot_time/robot_clock.h"

namespace aibo_driver::node {

/// Stamps the messages of one stream, as docs/ros_interface.md says ("Stamps"). A message without a frame number, such
/// as one from a version 1 server, has its time of arrival as stamp. No stamp is later than the arrival of its message,
/// even if the frame number is. The only exceptions are `time_offset`, and a few nanoseconds that distinguish messages
/// that arrive together.
///
/// The time is computed on the steady clock. It is converted to ROS' clock when the stamp is first asked for. If ROS'
/// clock is set back by more than kClockStep, the stamps follow it, because they would otherwise stand still until it
/// has caught up. Any thread may call any function.
class RobotStamper {
 public:
  using SteadyTime = std::chrono::steady_clock::time_point;

  /// The time at which the robot took a picture.
  struct Moment {
    ros::Time stamp;
    /// The same time on the steady clock, without `time_offset`. It is late by the shortest delay of a message
    /// (RobotClock). It has no value if the picture has no frame number, or if the robot's clock is not used.
    std::optional<SteadyTime> taken;
  };

  /// The smallest step of ROS' clock that counts as setting it. Smaller steps are jitter between the two clocks.
  static constexpr std::chrono::nanoseconds kClockStep = std::chrono::seconds(1);

  /// @param robot_clock must outlive the stamper; if it is null, the stamp of each message is its time of arrival
  /// @param time_offset added to every stamp
  /// @param ros_now, steady_now the clocks
  RobotStamper(robot_time::RobotClock* robot_clock, std::chrono::nanoseconds time_offset,
               std::function<ros::Time()> ros_now = ros::Time::now,
               std::function<SteadyTime()> steady_now = std::chrono::steady_clock::now);

  /// When the robot took the picture, and the stamp of its messages. The same picture gets the same stamp as long as it
  /// is among the kRemembered latest ones. A stamp is never before the epoch, even if a simulated clock has not begun
  /// to run.
  Moment momentOf(const aibo_client::Picture& picture) {
    return find(picture.connection_number, picture.frame_number, picture.first_byte_time);
  }

  /// The stamp of telemetry, of detected colours, or of the first sample of a sound.
  template <typename Report>
  ros::Time stamp(const Report& report) {
    return find(report.connection_number, report.frame_number, report.arrival).stamp;
  }

 private:
  static constexpr std::size_t kRemembered = 16;

  struct Stamped {
    SteadyTime arrival;
    std::optional<std::uint32_t> frame_number;  ///< distinguishes messages that arrive together
    Moment moment;
  };

  /// Finds the stamp among the latest ones, or computes it.
  Moment find(std::uint64_t connection_number, std::optional<std::uint32_t> frame_number, SteadyTime arrival);
  ros::Time toRosTime(SteadyTime time) const;

  robot_time::RobotClock* const robot_clock_;
  const std::chrono::nanoseconds time_offset_;
  const std::function<ros::Time()> ros_now_;
  const std::function<SteadyTime()> steady_now_;

  std::mutex mutex_;
  std::array<Stamped, kRemembered> latest_;  ///< a ring buffer
  std::size_t count_ = 0;                    ///< how many stamps have been given so far
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_ROBOT_STAMPER_H
