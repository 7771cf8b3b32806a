/// @file OSyslog.h
/// Text for the console: standard output and every telnet connection to the wireless console (port 59000).
#ifndef OPENR_OSYSLOG_H
#define OPENR_OSYSLOG_H

#include <OPENR/OPENR.h>

/// The most characters in a print, with the final 0. Longer texts are cut off (OPEN-R SDK Programmer's Guide, 5.1).
const size_t osyslogMAX_SIZE = 243;

typedef longword OSyslogPriority;
const OSyslogPriority osyslogERROR = 1;
const OSyslogPriority osyslogWARNING = 2;
const OSyslogPriority osyslogINFO = 3;

/// Formats like printf, and never waits for a slow reader.
OStatus osysprint(const char* format, ...) __attribute__((format(printf, 1, 2)));

/// Prints one line that begins with the priority and the object's name.
OStatus osyslog(OSyslogPriority priority, const char* format, ...) __attribute__((format(printf, 2, 3)));

/// OSYSPRINT(("format", ...)) needs double parentheses.
#define OSYSPRINT(arguments) (osysprint arguments)

/// OSYSLOG1((osyslogERROR, "format", ...)) needs double parentheses.
#define OSYSLOG1(arguments) (osyslog arguments)

/// Less important logs, which the SDK omits unless OSYSLOG_SHOW is 2 or more.
#if defined(OSYSLOG_SHOW) && OSYSLOG_SHOW > 1
#define OSYSLOG2(arguments) (osyslog arguments)
#else
#define OSYSLOG2(arguments)
#endif
#if defined(OSYSLOG_SHOW) && OSYSLOG_SHOW > 2
#define OSYSLOG3(arguments) (osyslog arguments)
#else
#define OSYSLOG3(arguments)
#endif
#if defined(OSYSLOG_SHOW) && OSYSLOG_SHOW > 3
#define OSYSLOG4(arguments) (osyslog arguments)
#else
#define OSYSLOG4(arguments)
#endif

/// OSYSDEBUG(("format", ...)) is OSYSPRINT with OPENR_DEBUG, and otherwise does nothing.
#ifdef OPENR_DEBUG
#define OSYSDEBUG(arguments) (osysprint arguments)
#else
#define OSYSDEBUG(arguments)
#endif

#endif  // OPENR_OSYSLOG_H
