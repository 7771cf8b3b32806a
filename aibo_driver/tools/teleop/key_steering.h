/// @file key_steering.h
#ifndef AIBO_DRIVER_TOOLS_TELEOP_KEY_STEERING_H
#define AIBO_DRIVER_TOOLS_TELEOP_KEY_STEERING_H

#include <chrono>
#include <string>

#include "aibo_client/walk.h"

namespace teleop {

/// How fast a robot goes in each direction.
struct Speeds {
  double forward = 0.1;  ///< m/s, forward and backward
  double left = 0.05;    ///< m/s, to either side
  double turn = 0.5;     ///< rad/s
};

/// The keys of a terminal that send several bytes. Terminal::readKey() returns them as one of these.
/// @{
constexpr char kArrowUp = '\x81';
constexpr char kArrowDown = '\x82';
constexpr char kArrowRight = '\x83';
constexpr char kArrowLeft = '\x84';
constexpr char kOtherSpecialKey = '\x85';
/// @}

/// A direction. Each member is a multiple of the speed: -1, 0 or 1.
struct Direction {
  int forward;
  int left;
  int turn;
};

/// Turns keys into a velocity. The keys are those of ROS' teleop_twist_keyboard, as its documentation describes them.
/// The keys around k are arranged like the directions on a keypad. The arrow keys work, too. Capital letters walk
/// sideways; q, z, w, x, e and c change the speeds. Every other key stops the robot.
class KeySteering {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;

  /// What the keys do, in several lines.
  static const char* help();

  /// @param hold for how long a key counts as held down; 0 means until another key is pressed
  KeySteering(const Speeds& speeds, std::chrono::milliseconds hold) : speeds_(speeds), hold_(hold) {}

  /// @return true if the key has changed the speeds
  bool press(char key, TimePoint now);

  /// What the robot should do now.
  aibo_client::WalkVelocity velocity(TimePoint now) const;

  const Speeds& speeds() const { return speeds_; }

 private:
  Speeds speeds_;
  const std::chrono::milliseconds hold_;
  Direction direction_{0, 0, 0};
  TimePoint pressed_;
};

}  // namespace teleop

#endif  // AIBO_DRIVER_TOOLS_TELEOP_KEY_STEERING_H
