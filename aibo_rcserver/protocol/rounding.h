/// @file rounding.h
/// How values are rounded into the wire's units.
#ifndef AIBO_RCSERVER_PROTOCOL_ROUNDING_H
#define AIBO_RCSERVER_PROTOCOL_ROUNDING_H

#include <limits.h>

namespace protocol {

/// The nearest integer, halves away from zero, limited to what `lowest` and `highest` are.
inline int roundInto(double value, int lowest, int highest) {
  if (value <= lowest) {
    return lowest;
  }
  if (value >= highest) {
    return highest;
  }
  return static_cast<int>(value < 0 ? value - 0.5 : value + 0.5);
}

/// The same, as far as an int16 of version 1 goes.
inline short roundIntoShort(double value) {
  return static_cast<short>(roundInto(value, SHRT_MIN, SHRT_MAX));
}

}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_ROUNDING_H
