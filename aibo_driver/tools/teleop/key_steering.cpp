#include "tools/teleop/key_steering.h"

namespace teleop {
namespace {

constexpr double kFaster = 1.1;
constexpr double kSlower = 0.9;

}  // namespace

const char* KeySteering::help() {
  return "Hold a key down to walk:\n"
         "   u   i   o     forward, with u and o in a curve\n"
         "   j   k   l     j and l turn; k stops\n"
         "   m   ,   .     backward, with m and . in a curve\n"
         "The arrow keys do the same as i, j, l and the comma.\n"
         "J and L walk sideways; U O M > walk diagonally (capitals).\n"
         "q / z: all speeds up or down by 10 %    w / x: of walking    e / c: of turning\n"
         "The space bar and every other key stop. Ctrl-C ends.\n"
         "S (capital) stops everything that moves, until R (capital).\n";
}

bool KeySteering::press(char key, TimePoint now) {
  if (changeSpeeds(key)) {
    return true;
  }
  direction_ = directionOf(key);
  pressed_ = now;
  return false;
}

aibo_client::WalkVelocity KeySteering::velocity(TimePoint now) const {
  if (hold_.count() > 0 && now - pressed_ >= hold_) {
    return {};
  }
  return {direction_.forward * speeds_.forward, direction_.left * speeds_.left, direction_.turn * speeds_.turn};
}

// A key shows the direction in which the robot goes. For m it goes back and to the left, so it has to turn to
// the right.
KeySteering::Direction KeySteering::directionOf(char key) {
  switch (key) {
    case 'i':
    case 'I':
    case kArrowUp:
      return {1, 0, 0};
    case 'u':
      return {1, 0, 1};
    case 'o':
      return {1, 0, -1};
    case 'j':
    case kArrowLeft:
      return {0, 0, 1};
    case 'l':
    case kArrowRight:
      return {0, 0, -1};
    case 'm':
      return {-1, 0, -1};
    case ',':
    case '<':
    case kArrowDown:
      return {-1, 0, 0};
    case '.':
      return {-1, 0, 1};
    case 'J':
      return {0, 1, 0};
    case 'L':
      return {0, -1, 0};
    case 'U':
      return {1, 1, 0};
    case 'O':
      return {1, -1, 0};
    case 'M':
      return {-1, 1, 0};
    case '>':
      return {-1, -1, 0};
    default:
      return {0, 0, 0};
  }
}

bool KeySteering::changeSpeeds(char key) {
  double walk = 1;
  double turn = 1;
  switch (key) {
    case 'q':
      walk = turn = kFaster;
      break;
    case 'z':
      walk = turn = kSlower;
      break;
    case 'w':
      walk = kFaster;
      break;
    case 'x':
      walk = kSlower;
      break;
    case 'e':
      turn = kFaster;
      break;
    case 'c':
      turn = kSlower;
      break;
    default:
      return false;
  }
  speeds_.forward *= walk;
  speeds_.left *= walk;
  speeds_.turn *= turn;
  return true;
}

}  // namespace teleop
