/// @file LightDriver.h
/// Between Lights and the LEDs and ears of the robot.
#ifndef AIBO_RCSERVER_RCSERVER_BODY_LIGHT_DRIVER_H
#define AIBO_RCSERVER_RCSERVER_BODY_LIGHT_DRIVER_H

#include <OPENR/ODataFormats.h>
#include <OPENR/OPENR.h>
#include <OPENR/RCRegion.h>

#include "rcserver/body/Lights.h"
#include "rcserver/body/Primitives.h"

/// Opens the LEDs and ears of the robot by the table of its design, and commands them where they are to change. What
/// does not open is left out, and the log names it.
class LightDriver {
 public:
  LightDriver();
  ~LightDriver();

  /// @param robot must outlive this
  void Open(const robot_model::RobotModel& robot);
  void Close();

  /// Valid between Open() and Close().
  Lights& GetLights() { return *lights_; }

  /// True if there is something to be commanded.
  bool HasCommand() const;

  /// Adds all of it.
  /// @param vector of CommandVectors
  void Fill(RCRegion* vector);

 private:
  LightDriver(const LightDriver&);
  LightDriver& operator=(const LightDriver&);

  bool IsToChange(int led) const;
  void CommandLed(RCRegion* vector, int led);
  void CommandEars(RCRegion* vector);

  Lights* lights_;
  Primitives leds_;
  Primitives ears_;
  Lights::LedState commanded_[robot_model::MAX_LEDS];
};

#endif  // AIBO_RCSERVER_RCSERVER_BODY_LIGHT_DRIVER_H
