/// @file StickFiles.h
/// The motions and pictures on the memory stick.
#ifndef AIBO_RCSERVER_FILE_KEEPER_STICK_FILES_H
#define AIBO_RCSERVER_FILE_KEEPER_STICK_FILES_H

#include <stddef.h>

#include "file_keeper/FileJob.h"
#include "objects/HostSettings.h"
#include "protocol/file_list.h"
#include "protocol/text.h"

/// Reads, stores, deletes and lists files of both kinds, whatever they contain.
///
/// A file's name cannot lead out of the folder (text.h). The memory stick ignores upper and lower case, but other file
/// systems do not. So a file is searched for in the folder, and found whatever the case of its letters.
///
/// A new file is written under another name first, so that a file under its own name is always complete.
///
/// The memory stick makes the caller wait: some tenths of a second for a large file.
class StickFiles {
 public:
  /// The highest number in the name of a picture: AIBO9999.JPG.
  static const int HIGHEST_NUMBER = 9999;

  /// @param host says where the memory stick is; must outlive this
  explicit StickFiles(const HostSettings& host) : host_(host) {}

  /// Does a job, by one of the functions below.
  /// @param[out] result only the members that belong to the job's operation are written
  void CarryOut(const FileJob& job, FileResult* result) const;

  /// Reads a whole file.
  /// @param[out] bytes room for capacity bytes
  /// @param[out] size of the file, if DONE
  FileResult::Outcome Read(FileKind kind, const protocol::FileName& name, unsigned char* bytes, size_t capacity,
                           size_t* size) const;

  /// Stores a motion and replaces one of the same name.
  /// @return DONE or FAILED, as on a memory stick that is full; nothing of it is left then
  FileResult::Outcome StoreMotion(const protocol::MotionName& name, const unsigned char* bytes, size_t size) const;

  /// Stores a picture under a new name: AIBO0001.JPG, or the number after the highest that is there. Replaces nothing.
  /// OPEN-R does not tell how much is free, so PICTURE_RESERVE is written beside the picture, and removed again.
  /// @param[out] name if DONE
  /// @return DONE, FULL, TOO_MANY, NO_NUMBER or FAILED; unless DONE, nothing of it is left
  FileResult::Outcome StorePicture(const unsigned char* bytes, size_t size, protocol::PictureName& name) const;

  FileResult::Outcome Delete(FileKind kind, const protocol::FileName& name) const;

  /// @param[out] list all files of this kind, sorted by name; if there are too many, some are missing
  void List(FileKind kind, protocol::version2::FileList* list) const;

 private:
  StickFiles(const StickFiles&);
  StickFiles& operator=(const StickFiles&);

  bool Find(FileKind kind, const protocol::FileName& name, char (&path)[MAX_PATH_SIZE]) const;
  FileResult::Outcome ChooseName(protocol::PictureName& name) const;
  bool HasReserve() const;
  bool Write(const char* path, const unsigned char* bytes, size_t size) const;

  const HostSettings& host_;
};

#endif  // AIBO_RCSERVER_FILE_KEEPER_STICK_FILES_H
