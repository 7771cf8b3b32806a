#include "rcserver/settings/SettingsFile.h"

#include <OPENR/OSyslog.h>
#include <dirent.h>
#include <string.h>

namespace {

class OnConsole : public SettingsProblems {
 public:
  virtual void Tell(int line, const char* text) {
    OSYSLOG1((osyslogERROR, "RCServer: %s, line %d: %s", SETTINGS_FILE, line, text));
  }
};

// Whether there is such a file is not for fopen() to say: it may fail for other reasons.
bool IsThere(const HostSettings& host) {
  char path[MAX_PATH_SIZE];
  DIR* const folder = pathOnMemoryStick(host, SETTINGS_FOLDER, path) ? opendir(path) : NULL;
  if (folder == NULL) {
    return false;
  }
  const dirent* entry = readdir(folder);
  while (entry != NULL && strcasecmp(entry->d_name, SETTINGS_FILE + sizeof(SETTINGS_FOLDER)) != 0) {
    entry = readdir(folder);
  }
  closedir(folder);
  return entry != NULL;
}

void ReadOpenFile(FILE* file, Settings* settings) {
  OnConsole problems;
  readSettings(file, settings, problems);
  fclose(file);
}

}  // namespace

Settings readSettingsFile(const HostSettings& host) {
  Settings settings;
  char path[MAX_PATH_SIZE];
  FILE* file = pathOnMemoryStick(host, SETTINGS_FILE, path) ? fopen(path, "rb") : NULL;
  if (file != NULL) {
    ReadOpenFile(file, &settings);
  } else if (IsThere(host)) {
    settings.allowed_addresses.AllowNobodyElse();
    OSYSLOG1((osyslogERROR, "RCServer: %s cannot be read; nobody but 127.0.0.1 may connect", SETTINGS_FILE));
  } else {
    OSYSPRINT(("RCServer: no %s on the memory stick: upload, delete, shutting down and rebooting are not allowed\n",
               SETTINGS_FILE));
  }
  return settings;
}
