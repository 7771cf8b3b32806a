/// @file tables.h
/// The robots' tables, and macros to write them.
#ifndef AIBO_RCSERVER_ROBOT_MODEL_TABLES_H
#define AIBO_RCSERVER_ROBOT_MODEL_TABLES_H

#include "robot_model/robot_model.h"

/// Converts Sony's degrees. This is a macro because C++98 has no other way to make the tables compile-time constants.
#define MICRORADIANS(degrees) static_cast<int>((degrees)*17453.2925 + ((degrees) < 0 ? -0.5 : 0.5))

/// A row of a coupling, in degrees.
#define ROW(from, to, lowest) \
  { MICRORADIANS(from), MICRORADIANS(to), MICRORADIANS(lowest) }

/// A range, in degrees.
#define RANGE(lowest, highest) MICRORADIANS(lowest), MICRORADIANS(highest)

/// The gains of a joint. All joints of these robots have the same shifts.
#define GAINS(proportional, integral, derivative) \
  { proportional, integral, derivative, 0x0E, 0x02, 0x0F }

/// Rows for each kind of sensor, with distances in millimetres.
#define DISTANCE(name, identifier, locator, nearest, farthest) \
  { name, identifier, locator, SENSOR_DISTANCE, (nearest)*1000, (farthest)*1000, 0, 0 }
#define ACCELERATION(name, identifier, locator) \
  { name, identifier, locator, SENSOR_ACCELERATION, -19613300, 19613300, 0, 0 }
#define FORCE(name, identifier, locator) \
  { name, identifier, locator, SENSOR_FORCE, 0, 980665, 0, 0 }
#define TEMPERATURE(name, identifier, locator) \
  { name, identifier, locator, SENSOR_TEMPERATURE, 0, 0, 0, 0 }
#define CHARGE(name, identifier) \
  { name, identifier, 0, SENSOR_CHARGE, 0, 1000000, 0, 0 }
#define TOUCH(name, identifier, locator, on, off) \
  { name, identifier, locator, SENSOR_TOUCH, 0, 80, on, off }
#define SWITCH(name, identifier, locator) \
  { name, identifier, locator, SENSOR_SWITCH, 0, 1, 1, 1 }

#define NUMBER_OF(table) (static_cast<int>(sizeof(table) / sizeof((table)[0])))

namespace robot_model {

extern const RobotModel ERS7;
extern const RobotModel ERS210;

}  // namespace robot_model

#endif  // AIBO_RCSERVER_ROBOT_MODEL_TABLES_H
