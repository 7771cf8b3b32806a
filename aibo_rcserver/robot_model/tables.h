/// @file tables.h
/// What the tables of the robots are written with, and where they are.
#ifndef ROBOT_MODEL_TABLES_H
#define ROBOT_MODEL_TABLES_H

#include "robot_model/robot_model.h"

/// Degrees, as Sony prints angles, in whole microradians, as OPEN-R takes them. A macro, because only so the tables are
/// constants that stand before any code runs.
#define MICRORADIANS(degrees) static_cast<int>((degrees)*17453.2925 + ((degrees) < 0 ? -0.5 : 0.5))

/// A row of a coupling, in degrees.
#define ROW(from, to, lowest) \
  { MICRORADIANS(from), MICRORADIANS(to), MICRORADIANS(lowest) }

/// The two ends of a range, in degrees.
#define RANGE(lowest, highest) MICRORADIANS(lowest), MICRORADIANS(highest)

/// Gains with the shifts that all joints of these robots share.
#define GAINS(proportional, integral, derivative) \
  { proportional, integral, derivative, 0x0E, 0x02, 0x0F }

namespace robot_model {

extern const RobotModel ERS7;
extern const RobotModel ERS210;

}  // namespace robot_model

#endif  // ROBOT_MODEL_TABLES_H
