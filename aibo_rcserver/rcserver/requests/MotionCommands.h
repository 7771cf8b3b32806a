#ifndef AIBO_RCSERVER_RCSERVER_REQUESTS_MOTION_COMMANDS_H
#define AIBO_RCSERVER_RCSERVER_REQUESTS_MOTION_COMMANDS_H

#include "mtn/fitted_motion.h"
#include "mtn/motion.h"
#include "protocol/text.h"
#include "rcserver/joints/JointControl.h"
#include "rcserver/requests/FileOrder.h"

/// Plays, stops, stores, deletes and lists the motions on the memory stick. A request that fails changes nothing, and
/// FileOrder::Problem() has the reason.
///
/// A request that needs the memory stick is PENDING until Finish(). Play(), Upload(), Delete() and List() must not be
/// called while the FileOrder has a request PENDING.
class MotionCommands {
 public:
  typedef FileOrder::Outcome Outcome;

  MotionCommands(JointControl& joints, const MotorSwitch& motors, FileOrder& order);

  /// Begins to play a motion. The request is PENDING until the motion's file has been read. Commands that its joints
  /// get meanwhile take precedence.
  /// @param repetitions not below 1
  /// @param leave_out true: play the motion without the joints that the robot does not have; false: it is REFUSED
  /// @param number of the request of version 2, otherwise 0
  Outcome Play(const protocol::MotionName& name, int repetitions, bool leave_out, unsigned short number = 0);

  /// How the motion differs from its file (MotionPlayer::Changes()). Call this once Play() is DONE.
  const char* Changes() const { return joints_.Motions().Changes(); }

  /// Stops a motion if it is being played.
  /// @param name the motion's name; empty means all motions
  void Stop(const protocol::MotionName& name);

  /// Stores a file, if it is a motion that this robot can play.
  /// @param leave_out see Play()
  Outcome Upload(const protocol::MotionName& name, const unsigned char* content, size_t size, bool leave_out);

  Outcome Delete(const protocol::MotionName& name);

  /// Lists all motions. The list is in FileResult::list when the request is DONE.
  Outcome List();

  /// Finishes the pending request if it is about motions.
  /// @return the outcome, never PENDING
  Outcome Finish(const FileResult& result);

 private:
  Outcome CheckPlay();
  Outcome FinishPlay(const FileResult& result);

  JointControl& joints_;
  const MotorSwitch& motors_;
  FileOrder& order_;
  mtn::Motion checked_;       ///< the upload that is checked
  mtn::FittedMotion fitted_;  ///< the upload, fitted to the robot

  // The motion to be played, while its file is being read.
  int repetitions_;        ///< how often the motion is to be played
  bool leave_out_;         ///< whether to leave out the joints that the robot does not have
  unsigned short number_;  ///< number of the request
};

#endif  // AIBO_RCSERVER_RCSERVER_REQUESTS_MOTION_COMMANDS_H
