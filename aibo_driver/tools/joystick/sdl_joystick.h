/// @file sdl_joystick.h
#ifndef AIBO_DRIVER_TOOLS_JOYSTICK_SDL_JOYSTICK_H
#define AIBO_DRIVER_TOOLS_JOYSTICK_SDL_JOYSTICK_H

#include <SDL2/SDL_joystick.h>

#include <optional>
#include <string>

#include "tools/joystick/joystick_state.h"

namespace joystick {

/// A joystick or gamepad that SDL reads. It may be plugged in and pulled out at any time. There can be only one object
/// of this class at a time, and only one thread may use it.
///
/// Axes and buttons are ordered as joy_node orders them: first the axes, then two axes for each hat, in Linux' order.
class SdlJoystick {
 public:
  /// @param number the number of the joystick; 0 is the first one
  /// @param name if not empty: use a joystick whose name contains this instead
  /// @throw std::runtime_error SDL cannot read joysticks; the message says why
  SdlJoystick(int number, std::string name);
  ~SdlJoystick();

  SdlJoystick(const SdlJoystick&) = delete;
  SdlJoystick& operator=(const SdlJoystick&) = delete;

  /// Reads the joystick, or looks for it if it is not there. It never waits.
  /// @return empty while the joystick is not there
  std::optional<State> read();

  /// The joystick's name, and how many axes and buttons it has, for people. It is empty while the joystick is not
  /// there.
  std::string describe() const;

 private:
  void open();
  void close();
  State state() const;

  const int number_;
  const std::string name_;
  SDL_Joystick* joystick_ = nullptr;
};

}  // namespace joystick

#endif  // AIBO_DRIVER_TOOLS_JOYSTICK_SDL_JOYSTICK_H
