/// The settings in RCSERVER.CFG, which the owner of the robot writes.
#ifndef AIBO_RCSERVER_RCSERVER_SETTINGS_SETTINGS_H
#define AIBO_RCSERVER_RCSERVER_SETTINGS_SETTINGS_H

#include <stddef.h>

#include "objects/HostSettings.h"
#include "rcserver/settings/AllowedAddresses.h"

const char SETTINGS_FOLDER[] = "OPEN-R/MW/CONF";
const char SETTINGS_FILE[] = "OPEN-R/MW/CONF/RCSERVER.CFG";

/// Longest line that is accepted, without its comment.
const size_t MAX_SETTINGS_LINE_SIZE = 1023;

/// Longest file that is read, in bytes.
const size_t MAX_SETTINGS_FILE_SIZE = 65536;

/// Longest Settings::fault.
const size_t MAX_SETTINGS_FAULT_SIZE = 119;

/// The constructor sets the defaults, which allow nothing dangerous.
struct Settings {
  Settings()
      : allow_upload(false),
        allow_delete(false),
        allow_pictures(false),
        allow_microphone(false),
        allow_sound(true),
        allow_shut_down(false),
        allow_reboot(false),
        motors_at_boot(true),
        power_monitor(true),
        silent_client_seconds(10) {
    fault[0] = '\0';
  }

  /// True if this setting is yes.
  /// @param setting the name of a setting that is yes or no, as in the file; NULL: always true
  bool Allows(const char* setting) const;

  bool allow_upload;                   ///< ALLOW_UPLOAD: files onto the memory stick
  bool allow_delete;                   ///< ALLOW_DELETE: files from the memory stick
  bool allow_pictures;                 ///< ALLOW_PICTURES: clients take pictures onto the memory stick and fetch them
  bool allow_microphone;               ///< ALLOW_MICROPHONE: clients hear what the robot hears
  bool allow_sound;                    ///< ALLOW_SOUND: clients play sound and set the volume
  bool allow_shut_down;                ///< ALLOW_SHUT_DOWN
  bool allow_reboot;                   ///< ALLOW_REBOOT
  bool motors_at_boot;                 ///< MOTORS_AT_BOOT: joints hold where they are when the robot has booted
  bool power_monitor;                  ///< POWER_MONITOR: pause button and low battery switch the robot off
  AllowedAddresses allowed_addresses;  ///< ALLOWED_ADDRESSES
  unsigned silent_client_seconds;      ///< SILENT_CLIENT_SECONDS, 1..3600: after this time, a client counts as silent
  /// Why the file is ignored and only 127.0.0.1 may connect: "line 2: it is neither yes nor no"; otherwise empty.
  char fault[MAX_SETTINGS_FAULT_SIZE + 1];
};

/// Reads lines of the form NAME=VALUE. The console shows each wrong line. Empty lines and comments after a # are
/// skipped, and case does not matter. Any editor may have written the text (protocol::textInFile()): the line ends of
/// all systems are accepted, and comments have any characters. If any line is wrong, the whole file is ignored, because
/// that line may have been a restriction. In that case only 127.0.0.1 may connect, clients play no sound, the motors
/// are off at boot, and all other settings have their defaults. A line is also wrong if an editor may show a setting in
/// its comment on a line of its own.
void readSettings(const char* bytes, size_t size, Settings* settings);

/// Reads RCSERVER.CFG from the memory stick. The console shows who may connect. Without the file, the defaults hold. A
/// file that is unreadable or too long, or another file there whose name begins with RCSERVER, counts as a wrong line.
Settings readSettingsFile(const HostSettings& host);

#endif  // AIBO_RCSERVER_RCSERVER_SETTINGS_SETTINGS_H
