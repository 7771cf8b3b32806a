/// @file sdl_joystick.h
#ifndef AIBO_DRIVER_TOOLS_JOYSTICK_SDL_JOYSTICK_H
#define AIBO_DRIVER_TOOLS_JOYSTICK_SDL_JOYSTICK_H

#include <SDL2/SDL_joystick.h>

#include <optional>
#include <string>

#include "tools/joystick/joystick_state.h"

namespace joystick {

/// A joystick or gamepad, read by SDL, which may be plugged in and pulled out at any time. There can be one object of
/// this class at a time, used by one thread.
///
/// Axes and buttons have the places that joy_node gives them: first the axes, then two for each hat, in Linux' order.
class SdlJoystick {
 public:
  /// @param number of the joystick that is wanted, from 0 on; 0 is the first one
  /// @param name if not empty: a joystick whose name contains this, instead
  /// @throw std::runtime_error SDL cannot read joysticks; the message says why
  SdlJoystick(int number, std::string name);
  ~SdlJoystick();

  SdlJoystick(const SdlJoystick&) = delete;
  SdlJoystick& operator=(const SdlJoystick&) = delete;

  /// Reads it, and looks for it if it is not there. Never waits.
  /// @return none while it is not there
  std::optional<State> read();

  /// Its name, and how many axes and buttons it has, for people; empty while it is not there.
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
