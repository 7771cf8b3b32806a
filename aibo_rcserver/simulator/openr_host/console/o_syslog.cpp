#include <OPENR/OSyslog.h>

#include <cstdarg>
#include <cstdio>
#include <iostream>
#include <string>

#include "simulator/openr_host/system.h"

namespace {

/// As much of the text as the console shows.
std::string format(const char* format, std::va_list arguments) {
  char text[osyslogMAX_SIZE];
  const int size = std::vsnprintf(text, sizeof(text), format, arguments);
  return size > 0 ? text : "";
}

/// Code of an object that a test calls without a machine prints too.
void print(const std::string& text) {
  if (auto* system = openr_host::System::currentOrNull()) {
    system->console().print(text);
  } else {
    std::cout << text << std::flush;
  }
}

const char* nameOf(OSyslogPriority priority) {
  switch (priority) {
    case osyslogERROR:
      return "ERROR";
    case osyslogWARNING:
      return "WARNING";
    default:
      return "INFO";
  }
}

}  // namespace

OStatus osysprint(const char* format_text, ...) {
  std::va_list arguments;
  va_start(arguments, format_text);
  print(format(format_text, arguments));
  va_end(arguments);
  return oSUCCESS;
}

OStatus osyslog(OSyslogPriority priority, const char* format_text, ...) {
  std::va_list arguments;
  va_start(arguments, format_text);
  const std::string text = format(format_text, arguments);
  va_end(arguments);
  const auto* system = openr_host::System::currentOrNull();
  const std::string object = system != nullptr ? system->runningObject() + ": " : "";
  print(std::string(nameOf(priority)) + " " + object + text + "\n");
  return oSUCCESS;
}
