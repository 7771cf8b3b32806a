/// @file key_steering.h
#ifndef AIBO_DRIVER_TOOLS_TELEOP_KEY_STEERING_H
#define AIBO_DRIVER_TOOLS_TELEOP_KEY_STEERING_H

#include <chrono>
#include <string>

#include "aibo_driver/walk.h"

namespace teleop {

/// How fast a robot goes in each direction.
struct Speeds {
  double forward = 0.1;  ///< m/s, backward too
  double left = 0.05;    ///< m/s, to either side
  double turn = 0.5;     ///< rad/s
};

/// Turns keys into a velocity. The keys are those of ROS' teleop_twist_keyboard, as described in its documentation:
/// around k like the directions on a keypad; capitals walk sideways; q, z, w, x, e and c change the speeds. Every other
/// key stops.
class KeySteering {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;

  /// What the keys do, in several lines.
  static const char* help();

  /// @param hold for how long a key counts as held down; 0: until another key is pressed
  KeySteering(const Speeds& speeds, std::chrono::milliseconds hold) : speeds_(speeds), hold_(hold) {}

  /// @return true if the key has changed the speeds
  bool press(char key, TimePoint now);

  /// What the robot is to do now.
  aibo_driver::WalkVelocity velocity(TimePoint now) const;

  const Speeds& speeds() const { return speeds_; }

 private:
  /// In parts of the speeds: -1, 0 or 1.
  struct Direction {
    int forward;
    int left;
    int turn;
  };

  static Direction directionOf(char key);
  bool changeSpeeds(char key);

  Speeds speeds_;
  const std::chrono::milliseconds hold_;
  Direction direction_{0, 0, 0};
  TimePoint pressed_;
};

}  // namespace teleop

#endif  // AIBO_DRIVER_TOOLS_TELEOP_KEY_STEERING_H
