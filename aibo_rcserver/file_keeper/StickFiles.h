/// @file StickFiles.h
/// The motions and pictures on the memory stick.
#ifndef AIBO_RCSERVER_FILE_KEEPER_STICK_FILES_H
#define AIBO_RCSERVER_FILE_KEEPER_STICK_FILES_H

#include <stddef.h>

#include "file_keeper/FileJob.h"
#include "objects/HostSettings.h"
#include "protocol/file_list.h"
#include "protocol/text.h"

/// Reads, stores, deletes and lists motions and pictures, without looking at their content.
///
/// A name cannot lead out of the folder (text.h). Some file systems distinguish upper and lower case, and the memory
/// stick does not, so a search ignores case. A file is first written under another name, so that a file with its own
/// name is always complete.
///
/// If a file is large, a call can take some tenths of a second.
class StickFiles {
 public:
  /// The highest number in a picture's name: AIBO9999.JPG.
  static const int HIGHEST_NUMBER = 9999;

  /// @param host the host, which gives the folder of the memory stick
  explicit StickFiles(const HostSettings& host) : host_(host) {}

  /// Carries out a job. A motion replaces one of the same name. A picture gets a new name: AIBO0001.JPG, or the highest
  /// number so far plus one. OPEN-R does not report the free space, so PICTURE_RESERVE bytes are written beside the
  /// picture and removed again. A list is sorted by name; if there are too many files, some are missing.
  /// @param[out] result the members for the job's operation; they count only if the outcome is DONE
  FileResult::Outcome CarryOut(const FileJob& job, FileResult* result) const;

 private:
  StickFiles(const StickFiles&);
  StickFiles& operator=(const StickFiles&);

  FileResult::Outcome Read(const FileJob& job, FileResult* result) const;
  FileResult::Outcome StoreMotion(const FileJob& job) const;
  FileResult::Outcome StorePicture(const FileJob& job, protocol::PictureName& name) const;
  FileResult::Outcome Delete(const FileJob& job) const;
  FileResult::Outcome List(FileKind kind, protocol::version2::FileList* list) const;
  bool Find(FileKind kind, const protocol::FileName& name, char (&path)[MAX_PATH_SIZE]) const;
  FileResult::Outcome ChooseName(protocol::PictureName& name) const;
  bool HasReserve() const;
  bool Write(const char* path, const unsigned char* bytes, size_t size) const;

  const HostSettings& host_;
};

#endif  // AIBO_RCSERVER_FILE_KEEPER_STICK_FILES_H
