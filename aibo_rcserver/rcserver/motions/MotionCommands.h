/// @file MotionCommands.h
/// The requests about motions, for both versions of the protocol.
#ifndef AIBO_RCSERVER_RCSERVER_MOTIONS_MOTION_COMMANDS_H
#define AIBO_RCSERVER_RCSERVER_MOTIONS_MOTION_COMMANDS_H

#include "mtn/motion.h"
#include "protocol/text.h"
#include "rcserver/joints/JointControl.h"
#include "rcserver/motions/FileJobs.h"
#include "rcserver/settings/Settings.h"

/// Plays, stops, stores, deletes and lists the motions on the memory stick. A request that fails changes nothing, and
/// Problem() says why.
///
/// A request that needs the memory stick is PENDING until Finish(). There is one such request at a time.
class MotionCommands {
 public:
  enum Outcome {
    DONE,
    PENDING,      ///< FileKeeper is at work; Finish() returns the outcome
    REFUSED,      ///< not allowed, not a motion, its joints are in use, anything else
    FILE_MISSING  ///< there is no such file, or it cannot be read
  };

  /// Room for the text of Problem().
  static const size_t MAX_PROBLEM_SIZE = 256;

  /// All must outlive this.
  MotionCommands(JointControl& joints, const MotorSwitch& motors, FileJobs& files, const Settings& settings);

  /// A new client: forgets the request that an earlier client left pending.
  void Begin() { ticket_ = 0; }

  /// Why the last request was REFUSED or FILE_MISSING, in words that a user can act on.
  const char* Problem() const { return problem_; }

  /// True while a request is PENDING.
  bool IsPending() const { return ticket_ != 0; }

  /// True while Play(), Upload(), Delete() and List() must not be called: a request is PENDING, or FileKeeper is still
  /// at work for an earlier client.
  bool IsBusy() const { return IsPending() || (files_.IsThere() && !files_.IsFree()); }

  /// Begins to play a motion: PENDING until its file has been read.
  /// @param repetitions not below 1
  /// @param commands JointControl::NumberOfCommands() when it was requested: later commands to its joints have
  /// precedence
  Outcome Play(const protocol::MotionName& name, int repetitions, unsigned commands);

  /// Stops a motion, if it is being played.
  /// @param name empty: all of them
  void Stop(const protocol::MotionName& name);

  /// If this motion's file is still being read, Play() will be REFUSED.
  /// @param name empty: whichever it is
  /// @param why follows the name of the motion, as in "NOD.MTN ..."; must outlive this
  void Cancel(const protocol::MotionName& name, const char* why);

  /// Checks whether a file of this size may be uploaded, whatever its content: DONE or REFUSED.
  Outcome CheckUpload(size_t size);

  /// Stores a file, if it is a motion for this robot.
  Outcome Upload(const protocol::MotionName& name, const unsigned char* content, size_t size);

  Outcome Delete(const protocol::MotionName& name);

  /// Lists all motions: in FileResult::list when it is DONE.
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
  mtn::Motion checked_;  ///< the upload that is checked
  char problem_[MAX_PROBLEM_SIZE];

  /// @name The pending request
  /// @{
  unsigned ticket_;  ///< of its job; 0: there is none
  FileJob::Operation operation_;
  protocol::MotionName name_;
  int repetitions_;            ///< READ: how often the motion is to be played
  unsigned commands_;          ///< READ: how many commands there had been when it was requested
  const char* cancelled_why_;  ///< READ: why the motion is not to be played after all, or NULL
  /// @}
};

#endif  // AIBO_RCSERVER_RCSERVER_MOTIONS_MOTION_COMMANDS_H
