/// @file robot_clock.h
#ifndef AIBO_DRIVER_ROBOT_TIME_ROBOT_CLOCK_H
#define AIBO_DRIVER_ROBOT_TIME_ROBOT_CLOCK_H

#include <chrono>
#include <cstdint>
#include <mutex>

#include "robot_time/delay_floor.h"

namespace aibo_driver::robot_time {

/// Maps OPEN-R frame numbers to the steady clock of this computer: when the robot took a picture or measured something.
/// A frame is 8 ms (OPEN-R Level 2 Reference Guide, OVirtualRobotComm). The radio delays each message by a different
/// time, which does not affect its frame number.
///
/// - The times keep the intervals of the frame numbers. Corrections are gradual, and the times always grow with the
///   frame numbers, by at least half of the frames' own time. They jump only where a new timeline begins.
/// - No time is later than the arrival of its message, unless the time of an earlier frame already was.
/// - The times are late by the shortest delay that any message has met, a few milliseconds, which cannot be measured
///   from here. Until the first messages without delay have come, for a second or so, they are late by more.
/// - A new timeline begins when the robot was restarted: frame numbers of a new connection go back or do not fit. It
///   also begins when a message comes a second too early, as after this computer was suspended, and when all messages
///   of 5 s come more than a second too late.
///
/// Every function may be called from any thread.
class RobotClock {
 public:
  using SteadyTime = std::chrono::steady_clock::time_point;

  /// What happened since the reading before.
  struct Reading {
    std::uint64_t messages = 0;   ///< with a frame number
    double mean_delay = 0;        ///< s, beyond the shortest delay; 0 without messages
    double longest_delay = 0;     ///< s
    double drift = 0;             ///< how much faster the steady clock runs than the robot's: 1e-6 is 1 ppm
    std::uint64_t timelines = 0;  ///< begun so far, in all
  };

  /// The time of a frame. To be called once for each message with a frame number, as soon as it has come.
  /// @param connection_number as in Telemetry and Picture
  /// @param frame_number OPEN-R frame; it may wrap around
  /// @param arrival of the message's first byte
  SteadyTime timeOf(std::uint64_t connection_number, std::uint32_t frame_number, SteadyTime arrival);

  Reading read();

 private:
  bool beginsTimeline(std::uint64_t connection_number, std::int32_t frames_passed, double delay, SteadyTime arrival);
  void begin(std::uint32_t frame_number, SteadyTime arrival);
  void advance(std::uint32_t frame_number, double passed, double lateness);
  void count(double delay);

  std::mutex mutex_;
  std::uint64_t connection_number_ = 0;
  SteadyTime begin_;                ///< arrival of the timeline's first message
  std::uint32_t newest_frame_ = 0;  ///< the highest so far
  double newest_ = 0;               ///< s, by the robot's clock, from the first message to the newest frame
  double lateness_ = 0;             ///< s: the newest frame's time is begin_ + newest_ + lateness_
  SteadyTime last_in_time_;         ///< arrival of the last message that was not too late
  DelayFloor floor_;
  Reading current_;
  double delay_sum_ = 0;
};

}  // namespace aibo_driver::robot_time

#endif  // AIBO_DRIVER_ROBOT_TIME_ROBOT_CLOCK_H
