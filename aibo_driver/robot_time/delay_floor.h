/// @file delay_floor.h
#ifndef AIBO_DRIVER_ROBOT_TIME_DELAY_FLOOR_H
#define AIBO_DRIVER_ROBOT_TIME_DELAY_FLOOR_H

#include <cstdint>
#include <map>

namespace aibo_driver::robot_time {

/// Estimates offset and drift between two clocks from messages that travel from one to the other.
///
/// A message can be late, but never early. So we look for the straight line below the measured latenesses that is
/// closest to them. This line shows how far the clocks are apart and how fast they drift, however long the delays are.
/// This works as long as a message meets no delay once in a while (Moon, Skelly and Towsley, "Estimation and removal of
/// clock skew from network delay measurements", 1999). All messages have the shortest delay in common. This delay
/// cannot be told from an offset of the clocks, so the line contains it.
///
/// All times are in seconds, from any origin.
class DelayFloor {
 public:
  /// In seconds by the sender's clock. Older messages are forgotten, so a lasting increase of the shortest delay is
  /// noticed after this time.
  static constexpr double kWindow = 30;

  /// More than the greatest drift between two quartz clocks that are each within 100 ppm of the true time.
  static constexpr double kHighestDrift = 250e-6;

  /// @param sent when the message was sent, by the sender's clock
  /// @param lateness the arrival by the receiver's clock, less `sent`
  void add(double sent, double lateness);

  /// The lateness of a message that is sent at this time and meets no delay. It is 0 before the first add().
  double at(double sent) const { return origin_ + drift_ * (sent - origin_sent_); }

  /// How much the lateness grows in a second.
  double drift() const { return drift_; }

 private:
  struct Point {
    double sent = 0;
    double lateness = 0;
  };

  void fit();
  double driftThrough(double middle) const;

  std::map<std::int64_t, Point> earliest_;  ///< the least late message of each second
  double origin_sent_ = 0;
  double origin_ = 0;
  double drift_ = 0;
};

}  // namespace aibo_driver::robot_time

#endif  // AIBO_DRIVER_ROBOT_TIME_DELAY_FLOOR_H
