/// @file file_saver.h
#ifndef AIBO_DRIVER_ROS_CAMERA_FILE_SAVER_H
#define AIBO_DRIVER_ROS_CAMERA_FILE_SAVER_H

#include <cstdint>
#include <string>
#include <vector>

#include "aibo_driver/exceptions.h"

namespace aibo_driver::node {

/// A file could not be saved; the message says why and what to do.
class SaveException : public Exception {
 public:
  using Exception::Exception;
};

/// Writes the whole file or, on any error, leaves what was there before. Whoever looks never sees half a file.
/// @param path absolute, or relative to the working directory of the process; `~` is not expanded. Ends in .jpg or
///   .jpeg, in upper or lower case: programs go by the name, and the robot makes no other pictures
/// @return the absolute path of the file
/// @throw SaveException the name is not that of a JPEG, the folder does not exist, permission is missing, the disk is
/// full, the path names something
///   that is no regular file, ...
std::string saveJpeg(const std::string& path, const std::vector<std::uint8_t>& jpeg);

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_CAMERA_FILE_SAVER_H
