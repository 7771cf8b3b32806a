/// @file FileKeeper.h
/// The OPEN-R object that reads and writes motions and pictures on the memory stick for RCServer.
#ifndef AIBO_RCSERVER_FILE_KEEPER_FILE_KEEPER_H
#define AIBO_RCSERVER_FILE_KEEPER_FILE_KEEPER_H

#include <OPENR/OObject.h>
#include <OPENR/OObserver.h>
#include <OPENR/OSubject.h>
#include <def.h>

#include "file_keeper/FileJob.h"
#include "file_keeper/StickFiles.h"
#include "objects/RegionSender.h"

/// The OPEN-R object that reads and writes files for RCServer, one at a time.
///
/// FileKeeper is a separate object because the memory stick makes its caller wait, and an object handles one message at
/// a time. RCServer has a higher scheduling class and interrupts it (FileKeeper.ocf).
///
/// FileKeeper asks for a job only when RCServer can take the result.
class FileKeeper : public OObject {
 public:
  FileKeeper();
  virtual ~FileKeeper() {}

  OSubject* subject[numOfSubject];
  OObserver* observer[numOfObserver];

  virtual OStatus DoInit(const OSystemEvent& event);
  virtual OStatus DoStart(const OSystemEvent& event);
  virtual OStatus DoStop(const OSystemEvent& event);
  virtual OStatus DoDestroy(const OSystemEvent& event);

  /// Called when RCServer can take a result (gate Result).
  void ReadyResult(const OReadyEvent& event);

  /// Called when RCServer has sent a job (gate Job).
  void NotifyJob(const ONotifyEvent& event);

 private:
  FileKeeper(const FileKeeper&);
  FileKeeper& operator=(const FileKeeper&);

  static FileResult::Outcome CheckStick(FileJob::Operation operation);

  StickFiles files_;
  RegionSender<FileResult> results_;
};

#endif  // AIBO_RCSERVER_FILE_KEEPER_FILE_KEEPER_H
