/// @file Types.h
#ifndef OPENR_TYPES_H
#define OPENR_TYPES_H

#include <stddef.h>

typedef unsigned char byte;
typedef signed char sbyte;
typedef unsigned short word;
typedef signed short sword;
/// A number of 32 bits in every data layout. On the robot it is an unsigned long, which usually has 64 bits on Linux,
/// so here it is an unsigned int. Use a cast to print it.
typedef unsigned int longword;
typedef signed int slongword;

typedef longword Selector;            ///< an entry point of an object
typedef unsigned int MemoryRegionID;  ///< a piece of memory shared with the system

const Selector UNDEF = 0xffffffffU;

#endif  // OPENR_TYPES_H
