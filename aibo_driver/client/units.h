/// @file units.h
/// Conversions between the numbers of the protocol and the units of the client's interface.
#ifndef AIBO_DRIVER_CLIENT_UNITS_H
#define AIBO_DRIVER_CLIENT_UNITS_H

#include <cmath>
#include <string>

#include "aibo_driver/telemetry.h"

namespace aibo_driver {

/// Version 2 counts in millionths: microradian, microradian/s.
inline int toMicro(double value) {
  return static_cast<int>(std::lround(value * 1e6));
}

inline double fromMicro(int value) {
  return value * 1e-6;
}

/// A sensor's value from a version 1 server. Such a server does not say which robot it runs on: an ERS-7 is assumed.
SensorReading makeVersion1Reading(int id, short value);

/// A sensor's value from a version 2 server.
/// @param design of the robot. A sensor that this design is not known to have is taken for one with a unit.
SensorReading makeVersion2Reading(const std::string& design, int id, int value);

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_UNITS_H
