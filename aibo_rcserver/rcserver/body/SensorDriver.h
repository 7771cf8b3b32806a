/// @file SensorDriver.h
/// Between Sensors and what the robot measures.
#ifndef AIBO_RCSERVER_RCSERVER_BODY_SENSOR_DRIVER_H
#define AIBO_RCSERVER_RCSERVER_BODY_SENSOR_DRIVER_H

#include <OPENR/ODataFormats.h>
#include <OPENR/OPENR.h>

#include "rcserver/body/Primitives.h"
#include "rcserver/body/Sensors.h"

/// Opens the sensors of the robot by the table of its design and hands on what they report; the battery is asked once a
/// second.
class SensorDriver {
 public:
  SensorDriver();
  ~SensorDriver();

  /// A sensor that does not open never has a value, and the log names it.
  /// @param robot must outlive this
  void Open(const robot_model::RobotModel& robot);
  void Close();

  /// Valid between Open() and Close().
  const Sensors& GetSensors() const { return *sensors_; }

  /// Takes over what the sensors report.
  /// @param[out] frame the last frame in the vector; untouched if it reports nothing
  /// @return false if it reports nothing
  bool Read(OSensorFrameVectorData* vector, longword* frame);

 private:
  SensorDriver(const SensorDriver&);
  SensorDriver& operator=(const SensorDriver&);

  void ReadPower(longword now);

  Sensors* sensors_;
  Primitives primitives_;
  longword last_power_;  ///< frame in which the battery was asked
};

#endif  // AIBO_RCSERVER_RCSERVER_BODY_SENSOR_DRIVER_H
