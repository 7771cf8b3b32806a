/// @file jconfig.h
/// What libjpeg 6b asks about the compiler and the C library of the robot: GCC 3.3.6 with newlib. It stands in for the
/// file that libjpeg's configure would write, which cannot run: it wants to link programs, and the SDK's compiler links
/// none by itself.
#ifndef ON_ROBOT_JCONFIG_H
#define ON_ROBOT_JCONFIG_H

// ISO C: prototypes, types and headers. Macros that are not defined here say no.
#define HAVE_PROTOTYPES
#define HAVE_UNSIGNED_CHAR
#define HAVE_UNSIGNED_SHORT
#define HAVE_STDDEF_H
#define HAVE_STDLIB_H

#ifdef JPEG_INTERNALS
#define INLINE __inline__
#endif

#endif  // ON_ROBOT_JCONFIG_H
