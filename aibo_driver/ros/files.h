/// @file files.h
/// Files on the driver's machine that users name in service calls. A path is absolute, or relative to the working
/// directory of the process; `~` is not expanded.
#ifndef AIBO_DRIVER_ROS_FILES_H
#define AIBO_DRIVER_ROS_FILES_H

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "aibo_driver/exceptions.h"

namespace aibo_driver::node {

/// A file could not be read or written; the message says why, and what to do.
class FileException : public Exception {
 public:
  using Exception::Exception;
};

/// Reads a whole file.
/// @param longest the most bytes that it may have
/// @throw FileException it does not exist, may not be read, is not a regular file, is longer, ...
std::vector<std::uint8_t> loadFile(const std::string& path, std::size_t longest);

/// Writes a whole file. On any error it leaves what was there before; nobody ever sees half a file.
/// @param path ends in .jpg or .jpeg, in upper or lower case: programs go by the name, and the robot's pictures are
///   JPEGs
/// @return the absolute path of the file
/// @throw FileException the name is not that of a JPEG, the folder does not exist, permission is missing, the disk is
///   full, the path names something other than a regular file, ...
std::string saveJpeg(const std::string& path, const std::vector<std::uint8_t>& jpeg);

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_FILES_H
