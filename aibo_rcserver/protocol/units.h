/// @file units.h
/// The wire's units, and their conversion from and to those of OPEN-R. Used by both sides.
///
/// OPEN-R counts in millionths of SI units: microradian, micrometre and so on (robot_model.h). Version 1 of the
/// protocol sends hundredths in 16 bits, version 2 sends millionths in 32 bits:
///
/// | | OPEN-R | version 1 | version 2 |
/// |---|---|---|---|
/// | angle | microradian | 0.01 degree | microradian |
/// | distance, acceleration, force, temperature, charge | millionths | hundredths | millionths |
/// | strength of a touch | as measured | as measured | millionths |
/// | switch | 0 or 1 | 0 or 1 | 0 or 1 |
///
/// All conversions round to the nearest integer, halves away from zero, and limit the result to what its type holds.
#ifndef AIBO_RCSERVER_PROTOCOL_UNITS_H
#define AIBO_RCSERVER_PROTOCOL_UNITS_H

#include "robot_model/robot_model.h"

namespace protocol {

/// Converts an angle, a speed or an acceleration from 0.01 degree to microradian. Nothing is ever limited: -32768
/// (-327.68 degrees) is -5719095.
int microradiansFromCentidegrees(short centidegrees);

/// Converts an angle, a speed or an acceleration from microradian to 0.01 degree, limited to -327.68..327.67 degrees.
/// No joint's angle comes near these limits, but some speeds do: the ERS-7's head_pan turns at up to 576 degrees a
/// second, which version 1 reports as 327.67.
///
/// What microradiansFromCentidegrees() returned is converted back to the same number.
short centidegreesFromMicroradians(int microradians);

/// Converts a sensor's value from OPEN-R's unit to version 1's. No sensor's range comes near the limits of 16 bits.
short version1SensorValue(robot_model::SensorKind kind, int value);

/// Converts a sensor's value from OPEN-R's unit to version 2's. A touch is limited to a strength of 2147.
int version2SensorValue(robot_model::SensorKind kind, int value);

/// Converts a value that version 1 sent to m, m/s^2, N, degrees Celsius, charge from 0 to 1, strength of a touch, or 0
/// or 1.
double sensorValueFromVersion1(robot_model::SensorKind kind, short sent);

/// Converts a value that version 2 sent to the same units as sensorValueFromVersion1().
double sensorValueFromVersion2(robot_model::SensorKind kind, int sent);

}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_UNITS_H
