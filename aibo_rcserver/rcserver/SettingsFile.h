/// @file SettingsFile.h
/// RCSERVER.CFG on the memory stick.
#ifndef RCSERVER_SETTINGS_FILE_H
#define RCSERVER_SETTINGS_FILE_H

#include "rcserver/HostSettings.h"
#include "rcserver/Settings.h"

/// Reads the settings from the memory stick, and names on the console each line that is wrong. Without the file all is
/// as it is without any line in it, and the console says so.
Settings readSettingsFile(const HostSettings& host);

#endif  // RCSERVER_SETTINGS_FILE_H
