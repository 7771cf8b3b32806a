// Reads RCSERVER.CFG of a memory stick as the robot does, for scripts/memory_stick. Prints each fault that the robot's
// console would show, one a line.
//   read_settings STICK
#include <OPENR/OSyslog.h>

#include <cstdarg>
#include <cstdio>

#include "host_files/regular_file.h"
#include "rcserver/settings/Settings.h"

OStatus osyslog(OSyslogPriority, const char* format, ...) {
  va_list arguments;
  va_start(arguments, format);
  std::vprintf(format, arguments);
  va_end(arguments);
  std::putchar('\n');
  return oSUCCESS;
}

OStatus osysprint(const char*, ...) {
  return oSUCCESS;
}

int main(int argc, char** argv) {
  if (argc != 2) {
    return 2;
  }
  HostSettings host;
  host.memory_stick = argv[1];
  host.open_to_read = host_files::openToRead;
  readSettingsFile(host);
}
