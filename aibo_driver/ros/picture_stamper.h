/// @file picture_stamper.h
#ifndef AIBO_DRIVER_PICTURE_STAMPER_H
#define AIBO_DRIVER_PICTURE_STAMPER_H

#include <ros/time.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <functional>
#include <mutex>

namespace aibo_driver {

/// Turns the arrival of a picture's first byte, on the steady clock, into the stamp of its messages, on ROS' clock.
///
/// Stamps of different pictures strictly increase. Only when ROS' clock itself is set back by more than kClockStep do
/// they follow it back: stamps that stood still for an hour after a correction of the clock would help nobody.
/// Every function may be called from any thread.
class PictureStamper {
 public:
  using SteadyTime = std::chrono::steady_clock::time_point;

  /// What is less than this is jitter between the two clocks, what is more means that somebody set ROS' clock.
  static constexpr std::chrono::seconds kClockStep{1};

  /// @param time_offset added to every stamp
  /// @param ros_now, steady_now the clocks
  explicit PictureStamper(std::chrono::nanoseconds time_offset, std::function<ros::Time()> ros_now = ros::Time::now,
                          std::function<SteadyTime()> steady_now = std::chrono::steady_clock::now);

  /// The stamp of the picture whose first byte arrived then. The same picture has the same stamp whenever it is asked
  /// for among the kRemembered latest. Never before the epoch, also while a simulated clock has not begun to run.
  ros::Time stamp(SteadyTime first_byte_time);

 private:
  static constexpr std::size_t kRemembered = 16;

  struct Stamped {
    SteadyTime first_byte_time;
    ros::Time stamp;
  };

  const std::chrono::nanoseconds time_offset_;
  const std::function<ros::Time()> ros_now_;
  const std::function<SteadyTime()> steady_now_;

  std::mutex mutex_;
  std::array<Stamped, kRemembered> latest_;  ///< a ring
  std::size_t count_ = 0;                    ///< of all stamps given
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_PICTURE_STAMPER_H
