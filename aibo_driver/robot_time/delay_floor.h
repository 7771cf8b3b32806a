/// @file delay_floor.h
#ifndef AIBO_DRIVER_ROBOT_TIME_DELAY_FLOOR_H
#define AIBO_DRIVER_ROBOT_TIME_DELAY_FLOOR_H

#include <cstdint>
#include <map>

namespace aibo_driver::robot_time {

/// The straight line below what was measured of two clocks by messages from one to the other.
///
/// A message can be late, but never early. So of all straight lines that no message lies below, the one that is
/// closest to them tells how far the clocks are apart, and how fast they drift, whatever the delays do above it; as
/// long as some message in a while meets none (Moon, Skelly and Towsley, "Estimation and removal of clock skew from
/// network delay measurements", 1999). What all messages have in common, the shortest delay, cannot be told from a
/// difference of the clocks: it stays in the line.
///
/// All times in seconds, from any beginning.
class DelayFloor {
 public:
  /// What is older than this, by the sender's clock, is forgotten; so a shortest delay that grows for good is noticed
  /// after this time.
  static constexpr double kWindow = 30;

  /// Quartz clocks are within 100 ppm of the truth, each.
  static constexpr double kHighestDrift = 250e-6;

  /// @param sent by the sender's clock
  /// @param lateness arrival by the receiver's clock, less `sent`
  void add(double sent, double lateness);

  /// The lateness of what is sent then and meets no delay. 0 before the first add().
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

  std::map<std::int64_t, Point> earliest_;  ///< the least late of each second
  double origin_sent_ = 0;
  double origin_ = 0;
  double drift_ = 0;
};

}  // namespace aibo_driver::robot_time

#endif  // AIBO_DRIVER_ROBOT_TIME_DELAY_FLOOR_H
