#ifndef AIBO_RCSERVER_RCSERVER_REQUESTS_FILE_JOBS_H
#define AIBO_RCSERVER_RCSERVER_REQUESTS_FILE_JOBS_H

#include <OPENR/OSubject.h>
#include <stddef.h>
#include <string.h>

#include "file_keeper/FileJob.h"
#include "objects/RegionSender.h"

/// Lets FileKeeper read and write motions and pictures, one job at a time. The FileResult comes later
/// (Session::FileDone()).
class FileJobs {
 public:
  virtual ~FileJobs() {}

  /// False if FileKeeper does not run.
  virtual bool IsThere() const = 0;

  /// Begins a job. If FileKeeper is still working for an earlier client, the job waits. A client may have only one job
  /// at a time.
  /// @param name the file's name; empty for LIST, and to STORE a picture
  /// @param content, size for STORE: up to largestFile() bytes, which are copied; otherwise NULL and 0
  /// @return the job's ticket, which comes back with its result; not 0
  virtual unsigned Post(FileJob::Operation operation, FileKind kind, const protocol::FileName& name,
                        const unsigned char* content, size_t size) = 0;

  /// Call this when the client is gone. Its job is dropped if it has not begun.
  virtual void ClientGone() = 0;
};

/// Sends each job to FileKeeper when FileKeeper is ready.
class FileDesk : public FileJobs {
 public:
  FileDesk() : has_job_(false) {}

  /// Call this in DoInit.
  /// @param gate to FileKeeper
  /// @return false if the memory could not be allocated
  bool Create(OSubject* gate) { return jobs_.Create(gate); }

  /// Call this in DoDestroy.
  void Destroy() { jobs_.Destroy(); }

  /// False while FileKeeper has something to do.
  bool IsFree() const { return !has_job_ && jobs_.IsFree(); }

  void SendJob() {
    if (has_job_ && jobs_.IsFree()) {
      has_job_ = false;
      jobs_.Send();
    }
  }

  virtual bool IsThere() const { return jobs_.HasReceiver(); }
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
    has_job_ = true;
    SendJob();
    return ticket;
  }
  virtual void ClientGone() { has_job_ = false; }

 private:
  RegionSender<FileJob, 2> jobs_;
  bool has_job_;  ///< a job is in memory but has not been sent
};

#endif  // AIBO_RCSERVER_RCSERVER_REQUESTS_FILE_JOBS_H
