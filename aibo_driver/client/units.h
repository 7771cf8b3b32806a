/// @file units.h
/// The wire counts in millionths (microradian, microradian/s), the client's interface in whole units.
#ifndef AIBO_DRIVER_CLIENT_UNITS_H
#define AIBO_DRIVER_CLIENT_UNITS_H

#include <cmath>

namespace aibo_driver {

inline int toMicro(double value) {
  return static_cast<int>(std::lround(value * 1e6));
}

inline double fromMicro(int value) {
  return value * 1e-6;
}

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_UNITS_H
