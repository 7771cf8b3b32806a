/// @file antTypes.h
/// The elementary types of the network stack.
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
  ANT_FAIL = 1  ///< no such stack, object, entry or buffer, a buffer in use, or a message that cannot be used this way
};

#endif  // OPENR_ANTTYPES_H
