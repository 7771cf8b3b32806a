/// @file HostSettings.h
/// Settings that differ between the robot and a computer with a simulated robot.
#ifndef AIBO_RCSERVER_OBJECTS_HOST_SETTINGS_H
#define AIBO_RCSERVER_OBJECTS_HOST_SETTINGS_H

#include <stddef.h>
#include <stdio.h>

#include "protocol/version2.h"

/// What a simulator can change. The defaults are those of the robot.
struct HostSettings {
  HostSettings();

  int newest_version;        ///< newest protocol version that clients may ask for: 1 or 2
  const char* memory_stick;  ///< the folder with the memory stick's content
  /// Bytes that still fit onto a simulated stick. It is NULL on the robot, whose own file system knows.
  const size_t* room;
  /// Opens a file on the stick for reading in binary mode; returns NULL if that is not possible. A simulator must not
  /// wait, as it would for a pipe.
  FILE* (*open_to_read)(const char* path);
};

/// Changes what hostSettings() returns. Only a simulator calls it, before it constructs the objects.
void setHostSettings(const HostSettings& settings);

const HostSettings& hostSettings();

/// The longest path from pathOnMemoryStick(), with the final 0. OPEN-R's own paths are far shorter.
const size_t MAX_PATH_SIZE = 1024;

/// @param name the name relative to the stick: "OPEN-R/MW/CONF/RCSERVER.CFG"
/// @param[out] path unchanged if the path does not fit
/// @return false if the path does not fit
bool pathOnMemoryStick(const HostSettings& host, const char* name, char (&path)[MAX_PATH_SIZE]);

#endif  // AIBO_RCSERVER_OBJECTS_HOST_SETTINGS_H
