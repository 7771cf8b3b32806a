/// @file FileDesk.h
/// RCServer's side of the object FileKeeper.
#ifndef AIBO_RCSERVER_RCSERVER_MOTIONS_FILE_DESK_H
#define AIBO_RCSERVER_RCSERVER_MOTIONS_FILE_DESK_H

#include <OPENR/OSubject.h>

#include "objects/RegionSender.h"
#include "rcserver/motions/FileJobs.h"

/// Sends jobs to FileKeeper.
class FileDesk : public FileJobs {
 public:
  FileDesk() {}

  /// To be called in DoInit.
  /// @param gate to FileKeeper; must outlive this
  /// @return false if the memory could not be allocated
  bool Create(OSubject* gate) { return jobs_.Create(gate); }

  /// To be called in DoDestroy.
  void Destroy() { jobs_.Destroy(); }

  virtual bool IsThere() const { return jobs_.HasReceiver(); }
  virtual bool IsFree() const { return jobs_.IsFree(); }
  virtual unsigned Post(FileJob::Operation operation, const protocol::MotionName& name, const unsigned char* content,
                        size_t size);

 private:
  RegionSender<FileJob> jobs_;
};

#endif  // AIBO_RCSERVER_RCSERVER_MOTIONS_FILE_DESK_H
