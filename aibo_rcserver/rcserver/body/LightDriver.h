#ifndef AIBO_RCSERVER_RCSERVER_BODY_LIGHT_DRIVER_H
#define AIBO_RCSERVER_RCSERVER_BODY_LIGHT_DRIVER_H

#include <OPENR/ODataFormats.h>
#include <OPENR/RCRegion.h>

#include "rcserver/body/Primitives.h"
#include "robot_model/robot_model.h"

/// Keeps the wanted state of LEDs and ears, and commands changes. LEDs and ears are numbered by their index in the
/// robot's table. Time is in OPEN-R frames of 8 ms.
///
/// A magnet moves an ear and must not stay energised (Model Information ERS-7). So an ear is drawn for 128 ms, as in
/// Sony's samples, and released. It then rests for 128 ms before it can be drawn again.
class LightDriver {
 public:
  struct LedState {
    unsigned char intensity;  ///< 0..255; 0 or 255 for an LED that is only on or off
    bool is_mode_b;           ///< always false for an LED that is only on or off

    bool operator==(const LedState& other) const {
      return intensity == other.intensity && is_mode_b == other.is_mode_b;
    }
  };

  static const int EAR_FRAMES = 16;  ///< how long an ear is drawn, and how long it then rests

  /// At first, all LEDs are off, and all ears are released.
  explicit LightDriver(const robot_model::RobotModel& robot);

  /// Opens LEDs and ears. A part that does not open is never commanded, and the console names it.
  void Open();

  const robot_model::RobotModel& Robot() const { return robot_; }

  /// @return the LED or ear with this identifier of docs/protocol.md, or robot_model::NO_LED, NO_EAR
  int FindLed(int identifier) const { return findLedByIdentifier(robot_, identifier); }
  int FindEar(int identifier) const { return findEarByIdentifier(robot_, identifier); }

  /// @return the state that the LED shows, which may differ from the wanted one
  LedState SetLed(int led, const LedState& wanted);
  const LedState& Led(int led) const { return leds_[led]; }

  /// Draws or releases an ear.
  /// @return true if the ear is drawn now; a resting ear cannot be drawn
  bool SetEar(int ear, bool draw);

  /// Switches all LEDs off and releases all ears, for the next client.
  void ClientGone();

  bool HasCommand() const;

  /// Adds all commands to a vector. For the ears, CommandVectors::FRAMES frames pass.
  /// @param vector one of the CommandVectors
  void Fill(RCRegion* vector);

  /// Call this when one frame has passed, to time the ears.
  void NextFrame();

 private:
  bool IsDrawn(int ear) const { return frames_busy_[ear] > EAR_FRAMES; }
  bool IsBusy(int ear) const { return frames_busy_[ear] > 0; }
  bool HasChanged(int led) const;
  void CommandLed(RCRegion* vector, int led);
  void CommandEars(RCRegion* vector);

  const robot_model::RobotModel& robot_;
  Primitives led_primitives_;
  Primitives ear_primitives_;
  LedState leds_[robot_model::MAX_LEDS];
  LedState commanded_[robot_model::MAX_LEDS];  ///< the last command to each LED
  int frames_busy_[robot_model::MAX_EARS];     ///< frames until the ear can be drawn again, with those of its rest
};

#endif  // AIBO_RCSERVER_RCSERVER_BODY_LIGHT_DRIVER_H
