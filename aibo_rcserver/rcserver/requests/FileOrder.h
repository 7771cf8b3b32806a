#ifndef AIBO_RCSERVER_RCSERVER_REQUESTS_FILE_ORDER_H
#define AIBO_RCSERVER_RCSERVER_REQUESTS_FILE_ORDER_H

#include <stddef.h>

#include "file_keeper/FileJob.h"
#include "protocol/text.h"
#include "rcserver/requests/FileJobs.h"

/// Handles one request for the memory stick at a time, about a motion or a picture. The request is PENDING from
/// Prepare() or Post() until Finish() or a problem ends it.
class FileOrder {
 public:
  enum Outcome {
    DONE,
    PENDING,      ///< the camera or FileKeeper is working
    REFUSED,      ///< any other failure, such as a full memory stick
    FILE_MISSING  ///< there is no such file, or it cannot be read
  };

  /// Room for the text of Problem().
  static const size_t MAX_PROBLEM_SIZE = 256;

  explicit FileOrder(FileJobs& jobs);

  /// Call this for a new client. It drops the request that an earlier client left pending.
  void Begin();

  /// Why the last request was REFUSED or FILE_MISSING, in words that a user can act on.
  const char* Problem() const { return problem_; }

  /// True while a request is PENDING: Prepare() and Post() must not be called for a new one.
  bool IsPending() const { return is_prepared_ || ticket_ != 0; }

  /// Begins a request whose job follows later with Post().
  /// @return PENDING, or REFUSED if FileKeeper does not run
  Outcome Prepare();

  /// True from Prepare() to Post().
  bool IsPrepared() const { return is_prepared_; }

  /// Makes FileKeeper do a job. The parameters are those of FileJobs::Post().
  /// @return PENDING, or REFUSED if FileKeeper does not run
  Outcome Post(FileJob::Operation operation, FileKind kind, const protocol::FileName& name,
               const unsigned char* content = NULL, size_t size = 0);

  /// The job that was posted last.
  FileJob::Operation Operation() const { return operation_; }
  const protocol::FileName& Name() const { return name_; }

  /// True if this is the result that the pending request waits for.
  bool Awaits(const FileResult& result) const { return ticket_ != 0 && result.ticket == ticket_; }

  /// Finishes the pending request. Call this only if Awaits().
  /// @return the outcome, never PENDING
  Outcome Finish(const FileResult& result);

  /// Ends the request and keeps the reason for the failure.
  /// @param format as for printf(); the text has fewer than MAX_PROBLEM_SIZE bytes
  /// @return the outcome
  Outcome Fail(Outcome outcome, const char* format, ...);

 private:
  Outcome FailOnMemoryStick();

  FileJobs& jobs_;
  bool is_prepared_;
  unsigned ticket_;  ///< ticket of the job; 0 if FileKeeper is not working for the client
  FileJob::Operation operation_;
  FileKind kind_;
  protocol::FileName name_;
  char problem_[MAX_PROBLEM_SIZE];
};

#endif  // AIBO_RCSERVER_RCSERVER_REQUESTS_FILE_ORDER_H
