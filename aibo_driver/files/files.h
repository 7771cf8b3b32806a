/// @file files.h
/// Files that users name in service calls, for which it is the driver's machine, or on a command line: on this
/// computer, where `~` is not expanded, and on the robot's memory stick.
#ifndef AIBO_DRIVER_FILES_FILES_H
#define AIBO_DRIVER_FILES_FILES_H

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "aibo_driver/exceptions.h"

namespace aibo_driver::files {

/// A file could not be read or written; the message says why, and what to do.
class FileException : public Exception {
 public:
  using Exception::Exception;
};

/// Reads a whole file.
/// @param path absolute, or relative to the working directory of the process
/// @param longest the most bytes that it may have
/// @throw FileException it does not exist, may not be read, is not a regular file, is longer, the path holds control
///   characters, ...
std::vector<std::uint8_t> loadFile(const std::string& path, std::size_t longest);

/// Where pictures are saved.
/// @param chosen by the user; empty: ~/Pictures if there is such a folder, or else ROS_HOME, or else ~/.ros
std::string pictureFolder(const std::string& chosen);

/// Reads a motion. Whoever may ask for an upload may name any file, and the robot's place may be taken by somebody
/// else: so nothing but motions leaves this computer.
/// @throw FileException the file cannot be read, or is not a whole motion; the message says why
std::vector<std::uint8_t> loadMotion(const std::string& path);

/// Writes a picture to a file, without its comments and application data (withoutComments()). On any error it leaves
/// what was there before; nobody ever sees half a file.
///
/// Anybody who reaches the ROS master may call take_picture, and whoever plays the robot chooses the picture. So it
/// gets only into the folder for pictures, and replaces nothing but JPEGs.
/// @param folder for pictures; "/" allows all
/// @param path in this folder, absolute or relative to it; ends in .jpg or .jpeg, in upper or lower case: programs go
///   by the name, and the robot's pictures are JPEGs
/// @return the absolute path of the file
/// @throw FileException the path holds control characters, the file is not in the folder, the name is not that of a
/// JPEG, the file exists and is not a
///   JPEG, its folder does not exist, permission is missing, the disk is full, ...
std::string saveJpeg(const std::string& folder, const std::string& path, const std::vector<std::uint8_t>& jpeg);

/// The picture without the segments that programs ignore and in which anything could be hidden: comments, and
/// application data other than a JFIF header without a thumbnail. Everything that makes up the image stays as it is.
/// @throw FileException the bytes before the image data are not segments of a JPEG
std::vector<std::uint8_t> withoutComments(const std::vector<std::uint8_t>& jpeg);

/// The name of a motion's file on the robot's memory stick: "nod", "NOD.MTN" and "nod.mtn" all mean NOD.MTN. The empty
/// name stays empty. The client checks whether the robot allows such a name.
std::string motionFileName(const std::string& name);

/// The same for a picture: "aibo0001" means AIBO0001.JPG.
std::string pictureFileName(const std::string& name);

}  // namespace aibo_driver::files

#endif  // AIBO_DRIVER_FILES_FILES_H
