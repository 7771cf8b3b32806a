/// @file MotionCommands.h
/// Motions, for clients of both versions.
#ifndef RCSERVER_COMMANDS_MOTION_COMMANDS_H
#define RCSERVER_COMMANDS_MOTION_COMMANDS_H

#include "mtn/motion.h"
#include "protocol/motion_name.h"
#include "protocol/motion_requests.h"
#include "rcserver/commands/Robot.h"
#include "rcserver/memory_stick/Settings.h"

/// Plays, stops, stores, deletes and lists the motions on the memory stick. Each function does what is asked, or
/// nothing and says why.
class MotionCommands {
 public:
  enum Outcome {
    DONE,
    REFUSED,      ///< not allowed, no motion, joints taken, anything else
    FILE_MISSING  ///< there is no such file, or it cannot be read
  };

  /// Room for what Problem() says.
  static const size_t MAX_PROBLEM_SIZE = 256;

  /// All must outlive this.
  MotionCommands(const Robot& robot, const Settings& settings);

  /// Why the last request was not DONE, in words that a user can act on.
  const char* Problem() const { return problem_; }

  /// Begins to play a motion.
  /// @param repetitions not below 1
  Outcome Play(const protocol::MotionName& name, int repetitions);

  /// Stops a motion, if it is being played.
  /// @param name empty: all of them
  void Stop(const protocol::MotionName& name);

  /// Whether a file of that size may be uploaded, whatever is in it.
  Outcome CheckUpload(size_t size);

  /// Stores a file, if it is a motion for this robot.
  Outcome Upload(const protocol::MotionName& name, const unsigned char* content, size_t size);

  Outcome Delete(const protocol::MotionName& name);

  /// The motions there are, until the next call.
  const protocol::version2::MotionList& List();

 private:
  MotionCommands(const MotionCommands&);
  MotionCommands& operator=(const MotionCommands&);

  Outcome Fail(Outcome outcome, const char* format, ...);

  const Robot& robot_;
  const Settings& settings_;
  mtn::Motion checked_;  ///< what is uploaded
  protocol::version2::MotionList list_;
  char problem_[MAX_PROBLEM_SIZE];
};

#endif  // RCSERVER_COMMANDS_MOTION_COMMANDS_H
