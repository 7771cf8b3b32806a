/// @file adaptive_stream.h
/// Finds the quality and rate that a weak radio link can carry in time.
#ifndef AIBO_DRIVER_CAMERA_ADAPTIVE_STREAM_H
#define AIBO_DRIVER_CAMERA_ADAPTIVE_STREAM_H

#include <chrono>
#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

namespace aibo_driver::camera {

/// Keeps the age of pictures below a limit. It first lowers the quality of the stream, down to kLowestQuality, then its
/// rate. It raises them again when the link carries more. All numbers below are our choice.
///
/// - A picture is late when its age is at least kLate times the limit. The limit alone would be too strict to measure,
///   because the shortest delay of messages cannot be measured.
/// - It lowers the stream when all pictures of kPatience, or a third of those of the last second, are late. If fewer
///   pictures come than are asked for, the link is full. In that case, what the link carries says how far to go down.
///   Otherwise it goes down one step. A lost packet delays one or two pictures, which is no reason to go down, so there
///   must be kFewestLate.
/// - It raises the stream one step at a time. In the last kCalmTime, no picture may have been older than kCalm times
///   the limit, and the present step must have lasted for the waiting time of the next. If a step proves too much
///   within kTrial, its waiting time doubles, up to kLongestWait. So a step that the link can almost carry is not tried
///   again and again.
///
/// The object has no clock of its own. Only one thread at a time may use it.
class AdaptiveStream {
 public:
  using SteadyTime = std::chrono::steady_clock::time_point;
  using Duration = std::chrono::steady_clock::duration;

  static constexpr int kLowestQuality = 50;
  static constexpr int kRarestImage = 15;  ///< every 15th image: two pictures a second
  static constexpr std::chrono::milliseconds kPatience{150};
  static constexpr int kFewestLate = 4;
  static constexpr double kLate = 0.8;
  static constexpr std::chrono::milliseconds kSettling{250};  ///< for this long, pictures of the step before still come
  static constexpr std::chrono::seconds kCalmTime{3};
  static constexpr std::size_t kMostArrivals = 256;  ///< in kCalmTime; a camera sends 90, a hostile robot any number
  static constexpr double kCalm = 0.6;
  static constexpr std::chrono::seconds kTrial{60};
  static constexpr std::chrono::seconds kFirstWait{5};
  static constexpr std::chrono::minutes kLongestWait{10};

  struct Step {
    int jpeg_quality;     ///< 1..100
    int every_nth_image;  ///< 1 means every image of the camera
  };

  /// @param best the step that the user wants, with which the stream begins. If its quality is below kLowestQuality,
  ///   the quality is never changed
  /// @param max_age the greatest age that a picture should have when it is published
  AdaptiveStream(const Step& best, Duration max_age);

  /// Call this when a picture of the stream has come.
  /// @param age the time from the camera's image to now
  /// @return what to ask the robot for from now on; empty if nothing changes
  std::optional<Step> pictureArrived(SteadyTime now, Duration age);

  /// The stream that the robot should send now.
  const Step& inForce() const { return steps_[current_].step; }

  bool isLowered() const { return current_ > 0; }

 private:
  struct Rung {
    Step step;
    double load;  ///< bytes a second; 1 is all images at quality 85
    Duration wait;
  };

  struct Arrival {
    SteadyTime time;
    Duration age;
  };

  using Arrivals = std::deque<Arrival>;

  bool isLate(const Arrival& arrival) const;
  Arrivals::const_iterator lastSecond(SteadyTime now) const;
  bool mustLower(SteadyTime now) const;
  bool mayRaise(SteadyTime now) const;
  std::size_t lowerStep(SteadyTime now) const;
  void change(std::size_t to, SteadyTime now);

  Duration max_age_;
  std::vector<Rung> steps_;  ///< from the best to the last resort
  std::size_t current_ = 0;
  Arrivals arrivals_;  ///< the pictures of this step in the last kCalmTime, without those that came in kSettling
  std::optional<SteadyTime> changed_at_;  ///< when the present step began; empty before the first change
  std::optional<SteadyTime> raised_at_;   ///< when the stream was raised, if that was the last change
};

}  // namespace aibo_driver::camera

#endif  // AIBO_DRIVER_CAMERA_ADAPTIVE_STREAM_H
