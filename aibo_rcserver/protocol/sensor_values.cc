#include "protocol/sensor_values.h"

#include <limits.h>

#include "protocol/rounding.h"

using robot_model::SENSOR_SWITCH;
using robot_model::SENSOR_TOUCH;
using robot_model::SensorKind;

namespace protocol {

namespace {

const double MILLIONTHS = 1e6;
const double HUNDREDTHS = 1e2;

// What one unit of what the sensor measures is in each of the three.
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

short version1SensorValue(SensorKind kind, int value) {
  return roundIntoShort(value * version1Unit(kind) / openrUnit(kind));
}

int version2SensorValue(SensorKind kind, int value) {
  return roundInto(value * version2Unit(kind) / openrUnit(kind), INT_MIN, INT_MAX);
}

double sensorValueFromVersion1(SensorKind kind, short sent) {
  return sent / version1Unit(kind);
}

double sensorValueFromVersion2(SensorKind kind, int sent) {
  return sent / version2Unit(kind);
}

}  // namespace protocol
