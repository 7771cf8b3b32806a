/// @file file_loader.h
#ifndef AIBO_DRIVER_ROS_BODY_FILE_LOADER_H
#define AIBO_DRIVER_ROS_BODY_FILE_LOADER_H

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "aibo_driver/exceptions.h"

namespace aibo_driver::node {

/// A file could not be read; the message says why and what to do.
class LoadException : public Exception {
 public:
  using Exception::Exception;
};

/// Reads a whole file.
/// @param path absolute, or relative to the working directory of the process; `~` is not expanded
/// @param longest how many bytes it may have
/// @throw LoadException it does not exist, may not be read, is no regular file, is longer, ...
std::vector<std::uint8_t> loadFile(const std::string& path, std::size_t longest);

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_BODY_FILE_LOADER_H
