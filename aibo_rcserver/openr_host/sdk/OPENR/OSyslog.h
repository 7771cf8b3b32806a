/// @file OSyslog.h
/// Text for the console: standard output, and every telnet connection to the wireless console (port 59000).
#ifndef OPENR_OSYSLOG_H
#define OPENR_OSYSLOG_H

enum OSyslogPriority { osyslogERROR = 1, osyslogWARNING = 2, osyslogINFO = 3 };

/// What OSYSPRINT stands for. Prints as printf does; never waits for a slow reader.
void OSystemPrint(const char* format, ...) __attribute__((format(printf, 1, 2)));

/// What OSYSLOG1 stands for. Prints one line with the priority and the object's name in front.
void OSystemLog(OSyslogPriority priority, const char* format, ...) __attribute__((format(printf, 2, 3)));

/// OSYSPRINT(("format", ...)): note the double parentheses.
#define OSYSPRINT(arguments) OSystemPrint arguments

/// OSYSLOG1((osyslogERROR, "format", ...)): note the double parentheses.
#define OSYSLOG1(arguments) OSystemLog arguments

/// OSYSDEBUG(("format", ...)): as OSYSPRINT if OPENR_DEBUG is defined, else nothing.
#ifdef OPENR_DEBUG
#define OSYSDEBUG(arguments) OSystemPrint arguments
#else
#define OSYSDEBUG(arguments) static_cast<void>(0)
#endif

#endif  // OPENR_OSYSLOG_H
