/// @file leds.h
/// What is said to the robot about its LEDs. An LED is named by its RCServer identifier (docs/protocol.md lists them).
#ifndef AIBO_DRIVER_LEDS_H
#define AIBO_DRIVER_LEDS_H

namespace aibo_driver {

/// The two ways in which the LEDs of an ERS-7's face and back shine (Model Information ERS-7, section on LEDs). Those
/// that know only on and off do not mind.
enum class LedMode { kA, kB };

/// How an LED is to shine.
struct LedCommand {
  int id = 0;         ///< 1..255
  int intensity = 0;  ///< 0 = off..255; an LED that knows only on and off is on from 1
  LedMode mode = LedMode::kA;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_LEDS_H
