/// @file tables.h
/// The tables of the robots, and macros to write them with.
#ifndef AIBO_RCSERVER_ROBOT_MODEL_TABLES_H
#define AIBO_RCSERVER_ROBOT_MODEL_TABLES_H

#include "robot_model/robot_model.h"

/// Converts Sony's degrees to OPEN-R's whole microradians. Only a macro makes the tables compile-time constants in
/// C++98.
#define MICRORADIANS(degrees) static_cast<int>((degrees)*17453.2925 + ((degrees) < 0 ? -0.5 : 0.5))

/// A row of a coupling, in degrees.
#define ROW(from, to, lowest) \
  { MICRORADIANS(from), MICRORADIANS(to), MICRORADIANS(lowest) }

/// The two ends of a range, in degrees.
#define RANGE(lowest, highest) MICRORADIANS(lowest), MICRORADIANS(highest)

/// Gains with the shifts that are the same for all joints of these robots.
#define GAINS(proportional, integral, derivative) \
  { proportional, integral, derivative, 0x0E, 0x02, 0x0F }

/// Rows for each kind of sensor. Distances in millimetre.
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

/// The number of rows in a table.
#define NUMBER_OF(table) (static_cast<int>(sizeof(table) / sizeof((table)[0])))

namespace robot_model {

extern const RobotModel ERS7;
extern const RobotModel ERS210;

}  // namespace robot_model

#endif  // AIBO_RCSERVER_ROBOT_MODEL_TABLES_H
