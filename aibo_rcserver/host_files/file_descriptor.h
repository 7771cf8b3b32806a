/// @file file_descriptor.h
#ifndef AIBO_RCSERVER_HOST_FILES_FILE_DESCRIPTOR_H
#define AIBO_RCSERVER_HOST_FILES_FILE_DESCRIPTOR_H

#include <unistd.h>

#include <utility>

namespace host_files {

/// Owns at most one file descriptor and closes it.
class FileDescriptor {
 public:
  FileDescriptor() = default;
  explicit FileDescriptor(int number) : number_(number) {}
  FileDescriptor(FileDescriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept {
    std::swap(number_, other.number_);
    other.close();
    return *this;
  }
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;
  ~FileDescriptor() { close(); }

  /// @return the descriptor's number; -1 if nothing is open
  int get() const { return number_; }
  bool valid() const { return number_ >= 0; }

  /// @return the descriptor, which the caller closes
  int release() { return std::exchange(number_, -1); }

  void close() noexcept {
    if (valid()) {
      ::close(release());
    }
  }

 private:
  int number_ = -1;
};

}  // namespace host_files

#endif  // AIBO_RCSERVER_HOST_FILES_FILE_DESCRIPTOR_H
