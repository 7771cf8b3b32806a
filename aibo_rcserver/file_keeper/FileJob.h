/// @file FileJob.h
/// The messages between RCServer and FileKeeper.
#ifndef AIBO_RCSERVER_FILE_KEEPER_FILE_JOB_H
#define AIBO_RCSERVER_FILE_KEEPER_FILE_JOB_H

#include <stddef.h>

#include "mtn/layout.h"
#include "protocol/file_list.h"
#include "protocol/stick_pictures.h"
#include "protocol/text.h"

/// The folder with the motions and pictures. Programs may write to this folder, as Sony's sample ImageCapture does.
const char DATA_FOLDER[] = "OPEN-R/MW/DATA/P";

/// The largest motion or picture, in bytes.
const size_t FILE_CAPACITY = protocol::version2::MAX_STICK_PICTURE_SIZE;

/// How many bytes pictures leave free: for a motion, RCSERVER.CFG and the log of a crash (EMON.LOG).
const size_t PICTURE_RESERVE = 64 * 1024;

enum FileKind { MOTION_FILE, PICTURE_FILE };

inline size_t largestFile(FileKind kind) {
  return kind == MOTION_FILE ? static_cast<size_t>(mtn::MAX_FILE_SIZE) : FILE_CAPACITY;
}

/// RCServer.FileJob: a job on the memory stick.
struct FileJob {
  enum Operation { READ, STORE, DELETE, LIST };

  unsigned ticket;  ///< the job's number, not 0, which its result repeats
  Operation operation;
  FileKind kind;
  protocol::FileName name;  ///< empty for LIST, and if a picture is stored: FileKeeper chooses its name
  size_t size;              ///< bytes of the content for STORE, otherwise 0
  unsigned char content[FILE_CAPACITY];
};

/// FileKeeper.Result: the result of a job.
struct FileResult {
  enum Outcome {
    DONE,
    MISSING,    ///< READ, DELETE: the file does not exist
    TOO_LARGE,  ///< READ: the file is larger than largestFile()
    NO_STICK,   ///< the robot has no memory stick
    LOCKED,     ///< STORE, DELETE: the memory stick is write-protected
    FULL,       ///< STORE of a picture: less than its size plus PICTURE_RESERVE is free
    TOO_MANY,   ///< STORE of a picture: the memory stick already has as many as a list can hold
    NO_NUMBER,  ///< STORE of a picture: a picture already has the highest number
    FAILED      ///< the memory stick failed; a STORE has left nothing
  };

  unsigned ticket;  ///< the job's ticket
  Outcome outcome;
  protocol::FileName name;               ///< set after STORE of a picture
  size_t size;                           ///< bytes of the content; only after a READ that is DONE
  unsigned char content[FILE_CAPACITY];  ///< set after READ
  protocol::version2::FileList list;     ///< set after LIST
};

#endif  // AIBO_RCSERVER_FILE_KEEPER_FILE_JOB_H
