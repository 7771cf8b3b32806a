#include "file_keeper/StickFiles.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

using protocol::FileName;
using protocol::PictureName;
using protocol::version2::FileList;
using protocol::version2::MAX_LISTED_FILES;

const int StickFiles::HIGHEST_NUMBER;

namespace {

// A new file gets this name until it is complete. No motion and no picture can have this name.
const char TEMPORARY_FILE[] = "UPLOAD.TMP";

// A file of this name is written to find out whether there is free space.
const char RESERVE_FILE[] = "RESERVE.TMP";

const char NUMBERED_NAME[] = "AIBO%04d.JPG";

// Reads the names of files of one kind on the memory stick.
class FolderReader {
 public:
  FolderReader(const HostSettings& host, FileKind kind)
      : read_(kind == MOTION_FILE ? protocol::readMotionName : protocol::readPictureName), folder_(NULL) {
    char path[MAX_PATH_SIZE];
    if (pathOnMemoryStick(host, DATA_FOLDER, path)) {
      folder_ = opendir(path);
    }
  }
  ~FolderReader() {
    if (folder_ != NULL) {
      closedir(folder_);
    }
  }

  bool IsOpen() const { return folder_ != NULL; }

  // Sets the next file's name, in capitals. Returns the name as it is spelled, or NULL at the end.
  const char* Next(FileName& name) {
    const dirent* entry = NULL;
    while (folder_ != NULL && (entry = readdir(folder_)) != NULL) {
      if (read_(entry->d_name, strlen(entry->d_name), name) == NULL) {
        return entry->d_name;
      }
    }
    return NULL;
  }

 private:
  FolderReader(const FolderReader&);
  FolderReader& operator=(const FolderReader&);

  const protocol::version2::ReadFileName read_;
  DIR* folder_;
};

bool PathInFolder(const HostSettings& host, const char* file, char (&path)[MAX_PATH_SIZE]) {
  char name[sizeof(DATA_FOLDER) + protocol::MAX_FILE_NAME_SIZE + 1];
  sprintf(name, "%s/%.12s", DATA_FOLDER, file);
  return pathOnMemoryStick(host, name, path);
}

// The number in a picture's name; 0 if the name is of another kind.
int NumberIn(const PictureName& name) {
  int number = 0;
  PictureName again;
  if (sscanf(name, NUMBERED_NAME, &number) != 1 || number < 1 || number > StickFiles::HIGHEST_NUMBER) {
    return 0;
  }
  sprintf(again, NUMBERED_NAME, number);
  return strcmp(again, name) == 0 ? number : 0;
}

// Renames a file. Some file systems cannot rename a file to a name that already exists.
bool Rename(const char* from, const char* to) {
  if (rename(from, to) == 0) {
    return true;
  }
  remove(to);
  return rename(from, to) == 0;
}

int CompareNames(const void* a, const void* b) {
  return strcmp(static_cast<const char*>(a), static_cast<const char*>(b));
}

}  // namespace

FileResult::Outcome StickFiles::CarryOut(const FileJob& job, FileResult* result) const {
  switch (job.operation) {
    case FileJob::READ:
      return Read(job, result);
    case FileJob::STORE:
      return job.kind == MOTION_FILE ? StoreMotion(job) : StorePicture(job, result->name);
    case FileJob::DELETE:
      return Delete(job);
    default:
      return List(job.kind, &result->list);
  }
}

FileResult::Outcome StickFiles::Read(const FileJob& job, FileResult* result) const {
  char path[MAX_PATH_SIZE];
  if (!Find(job.kind, job.name, path)) {
    return FileResult::MISSING;
  }
  FILE* const file = host_.open_to_read(path);
  if (file == NULL) {
    return FileResult::FAILED;
  }
  result->size = fread(result->content, 1, largestFile(job.kind), file);
  const bool is_whole = getc(file) == EOF;
  const bool has_failed = ferror(file) != 0;
  fclose(file);
  if (has_failed) {
    return FileResult::FAILED;
  }
  return is_whole ? FileResult::DONE : FileResult::TOO_LARGE;
}

FileResult::Outcome StickFiles::StoreMotion(const FileJob& job) const {
  char path[MAX_PATH_SIZE];
  char temporary_path[MAX_PATH_SIZE];
  const bool has_path = Find(MOTION_FILE, job.name, path) || PathInFolder(host_, job.name, path);
  if (!has_path || !PathInFolder(host_, TEMPORARY_FILE, temporary_path)) {
    return FileResult::FAILED;
  }
  if (Write(temporary_path, job.content, job.size) && Rename(temporary_path, path)) {
    return FileResult::DONE;
  }
  remove(temporary_path);
  return FileResult::FAILED;
}

// The reserve is written while the picture has its temporary name. The final name is new, so nothing is replaced.
FileResult::Outcome StickFiles::StorePicture(const FileJob& job, PictureName& name) const {
  char path[MAX_PATH_SIZE];
  char temporary_path[MAX_PATH_SIZE];
  const FileResult::Outcome outcome = ChooseName(name);
  if (outcome != FileResult::DONE) {
    return outcome;
  }
  if (!PathInFolder(host_, name, path) || !PathInFolder(host_, TEMPORARY_FILE, temporary_path)) {
    return FileResult::FAILED;
  }
  const bool fits = Write(temporary_path, job.content, job.size) && HasReserve();
  if (fits && rename(temporary_path, path) == 0) {
    return FileResult::DONE;
  }
  remove(temporary_path);
  return fits ? FileResult::FAILED : FileResult::FULL;
}

FileResult::Outcome StickFiles::Delete(const FileJob& job) const {
  char path[MAX_PATH_SIZE];
  if (!Find(job.kind, job.name, path)) {
    return FileResult::MISSING;
  }
  return remove(path) == 0 ? FileResult::DONE : FileResult::FAILED;
}

FileResult::Outcome StickFiles::List(FileKind kind, FileList* list) const {
  list->count = 0;
  FolderReader folder(host_, kind);
  while (list->count < MAX_LISTED_FILES && folder.Next(list->names[list->count]) != NULL) {
    ++list->count;
  }
  qsort(list->names, list->count, sizeof(FileName), CompareNames);
  return FileResult::DONE;
}

bool StickFiles::Find(FileKind kind, const FileName& name, char (&path)[MAX_PATH_SIZE]) const {
  FolderReader folder(host_, kind);
  FileName found;
  while (const char* spelled = folder.Next(found)) {
    if (strcmp(found, name) == 0) {
      return PathInFolder(host_, spelled, path);
    }
  }
  return false;
}

// readdir() sees at most 682 files in a folder (Programmer's Guide, A.1). The folder has fewer: MAX_LISTED_FILES
// pictures and a few motions.
FileResult::Outcome StickFiles::ChooseName(PictureName& name) const {
  FolderReader folder(host_, PICTURE_FILE);
  if (!folder.IsOpen()) {
    return FileResult::FAILED;
  }
  size_t count = 0;
  int highest = 0;
  PictureName found;
  for (; folder.Next(found) != NULL; ++count) {
    const int number = NumberIn(found);
    highest = number > highest ? number : highest;
  }
  if (count >= MAX_LISTED_FILES) {
    return FileResult::TOO_MANY;
  }
  if (highest == HIGHEST_NUMBER) {
    return FileResult::NO_NUMBER;
  }
  sprintf(name, NUMBERED_NAME, highest + 1);
  return FileResult::DONE;
}

bool StickFiles::HasReserve() const {
  static const unsigned char RESERVED[PICTURE_RESERVE] = {0};
  char path[MAX_PATH_SIZE];
  if (!PathInFolder(host_, RESERVE_FILE, path)) {
    return false;
  }
  const bool is_free = Write(path, RESERVED, PICTURE_RESERVE);
  remove(path);
  return is_free;
}

// Writes a file, but first removes the old one: on a computer it could be a link to a file that must stay as it is.
bool StickFiles::Write(const char* path, const unsigned char* bytes, size_t size) const {
  remove(path);
  if (host_.room != NULL && size > *host_.room) {
    return false;
  }
  FILE* const file = fopen(path, "wb");
  if (file == NULL) {
    return false;
  }
  const bool is_written = fwrite(bytes, 1, size, file) == size;
  return fclose(file) == 0 && is_written;
}
