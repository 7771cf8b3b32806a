/// @file leds.h
/// Commands to LEDs. An LED is named by its RCServer identifier (names.h).
#ifndef AIBO_CLIENT_LEDS_H
#define AIBO_CLIENT_LEDS_H

namespace aibo_client {

/// The two display modes of the LEDs on an ERS-7's face and back (Model Information ERS-7, section on LEDs). LEDs that
/// are only on or off ignore the mode.
enum class LedMode { kA, kB };

/// Sets one LED.
struct LedCommand {
  int id = 0;         ///< 1..255
  int intensity = 0;  ///< 0..255; 0 is off; an LED that is only on or off is on from 1
  LedMode mode = LedMode::kA;
};

}  // namespace aibo_client

#endif  // AIBO_CLIENT_LEDS_H
