#ifndef AIBO_RCSERVER_RCSERVER_BODY_SENSOR_DRIVER_H
#define AIBO_RCSERVER_RCSERVER_BODY_SENSOR_DRIVER_H

#include <OPENR/ODataFormats.h>

#include "rcserver/Interval.h"
#include "rcserver/body/Primitives.h"
#include "robot_model/robot_model.h"

/// Keeps the latest value of each sensor, in the units of robot_model::SensorKind. Sensors are numbered by their index
/// in the robot's table. The battery is read once a second.
class SensorDriver {
 public:
  explicit SensorDriver(const robot_model::RobotModel& robot);

  /// Opens the sensors. A sensor that does not open never has a value, and the console names it.
  void Open();

  int NumberOfSensors() const { return robot_.number_of_sensors; }
  const robot_model::Sensor& Sensor(int sensor) const { return robot_.sensors[sensor]; }

  /// @return the sensor with this identifier of docs/protocol.md, or robot_model::NO_SENSOR
  int Find(int identifier) const { return findSensorByIdentifier(robot_, identifier); }

  bool HasValue(int sensor) const { return has_value_[sensor]; }

  /// The sensor's value; 0 until it has measured something.
  int Value(int sensor) const { return values_[sensor]; }

  /// Stores the values that the sensors report.
  /// @param[out] frame the last frame in the vector; untouched if no sensor reports
  /// @return false if no sensor reports
  bool Read(OSensorFrameVectorData* vector, longword* frame);

  void Measured(int sensor, int value);

 private:
  void ReadPower();

  const robot_model::RobotModel& robot_;
  Primitives primitives_;
  bool has_value_[robot_model::MAX_SENSORS];
  int values_[robot_model::MAX_SENSORS];
  Interval power_interval_;
};

#endif  // AIBO_RCSERVER_RCSERVER_BODY_SENSOR_DRIVER_H
