/// @file link_meter.h
#ifndef AIBO_DRIVER_CAMERA_LINK_METER_H
#define AIBO_DRIVER_CAMERA_LINK_METER_H

#include <chrono>
#include <cstdint>
#include <mutex>
#include <optional>

#include "aibo_client/camera.h"

namespace aibo_driver::camera {

/// Measures a stream of pictures: how many come, how old they are, how many are missing, and how long it has been slow.
/// Any thread may call any function.
class LinkMeter {
 public:
  using SteadyTime = std::chrono::steady_clock::time_point;

  struct Reading {
    double seconds = 0;
    std::uint64_t pictures = 0;
    std::uint64_t bytes = 0;
    /// s, the average age of a picture. It is empty if there are no pictures, or if the server does not send frame
    /// numbers (version 1).
    std::optional<double> mean_age;
    std::optional<double> worst_age;  ///< s
    std::optional<double> loss;       ///< 0..1, the part of the requested images that did not come; empty if not known
    double longest_gap = 0;           ///< s, between two pictures, or since the last one
    double mean_latency = 0;          ///< s, from a picture's first byte to add(); 0 if there are no pictures
    double max_latency = 0;           ///< s
    double slow_for = 0;              ///< s, how long fewer than half of the requested pictures have come

    double picturesPerSecond() const { return seconds > 0 ? static_cast<double>(pictures) / seconds : 0; }
    double kilobytesPerSecond() const { return seconds > 0 ? static_cast<double>(bytes) / seconds / 1000 : 0; }
  };

  explicit LinkMeter(SteadyTime now = std::chrono::steady_clock::now()) : begin_(now), last_(now) {}

  /// Call this for each picture, when it is shown or published.
  /// @param age s, from when the picture was taken until now; it counts only if the picture has a frame number
  /// @param every_nth_image the robot is asked for every nth image of its camera; 0 if no stream is wanted
  void add(const aibo_client::Picture& picture, double age, int every_nth_image, SteadyTime now);

  /// Returns what was measured since the last call, or since construction.
  ///
  /// @param asked_rate the pictures a second that the robot is asked for now; 0 if there are none, or if the rate is
  ///   not known. The time before the first reading with a rate does not count as slow, because nothing may have been
  ///   asked for in a part of it
  Reading read(SteadyTime now, double asked_rate = 0);

 private:
  std::uint64_t imagesDue(const aibo_client::Picture& picture, int every_nth_image);

  std::mutex mutex_;
  SteadyTime begin_;
  SteadyTime last_;  ///< when the last picture came
  Reading current_;
  std::uint64_t aged_ = 0;  ///< pictures of which we know when they were taken
  double age_sum_ = 0;
  double latency_sum_ = 0;
  double slow_for_ = 0;
  double last_asked_rate_ = 0;
  std::uint64_t counted_ = 0;  ///< pictures of which we know how many were due
  std::uint64_t due_ = 0;      ///< how many pictures were due, including those that did not come
  std::uint64_t connection_number_ = 0;
  std::optional<std::uint32_t> last_image_;  ///< the camera's count of the newest image of this connection
};

}  // namespace aibo_driver::camera

#endif  // AIBO_DRIVER_CAMERA_LINK_METER_H
