/// @file units.h
/// Conversions between the numbers of the protocol and the units of the client's interface.
#ifndef AIBO_DRIVER_CLIENT_UNITS_H
#define AIBO_DRIVER_CLIENT_UNITS_H

#include <cmath>
#include <string>

#include "robot_model/robot_model.h"

namespace aibo_client {

/// Version 2 counts in millionths: microradians and microradians/s.
inline int toMicro(double value) {
  return static_cast<int>(std::lround(value * 1e6));
}

inline double fromMicro(int value) {
  return value * 1e-6;
}

/// Rounds a velocity of a walk as version 2 sends it: to whole mm/s or mrad/s. So a velocity that is sent as 0 also
/// counts as 0 here: it ends a walk, and is never too old.
inline double wholeThousandths(double value) {
  return std::round(value * 1000) / 1000;
}

/// @param design the robot's design. A sensor that the design is not known to have counts as one with a unit
inline robot_model::SensorKind sensorKind(const std::string& design, int id) {
  const robot_model::RobotModel* model = robot_model::findRobotModel(design.c_str());
  const int index = model == nullptr ? robot_model::NO_SENSOR : robot_model::findSensorByIdentifier(*model, id);
  return index == robot_model::NO_SENSOR ? robot_model::SENSOR_DISTANCE : model->sensors[index].kind;
}

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_UNITS_H
