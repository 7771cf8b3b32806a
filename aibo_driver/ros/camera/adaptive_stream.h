/// @file adaptive_stream.h
/// Which quality and rate a weak radio link can carry in time.
#ifndef AIBO_DRIVER_ROS_CAMERA_ADAPTIVE_STREAM_H
#define AIBO_DRIVER_ROS_CAMERA_ADAPTIVE_STREAM_H

#include <chrono>
#include <cstddef>
#include <deque>
#include <optional>
#include <vector>

namespace aibo_driver::node {

/// Keeps the age of pictures below a limit. It lowers first the quality of the stream, down to kLowestQuality, then its
/// rate, as far as needed, and raises them again when the link carries more. All numbers below are our choice.
///
/// - A picture is late from kLate times the limit on, since the shortest delay that messages meet cannot be measured.
/// - Lower: when all pictures of kPatience, or a third of those of the last second, are late. If fewer pictures come
///   than are asked for, the link is full, and what it carries says how far to go; otherwise one step. A lost packet
///   holds up one or two pictures, which is no reason: it takes kFewestLate late ones.
/// - Raise: one step at a time, when no picture of kCalmTime has been older than kCalm times the limit, and the present
///   step has lasted for the waiting time of the next. A step that proves too much within kTrial has twice the waiting
///   time from then on, up to kLongestWait; so a link that can almost carry a step is not tried again and again.
///
/// It has no clock of its own, and one thread at a time may use it.
class AdaptiveStream {
 public:
  using SteadyTime = std::chrono::steady_clock::time_point;
  using Duration = std::chrono::steady_clock::duration;

  static constexpr int kLowestQuality = 50;
  static constexpr int kRarestImage = 15;  ///< every 15th: two pictures a second
  static constexpr std::chrono::milliseconds kPatience{150};
  static constexpr int kFewestLate = 4;
  static constexpr double kLate = 0.8;
  static constexpr std::chrono::milliseconds kSettling{250};  ///< pictures of the step before are still on their way
  static constexpr std::chrono::seconds kCalmTime{3};
  static constexpr double kCalm = 0.6;
  static constexpr std::chrono::seconds kTrial{60};
  static constexpr std::chrono::seconds kFirstWait{5};
  static constexpr std::chrono::minutes kLongestWait{10};

  struct Step {
    int jpeg_quality;     ///< 1..100
    int every_nth_image;  ///< of the camera, 1 or more
  };

  /// @param best what the user wants, and what it begins with. A quality below kLowestQuality stays as it is
  /// @param max_age of a picture when it is published
  AdaptiveStream(const Step& best, Duration max_age);

  /// A picture of the stream has come.
  /// @param age from the camera's image to now
  /// @return what to ask the robot for from now on; none if nothing changes
  std::optional<Step> pictureArrived(SteadyTime now, Duration age);

  /// What the robot should send now.
  const Step& inForce() const { return steps_[current_].step; }

  bool isLowered() const { return current_ > 0; }

 private:
  struct Rung {
    Step step;
    double load;  ///< bytes a second, in units of quality 85 and all images
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
  Arrivals arrivals_;                     ///< of this step, of the last kCalmTime; without those of kSettling
  std::optional<SteadyTime> changed_at_;  ///< when the present step began; none before the first picture
  std::optional<SteadyTime> raised_at_;   ///< if the last change was up
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_CAMERA_ADAPTIVE_STREAM_H
