#include "tools/teleop/key_steering.h"

#include <algorithm>
#include <iterator>

namespace teleop {
namespace {

struct DirectionKey {
  char key;
  Direction direction;
};

// A key shows the direction in which the robot goes. With the key m, it goes back and to the left, so it has to turn to
// the right.
constexpr DirectionKey kDirections[] = {
    {'i', {1, 0, 0}},  {'I', {1, 0, 0}},         {kArrowUp, {1, 0, 0}}, {'u', {1, 0, 1}},          {'o', {1, 0, -1}},
    {'j', {0, 0, 1}},  {kArrowLeft, {0, 0, 1}},  {'l', {0, 0, -1}},     {kArrowRight, {0, 0, -1}}, {',', {-1, 0, 0}},
    {'<', {-1, 0, 0}}, {kArrowDown, {-1, 0, 0}}, {'m', {-1, 0, -1}},    {'.', {-1, 0, 1}},         {'J', {0, 1, 0}},
    {'L', {0, -1, 0}}, {'U', {1, 1, 0}},         {'O', {1, -1, 0}},     {'M', {-1, 1, 0}},         {'>', {-1, -1, 0}},
};

struct SpeedKey {
  char key;
  double walk;
  double turn;
};

constexpr SpeedKey kSpeeds[] = {
    {'q', 1.1, 1.1}, {'z', 0.9, 0.9}, {'w', 1.1, 1}, {'x', 0.9, 1}, {'e', 1, 1.1}, {'c', 1, 0.9},
};

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
  const auto has_key = [key](const auto& row) { return row.key == key; };
  if (const auto* speed = std::find_if(std::begin(kSpeeds), std::end(kSpeeds), has_key); speed != std::end(kSpeeds)) {
    speeds_.forward *= speed->walk;
    speeds_.left *= speed->walk;
    speeds_.turn *= speed->turn;
    return true;
  }
  const auto* row = std::find_if(std::begin(kDirections), std::end(kDirections), has_key);
  direction_ = row != std::end(kDirections) ? row->direction : Direction{0, 0, 0};
  pressed_ = now;
  return false;
}

aibo_client::WalkVelocity KeySteering::velocity(TimePoint now) const {
  if (hold_.count() > 0 && now - pressed_ >= hold_) {
    return {};
  }
  return {direction_.forward * speeds_.forward, direction_.left * speeds_.left, direction_.turn * speeds_.turn};
}

}  // namespace teleop
