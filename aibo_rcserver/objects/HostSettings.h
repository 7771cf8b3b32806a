/// @file HostSettings.h
/// What a computer that stands in for the robot may have otherwise than the robot.
#ifndef AIBO_RCSERVER_OBJECTS_HOST_SETTINGS_H
#define AIBO_RCSERVER_OBJECTS_HOST_SETTINGS_H

#include <stddef.h>

#include "protocol/version2.h"

/// Made with what holds on the robot.
struct HostSettings {
  HostSettings() : newest_version(protocol::version2::VERSION), memory_stick("/MS") {}

  int newest_version;        ///< of the protocol that is spoken if a client asks for it: 1 or 2
  const char* memory_stick;  ///< folder that holds what is on the memory stick; has to outlive the server
};

/// Sets what hostSettings() returns. Only a computer that stands in for the robot calls it, before it makes the
/// objects. On the robot each object has memory of its own, and the defaults hold.
void setHostSettings(const HostSettings& settings);

/// The settings of the computer that all objects run on.
const HostSettings& hostSettings();

/// Longest path that pathOnMemoryStick() makes, in bytes with the closing 0. OPEN-R's own paths are far shorter.
const size_t MAX_PATH_SIZE = 1024;

/// The path of a file on the memory stick.
/// @param name from the stick on: "OPEN-R/MW/CONF/RCSERVER.CFG"
/// @param[out] path untouched if it does not fit
/// @return false if it does not fit
bool pathOnMemoryStick(const HostSettings& host, const char* name, char (&path)[MAX_PATH_SIZE]);

#endif  // AIBO_RCSERVER_OBJECTS_HOST_SETTINGS_H
