/// @file FileJobs.h
/// Where the commands of a client have motion files read and written.
#ifndef AIBO_RCSERVER_RCSERVER_MOTIONS_FILE_JOBS_H
#define AIBO_RCSERVER_RCSERVER_MOTIONS_FILE_JOBS_H

#include <stddef.h>

#include "file_keeper/FileJob.h"

/// Takes one job at a time. Its FileResult comes later (Session::FileDone()).
class FileJobs {
 public:
  virtual ~FileJobs() {}

  /// False if there is nobody who does jobs.
  virtual bool IsThere() const = 0;

  /// False while a job is being done.
  virtual bool IsFree() const = 0;

  /// Has a job done. Only if IsFree().
  /// @param name empty for LIST
  /// @param content, size up to mtn::MAX_FILE_SIZE bytes, which are copied; NULL and 0 unless it is STORE
  /// @return the job's ticket, which comes back with its result; not 0
  virtual unsigned Post(FileJob::Operation operation, const protocol::MotionName& name, const unsigned char* content,
                        size_t size) = 0;
};

#endif  // AIBO_RCSERVER_RCSERVER_MOTIONS_FILE_JOBS_H
