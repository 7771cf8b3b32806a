/// @file HostSettings.h
/// Settings that differ between the robot and a computer that simulates it.
#ifndef AIBO_RCSERVER_OBJECTS_HOST_SETTINGS_H
#define AIBO_RCSERVER_OBJECTS_HOST_SETTINGS_H

#include <stddef.h>

#include "protocol/version2.h"

/// Constructed with the values that hold on the robot.
struct HostSettings {
  HostSettings() : newest_version(protocol::version2::VERSION), memory_stick("/MS"), room(NULL) {}

  int newest_version;        ///< of the protocol that clients may ask for: 1 or 2
  const char* memory_stick;  ///< the folder with the memory stick's content; has to outlive the server
  /// Bytes for which a simulated stick still has room; has to outlive the server. NULL on the robot: the stick's own
  /// file system knows.
  const size_t* room;
};

/// Sets what hostSettings() returns. Only a simulator calls it, before it constructs the objects. On the robot the
/// defaults hold; each object has its own memory there.
void setHostSettings(const HostSettings& settings);

/// The settings for all objects on this computer.
const HostSettings& hostSettings();

/// Longest path from pathOnMemoryStick(), in bytes with the closing 0. OPEN-R's own paths are far shorter.
const size_t MAX_PATH_SIZE = 1024;

/// The path of a file on the memory stick.
/// @param name relative to the stick: "OPEN-R/MW/CONF/RCSERVER.CFG"
/// @param[out] path untouched if it does not fit
/// @return false if it does not fit
bool pathOnMemoryStick(const HostSettings& host, const char* name, char (&path)[MAX_PATH_SIZE]);

#endif  // AIBO_RCSERVER_OBJECTS_HOST_SETTINGS_H
