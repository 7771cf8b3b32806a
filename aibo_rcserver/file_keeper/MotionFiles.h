/// @file MotionFiles.h
/// The motions on the memory stick.
#ifndef AIBO_RCSERVER_FILE_KEEPER_MOTION_FILES_H
#define AIBO_RCSERVER_FILE_KEEPER_MOTION_FILES_H

#include <stddef.h>

#include "file_keeper/FileJob.h"
#include "objects/HostSettings.h"
#include "protocol/motion_requests.h"
#include "protocol/text.h"

/// Reads, stores, deletes and lists motion files. Does not look into them.
///
/// A motion's name leads nowhere but into the folder (text.h). The memory stick takes capitals and small letters
/// for the same; other file systems do not, so a file is looked for in the folder, and what is there once is found
/// however it is spelled.
///
/// The memory stick makes the caller wait: some tenths of a second for a large file.
class MotionFiles {
 public:
  /// @param host whose memory stick it is; must outlive this
  explicit MotionFiles(const HostSettings& host) : host_(host) {}

  /// Does a job by one of the functions below.
  /// @param[out] result all of it but what the job's operation does not give
  void CarryOut(const FileJob& job, FileResult* result) const;

  /// Reads a whole file.
  /// @param[out] bytes room for capacity bytes
  /// @param[out] size of the file, if DONE
  FileResult::Outcome Read(const protocol::MotionName& name, unsigned char* bytes, size_t capacity, size_t* size) const;

  /// Stores a whole file, in the place of one of that name: under another name first, so that a file under its own name
  /// is always whole.
  /// @return false if it could not be written, as on a memory stick that is full or locked; nothing is left of it then
  bool Store(const protocol::MotionName& name, const unsigned char* bytes, size_t size) const;

  FileResult::Outcome Delete(const protocol::MotionName& name) const;

  /// @param[out] list the motions there are, in the order of their names, as many as there is room for
  void List(protocol::version2::MotionList* list) const;

 private:
  MotionFiles(const MotionFiles&);
  MotionFiles& operator=(const MotionFiles&);

  bool Find(const protocol::MotionName& name, char (&path)[MAX_PATH_SIZE]) const;

  const HostSettings& host_;
};

#endif  // AIBO_RCSERVER_FILE_KEEPER_MOTION_FILES_H
