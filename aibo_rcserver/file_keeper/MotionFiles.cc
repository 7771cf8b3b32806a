#include "file_keeper/MotionFiles.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

using protocol::MotionName;
using protocol::readMotionName;
using protocol::version2::MAX_LISTED_MOTIONS;
using protocol::version2::MotionList;

namespace {

// An upload is written to this file, whose name is not a motion's.
const char TEMPORARY_FILE[] = "UPLOAD.TMP";

// Goes through the names of the motions on the memory stick.
class FolderReader {
 public:
  explicit FolderReader(const HostSettings& host) : folder_(NULL) {
    char path[MAX_PATH_SIZE];
    if (pathOnMemoryStick(host, MOTION_FOLDER, path)) {
      folder_ = opendir(path);
    }
  }
  ~FolderReader() {
    if (folder_ != NULL) {
      closedir(folder_);
    }
  }

  // The next motion's name, in capitals. Returns it as it is spelled, or NULL at the end.
  const char* Next(MotionName& name) {
    const dirent* entry = NULL;
    while (folder_ != NULL && (entry = readdir(folder_)) != NULL) {
      if (readMotionName(entry->d_name, strlen(entry->d_name), name) == NULL) {
        return entry->d_name;
      }
    }
    return NULL;
  }

 private:
  FolderReader(const FolderReader&);
  FolderReader& operator=(const FolderReader&);

  DIR* folder_;
};

bool PathInFolder(const HostSettings& host, const char* file, char (&path)[MAX_PATH_SIZE]) {
  char name[sizeof(MOTION_FOLDER) + protocol::MAX_MOTION_NAME_SIZE + 1];
  sprintf(name, "%s/%.12s", MOTION_FOLDER, file);
  return pathOnMemoryStick(host, name, path);
}

// Replaces the file. On a computer it could be a link to another one, which must not be written.
bool WriteFile(const char* path, const unsigned char* bytes, size_t size) {
  remove(path);
  FILE* const file = fopen(path, "wb");
  if (file == NULL) {
    return false;
  }
  const bool is_written = fwrite(bytes, 1, size, file) == size;
  return fclose(file) == 0 && is_written;
}

// Some file systems cannot rename a file to a name that exists.
bool Rename(const char* from, const char* to) {
  if (rename(from, to) == 0) {
    return true;
  }
  remove(to);
  return rename(from, to) == 0;
}

// For qsort().
int CompareNames(const void* a, const void* b) {
  return strcmp(static_cast<const char*>(a), static_cast<const char*>(b));
}

}  // namespace

void MotionFiles::CarryOut(const FileJob& job, FileResult* result) const {
  result->ticket = job.ticket;
  result->outcome = FileResult::DONE;
  result->size = 0;
  switch (job.operation) {
    case FileJob::READ:
      result->outcome = Read(job.name, result->content, sizeof(result->content), &result->size);
      break;
    case FileJob::STORE:
      result->outcome = Store(job.name, job.content, job.size) ? FileResult::DONE : FileResult::FAILED;
      break;
    case FileJob::DELETE:
      result->outcome = Delete(job.name);
      break;
    case FileJob::LIST:
      List(&result->list);
      break;
  }
}

FileResult::Outcome MotionFiles::Read(const MotionName& name, unsigned char* bytes, size_t capacity,
                                      size_t* size) const {
  char path[MAX_PATH_SIZE];
  if (!Find(name, path)) {
    return FileResult::MISSING;
  }
  FILE* const file = fopen(path, "rb");
  if (file == NULL) {
    return FileResult::FAILED;
  }
  *size = fread(bytes, 1, capacity, file);
  const bool is_whole = getc(file) == EOF;
  const bool has_failed = ferror(file) != 0;
  fclose(file);
  if (has_failed) {
    return FileResult::FAILED;
  }
  return is_whole ? FileResult::DONE : FileResult::TOO_LARGE;
}

bool MotionFiles::Store(const MotionName& name, const unsigned char* bytes, size_t size) const {
  char path[MAX_PATH_SIZE];
  char temporary_path[MAX_PATH_SIZE];
  const bool has_path = Find(name, path) || PathInFolder(host_, name, path);
  if (!has_path || !PathInFolder(host_, TEMPORARY_FILE, temporary_path)) {
    return false;
  }
  if (WriteFile(temporary_path, bytes, size) && Rename(temporary_path, path)) {
    return true;
  }
  remove(temporary_path);
  return false;
}

FileResult::Outcome MotionFiles::Delete(const MotionName& name) const {
  char path[MAX_PATH_SIZE];
  if (!Find(name, path)) {
    return FileResult::MISSING;
  }
  return remove(path) == 0 ? FileResult::DONE : FileResult::FAILED;
}

void MotionFiles::List(MotionList* list) const {
  list->count = 0;
  FolderReader folder(host_);
  while (list->count < MAX_LISTED_MOTIONS && folder.Next(list->names[list->count]) != NULL) {
    ++list->count;
  }
  qsort(list->names, list->count, sizeof(MotionName), CompareNames);
}

bool MotionFiles::Find(const MotionName& name, char (&path)[MAX_PATH_SIZE]) const {
  FolderReader folder(host_);
  MotionName found;
  while (const char* spelled = folder.Next(found)) {
    if (strcmp(found, name) == 0) {
      return PathInFolder(host_, spelled, path);
    }
  }
  return false;
}
