#include "objects/HostSettings.h"

#include <string.h>

namespace {

FILE* OpenToRead(const char* path) {
  return fopen(path, "rb");
}

HostSettings host_settings;

}  // namespace

HostSettings::HostSettings()
    : newest_version(protocol::version2::VERSION), memory_stick("/MS"), room(NULL), open_to_read(OpenToRead) {}

void setHostSettings(const HostSettings& settings) {
  host_settings = settings;
}

const HostSettings& hostSettings() {
  return host_settings;
}

bool pathOnMemoryStick(const HostSettings& host, const char* name, char (&path)[MAX_PATH_SIZE]) {
  if (strlen(host.memory_stick) + 1 + strlen(name) >= sizeof(path)) {
    return false;
  }
  sprintf(path, "%s/%s", host.memory_stick, name);
  return true;
}
