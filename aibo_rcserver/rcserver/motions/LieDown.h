/// @file LieDown.h
/// Makes the robot lie down before its motors go off.
#ifndef AIBO_RCSERVER_RCSERVER_MOTIONS_LIE_DOWN_H
#define AIBO_RCSERVER_RCSERVER_MOTIONS_LIE_DOWN_H

#include "file_keeper/FileJob.h"
#include "rcserver/joints/JointControl.h"
#include "rcserver/motions/FileJobs.h"

/// Plays LIE.MTN from the memory stick, when the battery is low.
class LieDown {
 public:
  /// Frames after which it is given up: 10 s, five times what it takes from any posture.
  static const unsigned MOST_FRAMES = 1250;

  LieDown() : state_(OVER), begin_(0), ticket_(0) {}

  /// @param now OPEN-R frame
  void Begin(unsigned now);

  bool IsUnderWay() const { return state_ != OVER; }

  /// Call in every frame or so while IsUnderWay().
  /// @param body_is_at_rest nothing moves, and no command is on its way
  /// @return NULL, or why the robot does not lie down; then it is no longer under way
  const char* Continue(unsigned now, FileJobs& files, bool body_is_at_rest);

  /// True if this is the result that Play() needs.
  bool Awaits(const FileResult& result) const { return state_ == READING && result.ticket == ticket_; }

  /// LIE.MTN has been read: plays it. Only if Awaits().
  /// @return NULL, or why the robot does not lie down; then it is no longer under way
  const char* Play(const FileResult& result, JointControl& joints);

 private:
  enum State { OVER, WAITING, READING, LYING_DOWN };

  State state_;
  unsigned begin_;
  unsigned ticket_;
};

#endif  // AIBO_RCSERVER_RCSERVER_MOTIONS_LIE_DOWN_H
