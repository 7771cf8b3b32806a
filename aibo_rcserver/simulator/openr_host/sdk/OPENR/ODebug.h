/// @file ODebug.h
/// Output of builds with OPENR_DEBUG.
#ifndef OPENR_ODEBUG_H
#define OPENR_ODEBUG_H

#include <stdio.h>

#ifdef OPENR_NO_DEBUG
#undef OPENR_DEBUG
#endif

/// PRINTF(("format", ...)) needs double parentheses.
#define PRINTF(arguments) printf arguments

#ifdef OPENR_DEBUG
#define ODEBUG(statement) (statement)
#define DPRINTF(arguments) printf arguments
#define DPRINTF2(condition, arguments) \
  {                                    \
    if (condition)                     \
      printf arguments;                \
  }
#else
#define ODEBUG(statement)
#define DPRINTF(arguments)
#define DPRINTF2(condition, arguments)
#endif

#endif  // OPENR_ODEBUG_H
