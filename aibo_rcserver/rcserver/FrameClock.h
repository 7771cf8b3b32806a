#ifndef AIBO_RCSERVER_RCSERVER_FRAME_CLOCK_H
#define AIBO_RCSERVER_RCSERVER_FRAME_CLOCK_H

#include <MCOOP.h>

#include "robot_model/robot_model.h"

/// The time of a clock that runs on while the robot's program stalls. Tekkotsu takes its time from the same call. The
/// result overflows after 49 days.
inline unsigned SystemMilliseconds() {
  SystemTime time;
  GetSystemTime(&time);
  return static_cast<unsigned>(time.seconds * 1000 + time.useconds / 1000);
}

/// The present frame is the last one reported, plus the time since then. So it advances while the robot's program
/// stalls and frames are reported late. It never goes back, although a frame that is reported may be older.
///
/// The clock also notices that the program stalled: frames are reported every 40 ms at least, so a pause of
/// LONGEST_PAUSE has no other reason. What clients have sent during the pause waits in the IPStack, and arrives within
/// CATCHING_UP. Both values are our choice.
///
/// Times are those of SystemMilliseconds(). Frames and times may overflow.
class FrameClock {
 public:
  static const unsigned LONGEST_PAUSE = 500;
  static const unsigned CATCHING_UP = 100;

  FrameClock()
      : has_frame_(false), frame_(0), reported_(0), present_(0), asked_(0), pause_ended_(0), catches_up_(false) {}

  /// Call this when a frame was reported. Frames may be reported in any order.
  void Report(unsigned frame, unsigned now) {
    Present(now);
    if (!has_frame_) {
      has_frame_ = true;
      present_ = frame;
      asked_ = now;
    } else if (static_cast<int>(frame - frame_) <= 0) {
      return;
    }
    frame_ = frame;
    reported_ = now;
  }

  /// The last frame reported; 0 before the first report.
  unsigned Last() const { return frame_; }

  /// The present frame; 0 before the first report. Call this before requests are handled.
  unsigned Present(unsigned now) {
    if (has_frame_) {
      const bool was_held_up = now - asked_ >= LONGEST_PAUSE;
      asked_ = now;
      pause_ended_ = was_held_up ? now : pause_ended_;
      catches_up_ = was_held_up || (catches_up_ && now - pause_ended_ < CATCHING_UP);
      const unsigned frame = frame_ + (now - reported_) / robot_model::FRAME_MILLISECONDS;
      present_ = static_cast<int>(frame - present_) > 0 ? frame : present_;
    }
    return present_;
  }

  /// True if a request that is handled now may have been delayed. Orders of version 2 say themselves when they are too
  /// old; in version 1, such a request must not move the robot.
  bool MayHaveWaited() const { return catches_up_; }

 private:
  bool has_frame_;
  unsigned frame_;     ///< the last frame reported
  unsigned reported_;  ///< when it was reported
  unsigned present_;   ///< the frame that Present() last returned
  unsigned asked_;     ///< when Present() was last called
  unsigned pause_ended_;
  bool catches_up_;
};

#endif  // AIBO_RCSERVER_RCSERVER_FRAME_CLOCK_H
