/// @file LieDown.h
/// A robot whose battery is low lies down before its motors go off.
#ifndef AIBO_RCSERVER_RCSERVER_MOTIONS_LIE_DOWN_H
#define AIBO_RCSERVER_RCSERVER_MOTIONS_LIE_DOWN_H

#include "file_keeper/FileJob.h"
#include "rcserver/joints/JointControl.h"
#include "rcserver/motions/FileJobs.h"

/// Plays LIE.MTN from the memory stick. Pure logic: no OPEN-R.
class LieDown {
 public:
  /// After this many frames it counts as over, whatever has come of it: 10 s, five times what it takes from any
  /// posture.
  static const unsigned MOST_FRAMES = 1250;

  LieDown() : state_(OVER), begin_(0), ticket_(0) {}

  /// @param now OPEN-R frame
  void Begin(unsigned now);

  bool IsUnderWay() const { return state_ != OVER; }

  /// To be called in every frame or so while it is under way.
  /// @param body_is_at_rest nothing moves, and no command is on its way
  /// @return NULL, or why the robot does not lie down, which is over then
  const char* Continue(unsigned now, FileJobs& files, bool body_is_at_rest);

  /// True if this is the motion that is waited for.
  bool Awaits(const FileResult& result) const { return state_ == READING && result.ticket == ticket_; }

  /// The motion has been read. Only if Awaits().
  /// @return NULL, or why the robot does not lie down, which is over then
  const char* Play(const FileResult& result, JointControl& joints);

 private:
  enum State { OVER, WAITING, READING, LYING_DOWN };

  State state_;
  unsigned begin_;
  unsigned ticket_;
};

#endif  // AIBO_RCSERVER_RCSERVER_MOTIONS_LIE_DOWN_H
