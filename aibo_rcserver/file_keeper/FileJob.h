/// @file FileJob.h
/// The messages between RCServer and FileKeeper.
#ifndef AIBO_RCSERVER_FILE_KEEPER_FILE_JOB_H
#define AIBO_RCSERVER_FILE_KEEPER_FILE_JOB_H

#include <stddef.h>

#include "mtn/layout.h"
#include "protocol/file_list.h"
#include "protocol/stick_pictures.h"
#include "protocol/text.h"

/// The folder on the memory stick with the motions and the pictures. Sony's sample ImageCapture saves its pictures
/// there, too, so it is known that programs may write to it.
const char DATA_FOLDER[] = "OPEN-R/MW/DATA/P";

/// Most bytes of a motion or a picture.
const size_t FILE_CAPACITY = protocol::version2::MAX_STICK_PICTURE_SIZE;

/// Bytes that pictures leave free on the memory stick: for a motion, RCSERVER.CFG and the log of a crash (EMON.LOG).
const size_t PICTURE_RESERVE = 64 * 1024;

enum FileKind { MOTION_FILE, PICTURE_FILE };

/// Most bytes of a file of this kind.
inline size_t largestFile(FileKind kind) {
  return kind == MOTION_FILE ? static_cast<size_t>(mtn::MAX_FILE_SIZE) : FILE_CAPACITY;
}

/// RCServer.FileJob: a job with a file on the memory stick.
struct FileJob {
  enum Operation { READ, STORE, DELETE, LIST };

  unsigned ticket;  ///< comes back with the result; not 0
  Operation operation;
  FileKind kind;
  protocol::FileName name;  ///< empty for LIST, and for a picture to STORE, whose name FileKeeper chooses
  size_t size;              ///< bytes of the content for STORE, otherwise 0
  unsigned char content[FILE_CAPACITY];
};

/// FileKeeper.Result: the result of a job.
struct FileResult {
  enum Outcome {
    DONE,
    MISSING,    ///< READ, DELETE: there is no such file
    TOO_LARGE,  ///< READ: the file has more than largestFile() bytes
    NO_STICK,   ///< there is no memory stick in the robot
    LOCKED,     ///< STORE, DELETE: the memory stick is write-protected
    FULL,       ///< STORE of a picture: less than its size and PICTURE_RESERVE is free
    TOO_MANY,   ///< STORE of a picture: the memory stick has as many as can be listed
    NO_NUMBER,  ///< STORE of a picture: the highest number has been given to one that is still there
    FAILED      ///< the memory stick failed; after STORE, nothing of the content is left on it
  };

  unsigned ticket;  ///< of the job
  Outcome outcome;
  protocol::FileName name;               ///< after STORE of a picture
  size_t size;                           ///< bytes of the content after READ, otherwise 0
  unsigned char content[FILE_CAPACITY];  ///< after READ
  protocol::version2::FileList list;     ///< after LIST
};

#endif  // AIBO_RCSERVER_FILE_KEEPER_FILE_JOB_H
