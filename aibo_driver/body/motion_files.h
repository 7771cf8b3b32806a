/// @file motion_files.h
#ifndef AIBO_DRIVER_BODY_MOTION_FILES_H
#define AIBO_DRIVER_BODY_MOTION_FILES_H

#include <cstdint>
#include <string>
#include <vector>

namespace aibo_driver::body {

/// The name of a motion's file on the robot: "nod", "NOD.MTN" and "nod.mtn" all mean NOD.MTN. The empty name stays
/// empty. The client checks whether the robot allows such a name.
std::string motionFileName(const std::string& name);

/// Reads a motion from a file of this computer. Whoever may ask for an upload may name any file, and the robot's place
/// may be taken by somebody else: so nothing but motions leaves this computer.
/// @throw files::FileException the file cannot be read, or is not a whole motion; the message says why
std::vector<std::uint8_t> loadMotion(const std::string& path);

}  // namespace aibo_driver::body

#endif  // AIBO_DRIVER_BODY_MOTION_FILES_H
