/// @file SystemTime.h
#ifndef OPENR_SYSTEM_TIME_H
#define OPENR_SYSTEM_TIME_H

#include <Types.h>

struct SystemTime {
  longword seconds;
  longword useconds;  ///< microseconds, 0..999999

  SystemTime() : seconds(0), useconds(0) {}
};

#endif  // OPENR_SYSTEM_TIME_H
