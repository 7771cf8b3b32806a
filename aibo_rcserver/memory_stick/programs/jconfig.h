/// @file jconfig.h
/// Describes the robot's compiler and C library to libjpeg 6b: GCC 3.3.6 with newlib. libjpeg's configure script cannot
/// write this file, because the SDK's compiler alone cannot link the script's test programs.
#ifndef AIBO_RCSERVER_MEMORY_STICK_PROGRAMS_JCONFIG_H
#define AIBO_RCSERVER_MEMORY_STICK_PROGRAMS_JCONFIG_H

// The settings for ISO C. A macro that is not defined here means no.
#define HAVE_PROTOTYPES
#define HAVE_UNSIGNED_CHAR
#define HAVE_UNSIGNED_SHORT
#define HAVE_STDDEF_H
#define HAVE_STDLIB_H

#ifdef JPEG_INTERNALS
#define INLINE __inline__
#endif

#endif  // AIBO_RCSERVER_MEMORY_STICK_PROGRAMS_JCONFIG_H
