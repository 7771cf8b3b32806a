/// @file leds.h
/// Commands to LEDs. An LED is given by its RCServer identifier (docs/protocol.md lists them).
#ifndef AIBO_DRIVER_LEDS_H
#define AIBO_DRIVER_LEDS_H

namespace aibo_driver {

/// The two display modes of the LEDs on an ERS-7's face and back (Model Information ERS-7, section on LEDs). LEDs that
/// are only on or off ignore the mode.
enum class LedMode { kA, kB };

/// Sets one LED.
struct LedCommand {
  int id = 0;         ///< 1..255
  int intensity = 0;  ///< 0 = off..255; an LED that is only on or off is on from 1
  LedMode mode = LedMode::kA;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_LEDS_H
