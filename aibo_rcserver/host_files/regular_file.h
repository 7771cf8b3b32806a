/// @file regular_file.h
/// Reads files that users of this computer name. Only regular files are read, and only up to a length: a pipe would
/// keep its reader waiting, and /dev/zero has no end.
#ifndef AIBO_RCSERVER_HOST_FILES_REGULAR_FILE_H
#define AIBO_RCSERVER_HOST_FILES_REGULAR_FILE_H

#include <cstddef>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <vector>

#include "host_files/file_descriptor.h"

namespace host_files {

/// Thrown if a file cannot be read. The text says why, without the file's name: "it is not a regular file".
class Unreadable : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Opens a file to read it, without ever waiting.
/// @throw Unreadable the file does not exist, is not a regular file or may not be read
FileDescriptor openRegularFile(const std::string& path);

/// Opens a file to read it, as fopen() does. A simulated memory stick uses it (HostSettings::open_to_read()).
/// @return the file; null where openRegularFile() throws
std::FILE* openToRead(const char* path);

/// Reads a whole file.
/// @param descriptor a descriptor from openRegularFile()
/// @param longest the largest number of bytes that the file may have
/// @throw Unreadable the file is longer, or ends before its size, as files of the kernel do
std::vector<unsigned char> readRegularFile(int descriptor, std::size_t longest);

/// Opens, reads and closes a file.
/// @throw Unreadable see openRegularFile() and the function above
std::vector<unsigned char> readRegularFile(const std::string& path, std::size_t longest);

}  // namespace host_files

#endif  // AIBO_RCSERVER_HOST_FILES_REGULAR_FILE_H
