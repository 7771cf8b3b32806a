/// @file files.h
/// Files that users name in service calls or on a command line. They are on this computer, which for service calls is
/// the driver's machine, or on the robot's memory stick. `~` is not expanded.
#ifndef AIBO_DRIVER_FILES_FILES_H
#define AIBO_DRIVER_FILES_FILES_H

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "aibo_client/exceptions.h"
#include "host_files/file_descriptor.h"

namespace aibo_driver::files {

/// Thrown if a file could not be read or written. The message says why, and what to do.
class FileException : public aibo_client::Exception {
 public:
  using Exception::Exception;
};

/// Opens a file to read it. If the file is gzipped, opens its content, in memory.
/// @param path an absolute path, or a path relative to the working directory of the process
/// @param longest_unpacked the largest number of bytes that a gzipped file may have, before and after it is unpacked
/// @throw FileException the file does not exist, may not be read or is not a regular file; the path holds control
///   characters; it is gzipped, and damaged or too long; ...
host_files::FileDescriptor openToRead(const std::string& path, std::size_t longest_unpacked);

/// A file in memory, open for reading and writing at its beginning.
/// @param name for messages
/// @throw FileException there is no memory for it
host_files::FileDescriptor memoryFile(const std::string& name, const std::string& content);

/// Reads a whole file.
/// @param path for openToRead()
/// @param longest the largest number of bytes that the file may have, unpacked
/// @throw FileException it cannot be opened, or is longer; ...
std::vector<std::uint8_t> loadFile(const std::string& path, std::size_t longest);

/// Where ROS keeps files for its user: the environment's ROS_HOME, or else ~/.ros. `~` is the environment's HOME, or
/// else the folder that the system has for the user, because services and containers may have no HOME. rospkg's
/// get_ros_home() finds the same folder. Any thread may call it.
/// @return an absolute path
/// @throw FileException there is no such folder, because neither variable is set and the user has no home
std::string rosHome();

/// The folder in which pictures are saved.
/// @param chosen the user's choice; if empty, ~/Pictures if it exists, or else rosHome()
/// @throw FileException the user has chosen nothing, and has no home: see rosHome()
std::string pictureFolder(const std::string& chosen);

/// A name for a new picture, with the local time in it, such as aibo_20261122_185601_123.jpg.
std::string nameForPicture();

/// Reads a motion, gzipped or not. Anybody who may ask for an upload may name any file, and somebody else may have
/// taken the robot's place. So only motions may leave this computer.
/// @throw FileException the file cannot be read, or is not a whole motion; the message says why
std::vector<std::uint8_t> loadMotion(const std::string& path);

/// Writes a picture to a file, without its comments and application data (withoutComments()). If this fails, the file
/// stays as it was (replace_file.h).
///
/// Anybody who reaches the ROS master may call take_picture, and whoever plays the robot chooses the picture. So
/// pictures only go into the folder for pictures, and only replace JPEGs.
/// @param folder the folder for pictures; "/" allows all folders
/// @param path an absolute path in this folder, or a path relative to it. It ends in .jpg or .jpeg, in upper or lower
///   case, because programs go by the name, and the robot's pictures are JPEGs
/// @return the absolute path of the file
/// @throw FileException the path holds control characters, the file is not in the folder, the name is not that of a
///   JPEG, the file exists and is not a JPEG, its folder does not exist, permission is missing, the disk is full, ...
std::string saveJpeg(const std::string& folder, const std::string& path, const std::vector<std::uint8_t>& jpeg);

/// Writes a file. If this fails, the file stays as it was (replace_file.h).
/// @throw FileException the path holds control characters, or host_files::replaceFile() fails
void replaceFile(const std::string& path, const std::string& content);

/// The picture without the segments that programs ignore and in which anything could be hidden. These are comments, and
/// application data other than a JFIF header without a thumbnail. Everything that makes up the image stays as it is.
/// @throw FileException the bytes before the image data are not segments of a JPEG
std::vector<std::uint8_t> withoutComments(const std::vector<std::uint8_t>& jpeg);

/// The name of a motion's file on the robot's memory stick: "nod", "NOD.MTN" and "nod.mtn" all mean NOD.MTN. The empty
/// name stays empty. A name that is not plain text gets a '?', which no file's name may have, because names are quoted
/// in many places. The client checks whether the robot allows such a name.
std::string motionFileName(const std::string& name);

/// The name of a picture's file on the robot's memory stick: "aibo0001" means AIBO0001.JPG.
std::string pictureFileName(const std::string& name);

}  // namespace aibo_driver::files

#endif  // AIBO_DRIVER_FILES_FILES_H
