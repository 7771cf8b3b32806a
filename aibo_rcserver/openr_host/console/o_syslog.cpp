#include <OPENR/OSyslog.h>

#include <cstdarg>
#include <cstdio>
#include <iostream>
#include <string>

#include "openr_host/system.h"

namespace {

std::string format(const char* format, std::va_list arguments) {
  std::va_list again;
  va_copy(again, arguments);
  const int size = std::vsnprintf(nullptr, 0, format, arguments);
  std::string text(size > 0 ? static_cast<std::size_t>(size) : 0, '\0');
  std::vsnprintf(text.data(), text.size() + 1, format, again);
  va_end(again);
  return text;
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
    case osyslogINFO:
      break;
  }
  return "INFO";
}

}  // namespace

void OSystemPrint(const char* format_text, ...) {
  std::va_list arguments;
  va_start(arguments, format_text);
  print(format(format_text, arguments));
  va_end(arguments);
}

void OSystemLog(OSyslogPriority priority, const char* format_text, ...) {
  std::va_list arguments;
  va_start(arguments, format_text);
  const std::string text = format(format_text, arguments);
  va_end(arguments);
  const auto* system = openr_host::System::currentOrNull();
  const std::string object = system != nullptr ? system->runningObject() + ": " : "";
  print(std::string(nameOf(priority)) + " " + object + text + "\n");
}
