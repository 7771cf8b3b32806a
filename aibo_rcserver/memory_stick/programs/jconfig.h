/// @file jconfig.h
/// Tells libjpeg 6b what the robot's compiler and C library support: GCC 3.3.6 with newlib. libjpeg's configure script
/// cannot write this file, because it has to link programs, which the SDK's compiler cannot do by itself.
#ifndef AIBO_RCSERVER_MEMORY_STICK_PROGRAMS_JCONFIG_H
#define AIBO_RCSERVER_MEMORY_STICK_PROGRAMS_JCONFIG_H

// ISO C: prototypes, types and headers. A macro that is not defined here means no.
#define HAVE_PROTOTYPES
#define HAVE_UNSIGNED_CHAR
#define HAVE_UNSIGNED_SHORT
#define HAVE_STDDEF_H
#define HAVE_STDLIB_H

#ifdef JPEG_INTERNALS
#define INLINE __inline__
#endif

#endif  // AIBO_RCSERVER_MEMORY_STICK_PROGRAMS_JCONFIG_H
