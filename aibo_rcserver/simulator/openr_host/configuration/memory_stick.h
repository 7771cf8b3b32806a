/// @file memory_stick.h
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONFIGURATION_MEMORY_STICK_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONFIGURATION_MEMORY_STICK_H

#include <filesystem>
#include <string>

namespace openr_host {

/// Finds a file on a memory stick, or a copy of one: the stick's own file system knows no case, Linux does.
/// @param folder the stick
/// @param name path on the stick, "OPEN-R/MW/CONF/OBJECT.CFG"
/// @throw std::runtime_error if there is none; the text names the folder that was searched
std::filesystem::path findOnMemoryStick(const std::filesystem::path& folder, const std::string& name);

/// Whether findOnMemoryStick() would find it.
bool isOnMemoryStick(const std::filesystem::path& folder, const std::string& name);

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONFIGURATION_MEMORY_STICK_H
