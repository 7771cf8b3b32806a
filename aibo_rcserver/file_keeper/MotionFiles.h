/// @file MotionFiles.h
/// The motion files on the memory stick.
#ifndef AIBO_RCSERVER_FILE_KEEPER_MOTION_FILES_H
#define AIBO_RCSERVER_FILE_KEEPER_MOTION_FILES_H

#include <stddef.h>

#include "file_keeper/FileJob.h"
#include "objects/HostSettings.h"
#include "protocol/motion_requests.h"
#include "protocol/text.h"

/// Reads, stores, deletes and lists motion files, whatever they contain.
///
/// A motion's name cannot lead out of the folder (motion_name.h). The memory stick ignores upper and lower case, but
/// other file systems do not. So a file is searched for in the folder, and found whatever the case of its letters.
///
/// The memory stick makes the caller wait: some tenths of a second for a large file.
class MotionFiles {
 public:
  /// @param host says where the memory stick is; must outlive this
  explicit MotionFiles(const HostSettings& host) : host_(host) {}

  /// Does a job, by one of the functions below.
  /// @param[out] result only the members that belong to the job's operation are written
  void CarryOut(const FileJob& job, FileResult* result) const;

  /// Reads a whole file.
  /// @param[out] bytes room for capacity bytes
  /// @param[out] size of the file, if DONE
  FileResult::Outcome Read(const protocol::MotionName& name, unsigned char* bytes, size_t capacity, size_t* size) const;

  /// Stores a file and replaces one of the same name. It is written under another name first, so that a file under its
  /// own name is always complete.
  /// @return false if it could not be written, as on a memory stick that is full or locked; nothing of it is left then
  bool Store(const protocol::MotionName& name, const unsigned char* bytes, size_t size) const;

  FileResult::Outcome Delete(const protocol::MotionName& name) const;

  /// @param[out] list all motions, sorted by name; if there are too many, some are missing
  void List(protocol::version2::MotionList* list) const;

 private:
  MotionFiles(const MotionFiles&);
  MotionFiles& operator=(const MotionFiles&);

  bool Find(const protocol::MotionName& name, char (&path)[MAX_PATH_SIZE]) const;

  const HostSettings& host_;
};

#endif  // AIBO_RCSERVER_FILE_KEEPER_MOTION_FILES_H
