/// @file stream_adapter.h
#ifndef AIBO_DRIVER_ROS_CAMERA_STREAM_ADAPTER_H
#define AIBO_DRIVER_ROS_CAMERA_STREAM_ADAPTER_H

#include <chrono>
#include <mutex>
#include <optional>
#include <string>

#include "aibo_driver/rcserver_client.h"
#include "ros/camera/adaptive_stream.h"
#include "text/throttled_warnings.h"

namespace aibo_driver::node {

/// Asks the robot for the quality and rate that the user wants or, with ~adaptive, for as much of it as the link
/// carries in time (AdaptiveStream). Every function may be called from any thread.
class StreamAdapter {
 public:
  using SteadyTime = std::chrono::steady_clock::time_point;

  struct Wish {
    int jpeg_quality = 85;  ///< 1..100
    StreamFormat format;
    bool adaptive = false;
    double max_picture_age = 0.15;  ///< s

    bool operator==(const Wish& other) const {
      return jpeg_quality == other.jpeg_quality && format == other.format && adaptive == other.adaptive &&
             max_picture_age == other.max_picture_age;
    }
  };

  /// @param client must outlive the adapter
  explicit StreamAdapter(RcServerClient& client);

  /// A new wish takes effect at once. The same wish again changes nothing.
  void setWish(const Wish& wish);

  /// A picture has been published. May ask the client for another stream, which does not block.
  /// @param taken when the robot took it; none if that is not known, and then nothing can be adapted
  void picturePublished(SteadyTime now, std::optional<SteadyTime> taken);

  /// What the user wants, and so the default of take_picture.
  int wishedQuality() const;

  /// Whether and how the stream is adapted now, for the diagnostics: "off", "not lowered", "lowered to quality 50 of 85
  /// and 15.0 of 30.0 pictures/s".
  std::string describe() const;

 private:
  void ask(const AdaptiveStream::Step& step);
  std::string describeStep() const;

  RcServerClient& client_;
  mutable std::mutex mutex_;  // guards what follows
  std::optional<Wish> wish_;
  std::optional<AdaptiveStream> stream_;  ///< while adaptive
  bool has_said_why_not_ = false;
  text::ThrottledWarnings log_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_CAMERA_STREAM_ADAPTER_H
