/// @file FrameClock.h
/// Tells in which OPEN-R frame the robot is now.
#ifndef AIBO_RCSERVER_RCSERVER_FRAME_CLOCK_H
#define AIBO_RCSERVER_RCSERVER_FRAME_CLOCK_H

#include "robot_model/robot_model.h"

/// The present frame is the last one reported, plus the time since then. So it goes on while the robot's program is
/// held up, when frames are reported late. It never goes back, although frames may be reported that are older than it.
///
/// Times are in milliseconds, on a clock that runs on while the program is held up. Frames and times may overflow.
class FrameClock {
 public:
  FrameClock() : has_frame_(false), frame_(0), reported_(0), present_(0) {}

  /// A frame was reported. Frames may be reported in any order.
  void Report(unsigned frame, unsigned now) {
    Present(now);
    if (!has_frame_) {
      has_frame_ = true;
      present_ = frame;
    } else if (static_cast<int>(frame - frame_) <= 0) {
      return;
    }
    frame_ = frame;
    reported_ = now;
  }

  /// The present frame; 0 before the first report.
  unsigned Present(unsigned now) {
    if (has_frame_) {
      const unsigned frame = frame_ + (now - reported_) / robot_model::FRAME_MILLISECONDS;
      present_ = static_cast<int>(frame - present_) > 0 ? frame : present_;
    }
    return present_;
  }

 private:
  bool has_frame_;
  unsigned frame_;     ///< the last one reported
  unsigned reported_;  ///< when
  unsigned present_;   ///< as last returned
};

#endif  // AIBO_RCSERVER_RCSERVER_FRAME_CLOCK_H
