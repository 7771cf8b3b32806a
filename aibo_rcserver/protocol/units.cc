#include "protocol/units.h"

#include <limits.h>

using robot_model::SENSOR_SWITCH;
using robot_model::SENSOR_TOUCH;
using robot_model::SensorKind;

namespace protocol {

namespace {

const double MICRORADIANS_PER_CENTIDEGREE = 3.14159265358979323846 / 180.0 / 100.0 * 1e6;
const double MILLIONTHS = 1e6;
const double HUNDREDTHS = 1e2;

// Rounds halves away from zero.
int roundInto(double value, int lowest, int highest) {
  if (value <= lowest) {
    return lowest;
  }
  if (value >= highest) {
    return highest;
  }
  return static_cast<int>(value < 0 ? value - 0.5 : value + 0.5);
}

int roundIntoInt(double value) {
  return roundInto(value, INT_MIN, INT_MAX);
}

short roundIntoShort(double value) {
  return static_cast<short>(roundInto(value, SHRT_MIN, SHRT_MAX));
}

// How many of OPEN-R's units make one SI unit, one strength of touch or one press.
double openrUnit(SensorKind kind) {
  return kind == SENSOR_TOUCH || kind == SENSOR_SWITCH ? 1 : MILLIONTHS;
}

double version1Unit(SensorKind kind) {
  return kind == SENSOR_TOUCH || kind == SENSOR_SWITCH ? 1 : HUNDREDTHS;
}

double version2Unit(SensorKind kind) {
  return kind == SENSOR_SWITCH ? 1 : MILLIONTHS;
}

}  // namespace

int microradiansFromCentidegrees(short centidegrees) {
  return roundIntoInt(centidegrees * MICRORADIANS_PER_CENTIDEGREE);
}

short centidegreesFromMicroradians(int microradians) {
  return roundIntoShort(microradians / MICRORADIANS_PER_CENTIDEGREE);
}

short version1SensorValue(SensorKind kind, int value) {
  return roundIntoShort(value * version1Unit(kind) / openrUnit(kind));
}

int version2SensorValue(SensorKind kind, int value) {
  return roundIntoInt(value * version2Unit(kind) / openrUnit(kind));
}

double sensorValueFromVersion1(SensorKind kind, short sent) {
  return sent / version1Unit(kind);
}

double sensorValueFromVersion2(SensorKind kind, int sent) {
  return sent / version2Unit(kind);
}

}  // namespace protocol
