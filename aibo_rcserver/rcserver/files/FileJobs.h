/// @file FileJobs.h
/// RCServer's side of the object FileKeeper.
#ifndef AIBO_RCSERVER_RCSERVER_FILES_FILE_JOBS_H
#define AIBO_RCSERVER_RCSERVER_FILES_FILE_JOBS_H

#include <OPENR/OSubject.h>
#include <stddef.h>
#include <string.h>

#include "file_keeper/FileJob.h"
#include "objects/RegionSender.h"

/// Has motions and pictures read and written, one job at a time. The FileResult comes later (Session::FileDone()).
class FileJobs {
 public:
  virtual ~FileJobs() {}

  /// False if FileKeeper does not run.
  virtual bool IsThere() const = 0;

  /// False while a job is being done.
  virtual bool IsFree() const = 0;

  /// Begins a job. Only if IsFree().
  /// @param name empty for LIST, and to STORE a picture
  /// @param content, size for STORE: up to largestFile() bytes, which are copied; otherwise NULL and 0
  /// @return the job's ticket, which comes back with its result; not 0
  virtual unsigned Post(FileJob::Operation operation, FileKind kind, const protocol::FileName& name,
                        const unsigned char* content, size_t size) = 0;
};

/// Sends jobs to FileKeeper.
class FileDesk : public FileJobs {
 public:
  FileDesk() {}

  /// Call in DoInit.
  /// @param gate to FileKeeper; must outlive this
  /// @return false if the memory could not be allocated
  bool Create(OSubject* gate) { return jobs_.Create(gate); }

  /// Call in DoDestroy.
  void Destroy() { jobs_.Destroy(); }

  virtual bool IsThere() const { return jobs_.HasReceiver(); }
  virtual bool IsFree() const { return jobs_.IsFree(); }
  virtual unsigned Post(FileJob::Operation operation, FileKind kind, const protocol::FileName& name,
                        const unsigned char* content, size_t size) {
    FileJob* const job = jobs_.Memory();
    job->ticket = jobs_.NewTicket();
    job->operation = operation;
    job->kind = kind;
    strcpy(job->name, name);
    job->size = size;
    if (size > 0) {
      memcpy(job->content, content, size);
    }
    const unsigned ticket = job->ticket;
    jobs_.Send();
    return ticket;
  }

 private:
  RegionSender<FileJob> jobs_;
};

#endif  // AIBO_RCSERVER_RCSERVER_FILES_FILE_JOBS_H
