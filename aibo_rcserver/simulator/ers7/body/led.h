/// @file led.h
/// One LED of the simulated robot.
#ifndef AIBO_RCSERVER_SIMULATOR_ERS7_BODY_LED_H
#define AIBO_RCSERVER_SIMULATOR_ERS7_BODY_LED_H

#include <OPENR/ODataFormats.h>

namespace simulated_ers7 {

/// Shows what it was told last; a command's period is not looked at, as every frame brings a command of its own or
/// none.
struct Led {
  int intensity = 0;  ///< 0..255; an LED that is only on or off has 0 or 255
  OLED3Mode mode = oled3_MODE_A;
};

}  // namespace simulated_ers7

#endif  // AIBO_RCSERVER_SIMULATOR_ERS7_BODY_LED_H
