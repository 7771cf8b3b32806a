#ifndef AIBO_RCSERVER_RCSERVER_REQUESTS_FILE_ORDER_H
#define AIBO_RCSERVER_RCSERVER_REQUESTS_FILE_ORDER_H

#include <stddef.h>

#include "file_keeper/FileJob.h"
#include "mtn/fitted_motion.h"
#include "mtn/motion.h"
#include "protocol/text.h"
#include "rcserver/joints/JointControl.h"
#include "rcserver/requests/FileJobs.h"

/// Handles one request for the memory stick at a time, about a motion or a picture, for both versions of the protocol.
/// The request is PENDING until Finish(), Drop() or a problem ends it; until then, no other may begin. A request that
/// fails changes nothing.
class FileOrder {
 public:
  enum Outcome {
    DONE,
    PENDING,      ///< the camera or FileKeeper is working
    REFUSED,      ///< any other failure, such as a full memory stick
    FILE_MISSING  ///< there is no such file, or it cannot be read
  };

  static const size_t MAX_PROBLEM_SIZE = 256;

  FileOrder(FileJobs& jobs, JointControl& joints, const MotorSwitch& motors);

  /// Call this for a new client. It drops the request that an earlier client left pending.
  void Begin();

  /// Why the last request was REFUSED or FILE_MISSING, in words that a user can act on.
  const char* Problem() const { return problem_; }

  bool IsPending() const { return is_prepared_ || ticket_ != 0; }

  /// Begins to play a motion. The request is PENDING until the motion's file has been read. Commands that its joints
  /// get meanwhile take precedence.
  /// @param repetitions not below 1
  /// @param leave_out true: play the motion without the joints that the robot does not have; false: it is REFUSED
  /// @param number of the request of version 2, otherwise 0
  Outcome PlayMotion(const protocol::MotionName& name, int repetitions, bool leave_out, unsigned short number = 0);

  /// Stores a file, if it is a motion that this robot can play.
  /// @param leave_out see PlayMotion()
  Outcome StoreMotion(const protocol::MotionName& name, const unsigned char* content, size_t size, bool leave_out);

  /// Begins a request whose job follows later with Post().
  /// @return PENDING, or REFUSED if FileKeeper does not run
  Outcome Prepare();

  bool IsPrepared() const { return is_prepared_; }

  /// Makes FileKeeper do a job. The parameters are those of FileJobs::Post().
  /// @return PENDING, or REFUSED if FileKeeper does not run
  Outcome Post(FileJob::Operation operation, FileKind kind, const protocol::FileName& name,
               const unsigned char* content = NULL, size_t size = 0);

  const protocol::FileName& Name() const { return name_; }

  /// True if this is the result that the pending request waits for.
  bool Awaits(const FileResult& result) const { return ticket_ != 0 && result.ticket == ticket_; }

  /// Finishes the pending request. Call this only if Awaits(). A motion that was to be played begins.
  /// @return the outcome, never PENDING
  Outcome Finish(const FileResult& result);

  /// Drops the pending request when its result has come.
  void Drop() { ticket_ = 0; }

  /// Ends the request and keeps the reason for the failure.
  /// @param format as for printf(); the text has fewer than MAX_PROBLEM_SIZE bytes
  /// @return the outcome
  Outcome Fail(Outcome outcome, const char* format, ...);

 private:
  Outcome FailOnMemoryStick();
  Outcome CheckPlay();
  Outcome BeginToPlay(const FileResult& result);

  FileJobs& jobs_;
  JointControl& joints_;
  const MotorSwitch& motors_;
  bool is_prepared_;
  unsigned ticket_;  ///< ticket of the job; 0 if FileKeeper is not working for the client
  FileJob::Operation operation_;
  FileKind kind_;
  protocol::FileName name_;
  char problem_[MAX_PROBLEM_SIZE];
  mtn::Motion checked_;       ///< the motion that is checked before it is stored
  mtn::FittedMotion fitted_;  ///< the same, fitted to the robot

  // How to play the motion whose file is being read.
  int repetitions_;
  bool leave_out_;
  unsigned short number_;
};

#endif  // AIBO_RCSERVER_RCSERVER_REQUESTS_FILE_ORDER_H
