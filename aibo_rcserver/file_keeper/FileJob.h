/// @file FileJob.h
/// The messages between RCServer and FileKeeper.
#ifndef AIBO_RCSERVER_FILE_KEEPER_FILE_JOB_H
#define AIBO_RCSERVER_FILE_KEEPER_FILE_JOB_H

#include <stddef.h>

#include "mtn/layout.h"
#include "protocol/motion_requests.h"
#include "protocol/text.h"

/// The folder with the motions on the memory stick.
const char MOTION_FOLDER[] = "OPEN-R/MW/DATA/P";

/// RCServer.FileJob: a job with a motion on the memory stick.
struct FileJob {
  enum Operation { READ, STORE, DELETE, LIST };

  unsigned ticket;  ///< comes back with the result; not 0
  Operation operation;
  protocol::MotionName name;  ///< empty for LIST
  size_t size;                ///< bytes of the content for STORE, otherwise 0
  unsigned char content[mtn::MAX_FILE_SIZE];
};

/// FileKeeper.Result: the result of a job.
struct FileResult {
  enum Outcome {
    DONE,
    MISSING,    ///< READ, DELETE: there is no such file
    TOO_LARGE,  ///< READ: the file has more than mtn::MAX_FILE_SIZE bytes
    FAILED      ///< the memory stick failed; after STORE, nothing of the content is left on it
  };

  unsigned ticket;  ///< of the job
  Outcome outcome;
  size_t size;                                ///< bytes of the content after READ, otherwise 0
  unsigned char content[mtn::MAX_FILE_SIZE];  ///< after READ
  protocol::version2::MotionList list;        ///< after LIST
};

#endif  // AIBO_RCSERVER_FILE_KEEPER_FILE_JOB_H
