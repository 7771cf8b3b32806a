/// @file sensor_readings.h
#ifndef AIBO_DRIVER_CLIENT_SENSOR_READINGS_H
#define AIBO_DRIVER_CLIENT_SENSOR_READINGS_H

#include <string>

#include "aibo_driver/telemetry.h"

namespace aibo_driver {

/// What a version 1 server says of a sensor. It does not say which robot it is on: the sensor is taken for one of an
/// ERS-7.
SensorReading makeVersion1Reading(int id, short value);

/// What a version 2 server says of a sensor.
/// @param design of the robot. A sensor that it is not known to have is taken for one with a unit.
SensorReading makeVersion2Reading(const std::string& design, int id, int value);

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_SENSOR_READINGS_H
