/// @file Settings.h
/// What the owner of the robot has written into RCSERVER.CFG.
#ifndef AIBO_RCSERVER_RCSERVER_SETTINGS_SETTINGS_H
#define AIBO_RCSERVER_RCSERVER_SETTINGS_SETTINGS_H

#include <stddef.h>
#include <stdio.h>

#include "objects/HostSettings.h"
#include "rcserver/settings/AllowedAddresses.h"

/// Where they are on the memory stick.
const char SETTINGS_FOLDER[] = "OPEN-R/MW/CONF";
const char SETTINGS_FILE[] = "OPEN-R/MW/CONF/RCSERVER.CFG";

/// Longest line of the file that is read, without its comment.
const size_t MAX_SETTINGS_LINE_SIZE = 1023;

/// Made with what holds where the file says nothing: nothing dangerous is allowed.
struct Settings {
  Settings()
      : allow_upload(false),
        allow_delete(false),
        allow_shut_down(false),
        allow_reboot(false),
        motors_at_boot(true),
        power_monitor(true),
        silent_client_seconds(10) {}

  bool allow_upload;                   ///< ALLOW_UPLOAD: files onto the memory stick
  bool allow_delete;                   ///< ALLOW_DELETE: files from the memory stick
  bool allow_shut_down;                ///< ALLOW_SHUT_DOWN
  bool allow_reboot;                   ///< ALLOW_REBOOT
  bool motors_at_boot;                 ///< MOTORS_AT_BOOT: joints hold where they are when the robot has booted
  bool power_monitor;                  ///< POWER_MONITOR: pause button and low battery switch the robot off
  AllowedAddresses allowed_addresses;  ///< ALLOWED_ADDRESSES
  unsigned silent_client_seconds;      ///< SILENT_CLIENT_SECONDS, 1..3600: then a client is taken for dead
};

/// Gets what is wrong with the file, line by line.
class SettingsProblems {
 public:
  virtual ~SettingsProblems() {}

  /// @param line from 1
  /// @param text what is wrong, and what is done instead
  virtual void Tell(int line, const char* text) = 0;
};

/// Reads lines NAME=VALUE. Empty lines and what comes behind a # are passed over, capitals and small letters are the
/// same, and lines may end as on any system. A line that is wrong is passed over, or makes its setting the safe one:
/// not allowed, motors off at boot, power monitored, 10 s, and no address but 127.0.0.1. The same name twice is wrong,
/// too. Where a line was passed over and none sets ALLOWED_ADDRESSES, it may have been that one: no address but
/// 127.0.0.1, too.
void readSettings(FILE* file, Settings* settings, SettingsProblems& problems);

/// Reads RCSERVER.CFG from the memory stick, and names on the console each line that is wrong. Without the file, the
/// defaults hold; if it cannot be read, only 127.0.0.1 may connect. The console says so.
Settings readSettingsFile(const HostSettings& host);

#endif  // AIBO_RCSERVER_RCSERVER_SETTINGS_SETTINGS_H
