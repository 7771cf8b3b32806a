/// @file file_descriptor.h
#ifndef AIBO_DRIVER_SYSTEM_FILE_DESCRIPTOR_H
#define AIBO_DRIVER_SYSTEM_FILE_DESCRIPTOR_H

#include <unistd.h>

#include <utility>

namespace aibo_system {

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

  /// @return the number that the system knows it by; -1 if nothing is open
  int get() const { return number_; }
  bool valid() const { return number_ >= 0; }

  void close() noexcept {
    if (valid()) {
      ::close(std::exchange(number_, -1));
    }
  }

 private:
  int number_ = -1;
};

}  // namespace aibo_system

#endif  // AIBO_DRIVER_SYSTEM_FILE_DESCRIPTOR_H
