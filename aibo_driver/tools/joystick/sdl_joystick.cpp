#include "tools/joystick/sdl_joystick.h"

#include <SDL2/SDL.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace joystick {
namespace {

// SDL's axes are positive to the right and down, those of sensor_msgs/Joy to the left and up.
float toAxis(int value) {
  constexpr float kHighest = 32767;
  return std::clamp(-static_cast<float>(value) / kHighest, -1.0F, 1.0F);
}

float direction(int hat, int positive, int negative) {
  return (hat & positive) != 0 ? 1.0F : (hat & negative) != 0 ? -1.0F : 0.0F;
}

}  // namespace

SdlJoystick::SdlJoystick(int number, std::string name) : number_(number), name_(std::move(name)) {
  SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");                // ROS handles Ctrl-C
  SDL_SetHint(SDL_HINT_JOYSTICK_ALLOW_BACKGROUND_EVENTS, "1");  // there is no window
  if (SDL_Init(SDL_INIT_JOYSTICK) != 0) {
    throw std::runtime_error(std::string("SDL cannot read joysticks: ") + SDL_GetError());
  }
}

SdlJoystick::~SdlJoystick() {
  close();
  SDL_Quit();
}

std::optional<State> SdlJoystick::read() {
  SDL_JoystickUpdate();
  SDL_FlushEvents(SDL_FIRSTEVENT, SDL_LASTEVENT);  // the events are not needed, because the state is read instead
  if (joystick_ != nullptr && SDL_JoystickGetAttached(joystick_) == SDL_FALSE) {
    close();
  }
  if (joystick_ == nullptr) {
    open();
  }
  return joystick_ != nullptr ? std::optional<State>(state()) : std::nullopt;
}

void SdlJoystick::open() {
  for (int i = 0; i < SDL_NumJoysticks(); ++i) {
    const char* const name = SDL_JoystickNameForIndex(i);
    const bool is_wanted =
        name_.empty() ? i == number_ : name != nullptr && std::string(name).find(name_) != std::string::npos;
    if (is_wanted) {
      joystick_ = SDL_JoystickOpen(i);
      return;
    }
  }
}

void SdlJoystick::close() {
  if (joystick_ != nullptr) {
    SDL_JoystickClose(joystick_);
    joystick_ = nullptr;
  }
}

State SdlJoystick::state() const {
  State state;
  for (int i = 0; i < SDL_JoystickNumAxes(joystick_); ++i) {
    state.axes.push_back(toAxis(SDL_JoystickGetAxis(joystick_, i)));
  }
  for (int i = 0; i < SDL_JoystickNumHats(joystick_); ++i) {
    const int hat = SDL_JoystickGetHat(joystick_, i);
    state.axes.push_back(direction(hat, SDL_HAT_LEFT, SDL_HAT_RIGHT));
    state.axes.push_back(direction(hat, SDL_HAT_UP, SDL_HAT_DOWN));
  }
  for (int i = 0; i < SDL_JoystickNumButtons(joystick_); ++i) {
    state.buttons.push_back(SDL_JoystickGetButton(joystick_, i));
  }
  return state;
}

std::string SdlJoystick::describe() const {
  if (joystick_ == nullptr) {
    return "";
  }
  const char* const name = SDL_JoystickName(joystick_);
  const State now = state();
  return std::string(name != nullptr ? name : "a joystick without a name") + ", with " +
         std::to_string(now.axes.size()) + " axes and " + std::to_string(now.buttons.size()) + " buttons";
}

}  // namespace joystick
