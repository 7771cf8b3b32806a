/// @file Sensors.h
/// What the robot's sensors have measured.
#ifndef AIBO_RCSERVER_RCSERVER_BODY_SENSORS_H
#define AIBO_RCSERVER_RCSERVER_BODY_SENSORS_H

#include "robot_model/robot_model.h"

/// The latest value of each sensor, in the units of robot_model::SensorKind. Pure logic. Sensors go by their index in
/// the robot's table.
class Sensors {
 public:
  /// @param robot must outlive this
  explicit Sensors(const robot_model::RobotModel& robot);

  int NumberOfSensors() const { return robot_.number_of_sensors; }
  const robot_model::Sensor& Sensor(int sensor) const { return robot_.sensors[sensor]; }

  /// @return the sensor with this identifier of docs/protocol.md, or robot_model::NO_SENSOR
  int Find(int identifier) const { return findSensorByIdentifier(robot_, identifier); }

  void Measured(int sensor, int value);

  /// False as long as the sensor has measured nothing.
  bool HasValue(int sensor) const { return has_value_[sensor]; }

  /// 0 as long as the sensor has measured nothing.
  int Value(int sensor) const { return values_[sensor]; }

 private:
  const robot_model::RobotModel& robot_;
  bool has_value_[robot_model::MAX_SENSORS];
  int values_[robot_model::MAX_SENSORS];
};

#endif  // AIBO_RCSERVER_RCSERVER_BODY_SENSORS_H
