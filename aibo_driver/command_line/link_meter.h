/// @file link_meter.h
#ifndef AIBO_DRIVER_COMMAND_LINE_LINK_METER_H
#define AIBO_DRIVER_COMMAND_LINE_LINK_METER_H

#include <chrono>
#include <cstdint>
#include <optional>

#include "aibo_driver/picture.h"
#include "command_line/json.h"
#include "robot_time/robot_clock.h"

namespace aibo_driver::command_line {

/// Measures a stream of pictures: how many come, how old they are, and how many are missing. From one thread.
class LinkMeter {
 public:
  using SteadyTime = std::chrono::steady_clock::time_point;

  struct Reading {
    double seconds = 0;
    std::uint64_t pictures = 0;
    std::uint64_t bytes = 0;
    /// s, from the camera's image to the picture's last byte, beyond the shortest time that any picture took. Empty
    /// without pictures, and if the server does not send frame numbers (version 1).
    std::optional<double> mean_age;
    std::optional<double> worst_age;  ///< s
    std::optional<double> loss;       ///< 0..1, of the camera's images that were asked for; empty as the ages
    double longest_gap = 0;           ///< s, between two pictures, also those that no picture has ended yet

    double picturesPerSecond() const { return seconds > 0 ? static_cast<double>(pictures) / seconds : 0; }
    double kilobytesPerSecond() const { return seconds > 0 ? static_cast<double>(bytes) / seconds / 1000 : 0; }
  };

  /// @param every_nth_image that the stream has
  LinkMeter(int every_nth_image, SteadyTime now) : every_nth_image_(every_nth_image), begin_(now), last_(now) {}

  /// To be called for each picture.
  /// @param complete when its last byte came
  void add(const Picture& picture, SteadyTime complete);

  /// What was measured since the last call.
  Reading read(SteadyTime now);

 private:
  const int every_nth_image_;
  robot_time::RobotClock clock_;
  SteadyTime begin_;
  SteadyTime last_;  ///< picture
  Reading current_;
  double age_sum_ = 0;
  std::uint64_t connection_ = 0;
  std::optional<std::uint32_t> image_;  ///< count of the last picture
  std::uint64_t due_ = 0;               ///< pictures, by the camera's count
  std::uint64_t counted_ = 0;           ///< pictures among them that came
};

/// A reading in one line: pictures a second, data rate, age, loss.
std::string wordsOf(const LinkMeter::Reading& reading);

Json jsonOf(const LinkMeter::Reading& reading);

}  // namespace aibo_driver::command_line

#endif  // AIBO_DRIVER_COMMAND_LINE_LINK_METER_H
