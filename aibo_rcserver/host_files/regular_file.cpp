#include "host_files/regular_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace host_files {

FileDescriptor openRegularFile(const std::string& path) {
  struct stat properties {};
  if (::stat(path.c_str(), &properties) != 0) {
    throw Unreadable(std::strerror(errno));
  }
  if (!S_ISREG(properties.st_mode)) {  // merely opening a device can have an effect
    throw Unreadable("it is not a regular file");
  }
  // If the path has meanwhile become a pipe, open() must not wait for a writer.
  FileDescriptor file(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
  if (!file.valid()) {
    throw Unreadable(std::strerror(errno));
  }
  if (::fstat(file.get(), &properties) != 0 || !S_ISREG(properties.st_mode)) {
    throw Unreadable("it is not a regular file");
  }
  return file;
}

std::FILE* openToRead(const char* path) {
  try {
    return ::fdopen(openRegularFile(path).release(), "rb");
  } catch (const Unreadable&) {
    return nullptr;
  }
}

std::vector<unsigned char> readRegularFile(int descriptor, std::size_t longest) {
  struct stat properties {};
  if (::fstat(descriptor, &properties) != 0) {
    throw Unreadable(std::strerror(errno));
  }
  const auto size = static_cast<std::size_t>(properties.st_size);
  if (size > longest) {
    throw Unreadable("it has more than the " + std::to_string(longest) + " bytes allowed");
  }
  // Files of the kernel have no size, may block their readers, and end at a different place each time.
  std::vector<unsigned char> bytes(size);
  std::size_t read = 0;
  for (ssize_t count = 1; count > 0 && read < size; read += static_cast<std::size_t>(count > 0 ? count : 0)) {
    count = ::read(descriptor, bytes.data() + read, size - read);
  }
  if (read < size) {
    throw Unreadable("fewer bytes than its size can be read");
  }
  return bytes;
}

std::vector<unsigned char> readRegularFile(const std::string& path, std::size_t longest) {
  const FileDescriptor file = openRegularFile(path);
  return readRegularFile(file.get(), longest);
}

}  // namespace host_files
