/// @file SettingsFile.h
/// RCSERVER.CFG on the memory stick.
#ifndef AIBO_RCSERVER_RCSERVER_SETTINGS_SETTINGS_FILE_H
#define AIBO_RCSERVER_RCSERVER_SETTINGS_SETTINGS_FILE_H

#include "objects/HostSettings.h"
#include "rcserver/settings/Settings.h"

/// Reads the settings from the memory stick, and names on the console each line that is wrong. Without the file all is
/// as it is without any line in it; with one that cannot be read, nobody but 127.0.0.1 may connect. The console says
/// so.
Settings readSettingsFile(const HostSettings& host);

#endif  // AIBO_RCSERVER_RCSERVER_SETTINGS_SETTINGS_FILE_H
