/// @file MotionFiles.h
/// The motions on the memory stick.
#ifndef RCSERVER_MEMORY_STICK_MOTION_FILES_H
#define RCSERVER_MEMORY_STICK_MOTION_FILES_H

#include <stddef.h>

#include "protocol/motion_name.h"
#include "protocol/motion_requests.h"
#include "rcserver/memory_stick/HostSettings.h"

/// Where they are on the memory stick.
const char MOTION_FOLDER[] = "OPEN-R/MW/DATA/P";

/// Reads, stores, deletes and lists motion files. Does not look into them.
///
/// A motion's name leads nowhere but into the folder (motion_name.h). The memory stick takes capitals and small letters
/// for the same; other file systems do not, so a file is looked for in the folder, and what is there once is found
/// however it is spelled.
///
/// The memory stick makes the caller wait: some tenths of a second for a large file.
class MotionFiles {
 public:
  /// @param host whose memory stick it is; must outlive this
  explicit MotionFiles(const HostSettings& host) : host_(host) {}

  /// What reading or deleting a file has come to.
  enum Result { DONE, MISSING, TOO_LARGE, FAILED };

  /// Reads a whole file.
  /// @param[out] bytes room for capacity bytes
  /// @param[out] size of the file, if DONE
  Result Read(const protocol::MotionName& name, unsigned char* bytes, size_t capacity, size_t* size) const;

  /// Stores a whole file, in the place of one of that name: under another name first, so that a file under its own name
  /// is always whole.
  /// @return false if it could not be written, as on a memory stick that is full or locked; nothing is left of it then
  bool Store(const protocol::MotionName& name, const unsigned char* bytes, size_t size) const;

  Result Delete(const protocol::MotionName& name) const;

  /// @param[out] list the motions there are, in the order of their names; so many as find room
  void List(protocol::version2::MotionList* list) const;

 private:
  MotionFiles(const MotionFiles&);
  MotionFiles& operator=(const MotionFiles&);

  bool Find(const protocol::MotionName& name, char (&path)[MAX_PATH_SIZE]) const;

  const HostSettings& host_;
};

#endif  // RCSERVER_MEMORY_STICK_MOTION_FILES_H
