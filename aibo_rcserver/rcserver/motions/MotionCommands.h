/// @file MotionCommands.h
/// Motions, for clients of both versions.
#ifndef AIBO_RCSERVER_RCSERVER_MOTIONS_MOTION_COMMANDS_H
#define AIBO_RCSERVER_RCSERVER_MOTIONS_MOTION_COMMANDS_H

#include "mtn/motion.h"
#include "protocol/motion_name.h"
#include "rcserver/joints/JointControl.h"
#include "rcserver/motions/FileJobs.h"
#include "rcserver/settings/Settings.h"

/// Plays, stops, stores, deletes and lists the motions on the memory stick. Each function does what is asked, or
/// nothing and says why.
///
/// What needs the memory stick is only begun: its outcome is PENDING until Finish(). One such request is done at a
/// time.
class MotionCommands {
 public:
  enum Outcome {
    DONE,
    PENDING,      ///< the memory stick is at work: Finish() gives the outcome
    REFUSED,      ///< not allowed, no motion, joints taken, anything else
    FILE_MISSING  ///< there is no such file, or it cannot be read
  };

  /// Room for what Problem() says.
  static const size_t MAX_PROBLEM_SIZE = 256;

  /// All must outlive this.
  MotionCommands(JointControl& joints, const MotorSwitch& motors, FileJobs& files, const Settings& settings);

  /// A new client: what is pending was another one's, and is forgotten.
  void Begin() { ticket_ = 0; }

  /// Why the last request was REFUSED or FILE_MISSING, in words that a user can act on.
  const char* Problem() const { return problem_; }

  /// True while a request is PENDING.
  bool IsPending() const { return ticket_ != 0; }

  /// True while Play(), Upload(), Delete() and List() must not be called: a request is PENDING, or what another client
  /// has begun is not finished yet.
  bool IsBusy() const { return IsPending() || (files_.IsThere() && !files_.IsFree()); }

  /// Begins to play a motion: PENDING until its file has been read.
  /// @param repetitions not below 1
  Outcome Play(const protocol::MotionName& name, int repetitions);

  /// Stops a motion, if it is being played. If its file is still being read, Play() will be REFUSED.
  /// @param name empty: all of them
  void Stop(const protocol::MotionName& name);

  /// To be called when a request may have switched the motors off: a motion whose file is still being read will then be
  /// REFUSED, even if they are on again when it has been read.
  void NoticeMotors();

  /// Whether a file of that size may be uploaded, whatever is in it.
  Outcome CheckUpload(size_t size);

  /// Stores a file, if it is a motion for this robot.
  Outcome Upload(const protocol::MotionName& name, const unsigned char* content, size_t size);

  Outcome Delete(const protocol::MotionName& name);

  /// Lists the motions there are: FileResult::list, if it is DONE.
  Outcome List();

  /// True if this is the result that the pending request waits for.
  bool Awaits(const FileResult& result) const { return IsPending() && result.ticket == ticket_; }

  /// Finishes the pending request. Only if Awaits().
  /// @return never PENDING
  Outcome Finish(const FileResult& result);

 private:
  MotionCommands(const MotionCommands&);
  MotionCommands& operator=(const MotionCommands&);

  Outcome Post(FileJob::Operation operation, const protocol::MotionName& name, const unsigned char* content,
               size_t size);
  Outcome CheckPlay();
  Outcome FinishPlay(const FileResult& result);
  Outcome FailOnMemoryStick();
  Outcome Fail(Outcome outcome, const char* format, ...);

  JointControl& joints_;
  const MotorSwitch& motors_;
  FileJobs& files_;
  const Settings& settings_;
  mtn::Motion checked_;  ///< what is uploaded
  char problem_[MAX_PROBLEM_SIZE];

  /// @name The pending request
  /// @{
  unsigned ticket_;  ///< of its job; 0: there is none
  FileJob::Operation operation_;
  protocol::MotionName name_;
  int repetitions_;            ///< of READ, which is for playing
  const char* cancelled_why_;  ///< of READ; NULL: it is not cancelled
  /// @}
};

#endif  // AIBO_RCSERVER_RCSERVER_MOTIONS_MOTION_COMMANDS_H
