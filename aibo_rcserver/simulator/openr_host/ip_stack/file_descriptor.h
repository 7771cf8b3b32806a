/// @file file_descriptor.h
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_FILE_DESCRIPTOR_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_FILE_DESCRIPTOR_H

#include <unistd.h>

#include <utility>

namespace openr_host {

/// Owns a file descriptor.
class FileDescriptor {
 public:
  FileDescriptor() = default;
  explicit FileDescriptor(int fd) : fd_(fd) {}
  ~FileDescriptor() { close(); }
  FileDescriptor(FileDescriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept {
    if (this != &other) {
      close();
      fd_ = std::exchange(other.fd_, -1);
    }
    return *this;
  }

  int get() const { return fd_; }
  bool isOpen() const { return fd_ >= 0; }
  void close() {
    if (fd_ >= 0) {
      ::close(std::exchange(fd_, -1));
    }
  }

 private:
  int fd_ = -1;
};

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_IP_STACK_FILE_DESCRIPTOR_H
