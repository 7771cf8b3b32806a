#include "file_keeper/FileKeeper.h"

#include <OPENR/OPENRAPI.h>
#include <OPENR/OSyslog.h>
#include <OPENR/core_macro.h>

#include "objects/HostSettings.h"

FileKeeper::FileKeeper() : files_(hostSettings()) {}

OStatus FileKeeper::DoInit(const OSystemEvent&) {
  NEW_ALL_SUBJECT_AND_OBSERVER;
  REGISTER_ALL_ENTRY;
  SET_ALL_READY_AND_NOTIFY_ENTRY;
  if (!results_.Create(subject[sbjResult])) {
    OSYSLOG1((osyslogERROR, "FileKeeper: no shared memory for a result"));
    return oFAIL;
  }
  return oSUCCESS;
}

// The first job is not asked for here, but in ReadyResult().
OStatus FileKeeper::DoStart(const OSystemEvent&) {
  ENABLE_ALL_SUBJECT;
  return oSUCCESS;
}

OStatus FileKeeper::DoStop(const OSystemEvent&) {
  DISABLE_ALL_SUBJECT;
  DEASSERT_READY_TO_ALL_OBSERVER;
  return oSUCCESS;
}

OStatus FileKeeper::DoDestroy(const OSystemEvent&) {
  results_.Destroy();
  DELETE_ALL_SUBJECT_AND_OBSERVER;
  return oSUCCESS;
}

void FileKeeper::ReadyResult(const OReadyEvent& event) {
  if (event.IsAssert()) {
    observer[obsJob]->AssertReady();
  }
}

void FileKeeper::NotifyJob(const ONotifyEvent& event) {
  const FileJob& job = *static_cast<const FileJob*>(event.Data(0));
  FileResult* const result = results_.Memory();
  result->ticket = job.ticket;
  result->outcome = CheckStick(job.operation);
  if (result->outcome == FileResult::DONE) {
    result->outcome = files_.CarryOut(job, result);
  }
  results_.Send();
}

// Reports a stick that is missing or write-protected. If OPEN-R does not know, the job is tried anyway.
FileResult::Outcome FileKeeper::CheckStick(FileJob::Operation operation) {
  OMemoryStickStatus status = omemorystickUNDEF;
  if (OPENR::GetMemoryStickStatus(&status) != oSUCCESS) {
    return FileResult::DONE;
  }
  if (status == omemorystickNOT_EXIST) {
    return FileResult::NO_STICK;
  }
  const bool writes = operation == FileJob::STORE || operation == FileJob::DELETE;
  return writes && status == omemorystickWRITE_PROTECTED ? FileResult::LOCKED : FileResult::DONE;
}
