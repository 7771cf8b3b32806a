/// @file Lights.h
/// What the robot shows: LEDs and ears.
#ifndef AIBO_RCSERVER_RCSERVER_BODY_LIGHTS_H
#define AIBO_RCSERVER_RCSERVER_BODY_LIGHTS_H

#include "robot_model/robot_model.h"

/// What LEDs and ears are to do. Pure logic. They go by their index in the robot's table, time goes by OPEN-R frames of
/// 8 ms.
///
/// An ear is moved by a magnet, which must not be held energised (Model Information ERS-7). So it is drawn for 128 ms,
/// as in Sony's samples, and let go; then it rests for as long before it can be drawn again.
class Lights {
 public:
  /// How an LED shines.
  struct LedState {
    unsigned char intensity;  ///< 0..255; an LED that is only on or off has 0 or 255
    bool is_mode_b;           ///< never for an LED that is only on or off

    bool operator==(const LedState& other) const {
      return intensity == other.intensity && is_mode_b == other.is_mode_b;
    }
  };

  static const int EAR_FRAMES = 16;  ///< for which an ear is drawn, and for which it rests

  /// All off.
  /// @param robot must outlive this
  explicit Lights(const robot_model::RobotModel& robot);

  const robot_model::RobotModel& Robot() const { return robot_; }

  /// @return the LED or ear with this identifier of docs/protocol.md, or robot_model::NO_LED, NO_EAR
  int FindLed(int identifier) const { return findLedByIdentifier(robot_, identifier); }
  int FindEar(int identifier) const { return findEarByIdentifier(robot_, identifier); }

  /// @return what the LED makes of it
  LedState SetLed(int led, const LedState& wanted);
  const LedState& Led(int led) const { return leds_[led]; }

  /// Draws an ear, or lets it go.
  /// @return true if it is drawn now, which it cannot be while it rests
  bool SetEar(int ear, bool draw);
  bool IsDrawn(int ear) const { return frames_drawn_[ear] > 0; }

  /// False if the ear has been let go for long enough to be drawn again.
  bool IsBusy(int ear) const { return IsDrawn(ear) || frames_to_rest_[ear] > 0; }

  /// One frame passes for the ears.
  void NextFrame();

  /// Forgets what the client has left behind: LEDs are off, ears let go.
  void ClientGone();

 private:
  const robot_model::RobotModel& robot_;
  LedState leds_[robot_model::MAX_LEDS];
  int frames_drawn_[robot_model::MAX_EARS];  ///< that are left
  int frames_to_rest_[robot_model::MAX_EARS];
};

#endif  // AIBO_RCSERVER_RCSERVER_BODY_LIGHTS_H
