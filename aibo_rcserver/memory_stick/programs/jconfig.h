/// @file jconfig.h
/// Tells libjpeg 6b what the robot's compiler and C library have: GCC 3.3.6 with newlib. libjpeg's configure script
/// would write this file, but it stops with the SDK's compiler: the script has to link programs, and that compiler
/// links none by itself.
#ifndef AIBO_RCSERVER_MEMORY_STICK_PROGRAMS_JCONFIG_H
#define AIBO_RCSERVER_MEMORY_STICK_PROGRAMS_JCONFIG_H

// ISO C: prototypes, types and headers. Macros that are not defined here say no.
#define HAVE_PROTOTYPES
#define HAVE_UNSIGNED_CHAR
#define HAVE_UNSIGNED_SHORT
#define HAVE_STDDEF_H
#define HAVE_STDLIB_H

#ifdef JPEG_INTERNALS
#define INLINE __inline__
#endif

#endif  // AIBO_RCSERVER_MEMORY_STICK_PROGRAMS_JCONFIG_H
