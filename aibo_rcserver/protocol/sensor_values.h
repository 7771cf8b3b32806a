/// @file sensor_values.h
/// The wire's units for what sensors measure. OPEN-R counts in millionths of an SI unit (robot_model.h); version 1 of
/// the protocol sends hundredths, version 2 millionths. What has no unit is sent otherwise:
///
/// | | OPEN-R | version 1 | version 2 |
/// |---|---|---|---|
/// | distance, acceleration, force, temperature, charge | millionths | hundredths | millionths |
/// | strength of a touch | as it is | as it is | millionths |
/// | switch | 0 or 1 | 0 or 1 | 0 or 1 |
#ifndef AIBO_RCSERVER_PROTOCOL_SENSOR_VALUES_H
#define AIBO_RCSERVER_PROTOCOL_SENSOR_VALUES_H

#include "robot_model/robot_model.h"

namespace protocol {

/// A value as OPEN-R gives it, as version 1 sends it: rounded to the nearest, halves away from zero, and limited to
/// what it can say, -32768 to 32767. No sensor's range comes near these.
short version1SensorValue(robot_model::SensorKind kind, int value);

/// A value as OPEN-R gives it, as version 2 sends it, limited to what it can say: a strength of 2147.
int version2SensorValue(robot_model::SensorKind kind, int value);

/// What version 1 sent, in m, m/s^2, N, degree Celsius, charge from 0 to 1, strength of a touch, or 0 or 1.
double sensorValueFromVersion1(robot_model::SensorKind kind, short sent);

/// What version 2 sent, in m, m/s^2, N, degree Celsius, charge from 0 to 1, strength of a touch, or 0 or 1.
double sensorValueFromVersion2(robot_model::SensorKind kind, int sent);

}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_SENSOR_VALUES_H
