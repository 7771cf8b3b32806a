/// Converts between the wire's units and OPEN-R's. OPEN-R counts in millionths of SI units, such as microradians
/// (robot_model.h):
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

/// Converts an angle, speed or acceleration without limiting it: -32768 (-327.68 degrees) becomes -5719095.
int microradiansFromCentidegrees(short centidegrees);

/// Converts an angle, speed or acceleration, limited to -327.68..327.67 degrees. Some speeds exceed this: the ERS-7's
/// head_pan turns at up to 576 degrees a second, reported as 327.67. A value from microradiansFromCentidegrees()
/// converts back to the same number.
short centidegreesFromMicroradians(int microradians);

/// Converts from OPEN-R's unit. No sensor's range comes near the limits of 16 bits.
short version1SensorValue(robot_model::SensorKind kind, int value);

/// Converts from OPEN-R's unit. A touch is limited to a strength of 2147.
int version2SensorValue(robot_model::SensorKind kind, int value);

/// Converts to m, m/s^2, N, degrees Celsius, charge 0 to 1, strength of a touch, or 0 or 1.
double sensorValueFromVersion1(robot_model::SensorKind kind, short sent);

/// Converts to the same units as sensorValueFromVersion1().
double sensorValueFromVersion2(robot_model::SensorKind kind, int sent);

}  // namespace protocol

#endif  // AIBO_RCSERVER_PROTOCOL_UNITS_H
