/// @file antTypes.h
#ifndef OPENR_ANTTYPES_H
#define OPENR_ANTTYPES_H

#include <OPENR/OPENR.h>

typedef slongword int32;
typedef longword uint32;
typedef short int16;
typedef unsigned short uint16;
typedef int boolean;

enum antError {
  ANT_SUCCESS = 0,
  /// The stack, object, entry or buffer does not exist, the buffer is in use, or the message cannot be used like this.
  ANT_FAIL = 1
};

#endif  // OPENR_ANTTYPES_H
