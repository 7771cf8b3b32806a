/// @file FileJob.h
/// What RCServer and FileKeeper send each other.
#ifndef AIBO_RCSERVER_FILE_KEEPER_FILE_JOB_H
#define AIBO_RCSERVER_FILE_KEEPER_FILE_JOB_H

#include <stddef.h>

#include "mtn/layout.h"
#include "protocol/motion_requests.h"
#include "protocol/text.h"

/// Where motions are on the memory stick.
const char MOTION_FOLDER[] = "OPEN-R/MW/DATA/P";

/// RCServer.FileJob: do this with a motion on the memory stick.
struct FileJob {
  enum Operation { READ, STORE, DELETE, LIST };

  unsigned ticket;  ///< comes back with the result; not 0
  Operation operation;
  protocol::MotionName name;  ///< empty for LIST
  size_t size;                ///< bytes of the content, for STORE; else 0
  unsigned char content[mtn::MAX_FILE_SIZE];
};

/// FileKeeper.Result: what came of it.
struct FileResult {
  enum Outcome {
    DONE,
    MISSING,    ///< for READ and DELETE: there is no such file
    TOO_LARGE,  ///< for READ: the file has more than mtn::MAX_FILE_SIZE bytes
    FAILED      ///< the memory stick refused; after STORE, nothing of the content is left on it
  };

  unsigned ticket;  ///< of the job
  Outcome outcome;
  size_t size;                                ///< bytes of the content, after READ; else 0
  unsigned char content[mtn::MAX_FILE_SIZE];  ///< after READ
  protocol::version2::MotionList list;        ///< after LIST
};

#endif  // AIBO_RCSERVER_FILE_KEEPER_FILE_JOB_H
