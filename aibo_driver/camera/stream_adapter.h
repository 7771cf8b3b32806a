/// @file stream_adapter.h
#ifndef AIBO_DRIVER_CAMERA_STREAM_ADAPTER_H
#define AIBO_DRIVER_CAMERA_STREAM_ADAPTER_H

#include <chrono>
#include <mutex>
#include <optional>
#include <string>

#include "aibo_client/rcserver_client.h"
#include "camera/adaptive_stream.h"
#include "text/throttled_warnings.h"

namespace aibo_driver::camera {

/// Asks the robot for the quality and rate that the user wants. With ~adaptive, it lowers both as far as the link
/// requires (AdaptiveStream). Any thread may call any function.
class StreamAdapter {
 public:
  using SteadyTime = std::chrono::steady_clock::time_point;

  struct Wish {
    int jpeg_quality = 85;  ///< 1..100
    aibo_client::StreamFormat format;
    bool adaptive = false;
    double max_picture_age = 0.15;  ///< s

    bool operator==(const Wish& other) const {
      return jpeg_quality == other.jpeg_quality && format == other.format && adaptive == other.adaptive &&
             max_picture_age == other.max_picture_age;
    }
  };

  /// @param client must outlive the adapter
  StreamAdapter(aibo_client::RcServerClient& client, aibo_client::LogSink log);

  /// Changes what the user wants, which takes effect at once. It does nothing if that has not changed.
  void setWish(const Wish& wish);

  /// Call this when a picture has been published. It may ask the client for another stream, which does not block.
  /// @param taken when the robot took the picture; if this is empty, the time is not known, and nothing is adapted
  void picturePublished(SteadyTime now, std::optional<SteadyTime> taken);

  /// The quality that the user wants. It is also the default of take_picture.
  int wishedQuality() const;

  /// Says for the diagnostics whether and how the stream is adapted now: "off", "not lowered", "lowered to quality 50
  /// of 85 and 15.0 of 30.0 pictures/s".
  std::string describe() const;

 private:
  std::string adapt(SteadyTime now, SteadyTime taken);
  bool mustSayWhyNot();
  void ask(const AdaptiveStream::Step& step);
  std::string describeStep() const;

  aibo_client::RcServerClient& client_;
  mutable std::mutex mutex_;  // guards the wish, the stream and the flag
  std::optional<Wish> wish_;
  std::optional<AdaptiveStream> stream_;  ///< empty unless the stream is adaptive
  bool has_said_why_not_ = false;
  const aibo_client::LogSink log_;
  text::ThrottledWarnings changes_{[this](const std::string& text) { log_(aibo_client::LogLevel::kInfo, text); }};
};

}  // namespace aibo_driver::camera

#endif  // AIBO_DRIVER_CAMERA_STREAM_ADAPTER_H
