/// @file robot_clock.h
#ifndef AIBO_DRIVER_ROBOT_TIME_ROBOT_CLOCK_H
#define AIBO_DRIVER_ROBOT_TIME_ROBOT_CLOCK_H

#include <chrono>
#include <cstdint>
#include <mutex>

#include "robot_time/delay_floor.h"

namespace aibo_driver::robot_time {

/// Maps OPEN-R frame numbers to the steady clock of this computer. So we know when the robot took a picture or measured
/// something. A frame is 8 ms (OPEN-R Level 2 Reference Guide, OVirtualRobotComm). The radio delays each message by a
/// different time, but that does not affect the message's frame number.
///
/// - The times keep the intervals of the frame numbers. Corrections are gradual. The times always grow with the frame
///   numbers, by at least half of the frames' own time. They jump only where a new timeline begins.
/// - No time is later than the arrival of its message, unless the time of an earlier frame already is.
/// - The times are late by the shortest delay that any message has met. This delay is a few milliseconds, and cannot be
///   measured from here. The times are late by more until the first messages without delay have come, which takes a
///   second or so.
/// - A new timeline begins when the robot was restarted: the frame numbers of a new connection go back or do not fit.
///   It also begins when a message comes a second too early, for example after this computer was suspended, and when
///   all messages of 5 s come more than a second too late.
///
/// All functions may be called from any thread.
class RobotClock {
 public:
  using SteadyTime = std::chrono::steady_clock::time_point;

  /// What happened since the last reading.
  struct Reading {
    std::uint64_t messages = 0;   ///< messages with a frame number
    double mean_delay = 0;        ///< s, in addition to the shortest delay; 0 without messages
    double longest_delay = 0;     ///< s
    double drift = 0;             ///< how much faster the steady clock runs than the robot's: 1e-6 is 1 ppm
    std::uint64_t timelines = 0;  ///< all timelines begun so far
  };

  /// The time of a frame. Call this once for each message with a frame number, as soon as the message has come.
  /// @param connection_number see Telemetry and Picture
  /// @param frame_number an OPEN-R frame; it may wrap around
  /// @param arrival when the message's first byte came
  SteadyTime timeOf(std::uint64_t connection_number, std::uint32_t frame_number, SteadyTime arrival);

  Reading read();

 private:
  bool beginsTimeline(std::uint64_t connection_number, std::int32_t frames_passed, double delay, SteadyTime arrival);
  void begin(std::uint32_t frame_number, SteadyTime arrival);
  void advance(std::uint32_t frame_number, double passed, double lateness);
  void count(double delay);

  std::mutex mutex_;
  std::uint64_t connection_number_ = 0;
  SteadyTime begin_;                ///< when the timeline's first message came
  std::uint32_t newest_frame_ = 0;  ///< the highest frame so far
  double newest_ = 0;               ///< s, by the robot's clock, from the timeline's first message to the newest frame
  double lateness_ = 0;             ///< s: the newest frame's time is begin_ + newest_ + lateness_
  SteadyTime last_in_time_;         ///< when the last message came that was not too late
  DelayFloor floor_;
  Reading current_;
  double delay_sum_ = 0;
};

}  // namespace aibo_driver::robot_time

#endif  // AIBO_DRIVER_ROBOT_TIME_ROBOT_CLOCK_H
