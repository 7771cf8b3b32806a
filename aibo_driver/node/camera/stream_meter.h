/// @file stream_meter.h
#ifndef AIBO_DRIVER_NODE_CAMERA_STREAM_METER_H
#define AIBO_DRIVER_NODE_CAMERA_STREAM_METER_H

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>

namespace aibo_driver::node {

/// Measures the stream of published pictures between two readings. Any thread may call every function.
class StreamMeter {
 public:
  using SteadyTime = std::chrono::steady_clock::time_point;

  struct Reading {
    double seconds = 0.0;        ///< since the previous reading
    std::uint64_t pictures = 0;  ///< published in this time
    std::uint64_t bytes = 0;     ///< the size of their JPEGs
    double mean_latency = 0.0;   ///< s, from a picture's first byte to its publication; 0 if there are no pictures
    double max_latency = 0.0;    ///< s
    double slow_for = 0.0;       ///< s, how long fewer than half of the requested pictures have come
    double picturesPerSecond() const { return seconds > 0.0 ? static_cast<double>(pictures) / seconds : 0.0; }
    double kilobytesPerSecond() const { return seconds > 0.0 ? static_cast<double>(bytes) / seconds / 1000.0 : 0.0; }
  };

  explicit StreamMeter(std::function<SteadyTime()> now = std::chrono::steady_clock::now);

  /// Call this when a picture has been published.
  void add(std::size_t bytes, SteadyTime first_byte_time);

  /// Returns the measurements since the last call, or since construction.
  /// @param asked_rate the pictures per second that the robot is asked for now; 0 if there are none, or if the rate is
  ///   not known. The time before the first reading with a rate does not count as slow, because nothing may have been
  ///   asked for in a part of it
  Reading read(double asked_rate = 0);

 private:
  const std::function<SteadyTime()> now_;
  std::mutex mutex_;
  SteadyTime last_reading_;
  Reading current_;
  double latency_sum_ = 0.0;
  double slow_for_ = 0.0;
  double last_asked_rate_ = 0.0;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_CAMERA_STREAM_METER_H
