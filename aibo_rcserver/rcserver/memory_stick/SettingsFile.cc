#include "rcserver/memory_stick/SettingsFile.h"

#include <OPENR/OSyslog.h>

namespace {

class OnConsole : public SettingsProblems {
 public:
  virtual void Tell(int line, const char* text) {
    OSYSLOG1((osyslogERROR, "RCServer: %s, line %d: %s", SETTINGS_FILE, line, text));
  }
};

}  // namespace

Settings readSettingsFile(const HostSettings& host) {
  Settings settings;
  char path[MAX_PATH_SIZE];
  FILE* file = pathOnMemoryStick(host, SETTINGS_FILE, path) ? fopen(path, "rb") : NULL;
  if (file == NULL) {
    OSYSPRINT(("RCServer: no %s on the memory stick: upload, delete, shutting down and rebooting are not allowed\n",
               SETTINGS_FILE));
    return settings;
  }
  OnConsole problems;
  readSettings(file, &settings, problems);
  fclose(file);
  return settings;
}
