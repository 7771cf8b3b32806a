/// @file timeline.h
#ifndef AIBO_DRIVER_TOOLS_PLAYBACK_TIMELINE_H
#define AIBO_DRIVER_TOOLS_PLAYBACK_TIMELINE_H

#include <ros/time.h>

namespace aibo_driver::tools {

/// When each moment of a recording is played.
class Timeline {
 public:
  /// @param rate how much faster than recorded, more than 0
  explicit Timeline(double rate) : rate_(rate) {}

  /// Plays this moment of the recording now, and the others before and after it.
  void anchor(const ros::Time& recorded, const ros::Time& now) {
    recorded_ = recorded;
    now_ = now;
  }

  /// When a moment of the recording is played.
  ros::Time timeOf(const ros::Time& recorded) const { return now_ + (recorded - recorded_) * (1 / rate_); }

  /// Which moment of the recording is played at this time.
  ros::Time recordedAt(const ros::Time& now) const { return recorded_ + (now - now_) * rate_; }

 private:
  const double rate_;
  ros::Time recorded_;
  ros::Time now_;
};

}  // namespace aibo_driver::tools

#endif  // AIBO_DRIVER_TOOLS_PLAYBACK_TIMELINE_H
