#include "rcserver/walk/WalkedVelocity.h"

#include <algorithm>

#include "robot_model/robot_model.h"

using protocol::version2::Velocity;
using namespace robot_model;

namespace {

const double FRAME = FRAME_MILLISECONDS * 1e-3;  // s

// The part of the feet's way to the side that the body goes. It is below 1 because the body rocks and the feet slip.
// The value is the middle of many robots and floors on the bench in test/physics.
const double SIDEWAYS = 0.92;

const Velocity NO_VELOCITY = {0, 0, 0};

bool IsOfFirstPair(int leg) {
  return leg == LEFT_FRONT_LEG || leg == RIGHT_HIND_LEG;
}

Point Mean(const Point* points, int count) {
  Point mean = {0, 0, 0};
  for (int i = 0; i < count; ++i) {
    mean.x += points[i].x / count;
    mean.y += points[i].y / count;
  }
  return mean;
}

// The rigid motion of the body that fits best to the feet on the floor.
// @param steps the steps of the body, seen from each foot
// @param count number of feet, at least 2
// @param seconds the time that the steps took
Velocity RigidVelocity(const Point* places, const Point* steps, int count, double seconds) {
  const Point place = Mean(places, count);
  const Point step = Mean(steps, count);
  double turn = 0;
  double spread = 0;
  for (int i = 0; i < count; ++i) {
    const double x = places[i].x - place.x;
    const double y = places[i].y - place.y;
    turn += x * (steps[i].y - step.y) - y * (steps[i].x - step.x);
    spread += x * x + y * y;
  }
  turn /= spread;
  const Velocity velocity = {(step.x + turn * place.y) / seconds, SIDEWAYS * (step.y - turn * place.x) / seconds,
                             turn / seconds};
  return velocity;
}

}  // namespace

WalkedVelocity::WalkedVelocity() : has_feet_(false), frame_(0), now_(NO_VELOCITY), sum_(NO_VELOCITY), reports_(0) {}

void WalkedVelocity::Begin() {
  has_feet_ = false;
  now_ = NO_VELOCITY;
}

unsigned WalkedVelocity::Measured(const LegAngles* legs, const bool* paws, unsigned frame, double unseen) {
  Foot feet[NUMBER_OF_LEGS];
  bool chosen[NUMBER_OF_LEGS];
  FindFeet(legs, paws, feet);
  const unsigned frames = has_feet_ ? frame - frame_ : 0;
  if (frames > 0) {
    if (ChooseFeet(feet, chosen)) {
      now_ = VelocityTo(feet, chosen, frames);
      now_.forward *= 1 + unseen;
    }
    sum_.forward += now_.forward;
    sum_.left += now_.left;
    sum_.turn += now_.turn;
    ++reports_;
  }
  has_feet_ = true;
  frame_ = frame;
  std::copy(feet, feet + NUMBER_OF_LEGS, feet_);
  return frames;
}

Velocity WalkedVelocity::Take(bool walks) {
  Velocity taken = walks ? now_ : NO_VELOCITY;
  if (reports_ > 0) {
    taken.forward = sum_.forward / reports_;
    taken.left = sum_.left / reports_;
    taken.turn = sum_.turn / reports_;
  }
  sum_ = NO_VELOCITY;
  reports_ = 0;
  return taken;
}

void WalkedVelocity::FindFeet(const LegAngles* legs, const bool* paws, Foot* feet) const {
  for (int i = 0; i < NUMBER_OF_LEGS; ++i) {
    const Leg leg = static_cast<Leg>(i);
    const Point rolled = findRolledWay(leg, legs[i]);
    feet[i].place = findFoot(leg, legs[i]);
    feet[i].contact.x = feet[i].place.x + rolled.x;
    feet[i].contact.y = feet[i].place.y + rolled.y;
    feet[i].contact.z = feet[i].place.z;
    feet[i].is_pressed = paws[i];
  }
}

// Chooses the feet that are on the floor until the next report; false if they are not known.
bool WalkedVelocity::ChooseFeet(const Foot* next, bool* chosen) const {
  int pressed = 0;
  double was_higher = 0;  // by how much the first pair is higher than the other
  double is_higher = 0;
  for (int i = 0; i < NUMBER_OF_LEGS; ++i) {
    chosen[i] = feet_[i].is_pressed && next[i].is_pressed;
    pressed += chosen[i] ? 1 : 0;
    const int sign = IsOfFirstPair(i) ? 1 : -1;
    was_higher += sign * feet_[i].place.z;
    is_higher += sign * next[i].place.z;
  }
  if (pressed >= 2) {
    return true;
  }
  for (int i = 0; i < NUMBER_OF_LEGS; ++i) {
    chosen[i] = IsOfFirstPair(i) == (is_higher < 0);
  }
  return (was_higher < 0) == (is_higher < 0);
}

Velocity WalkedVelocity::VelocityTo(const Foot* next, const bool* chosen, unsigned frames) const {
  Point places[NUMBER_OF_LEGS];
  Point steps[NUMBER_OF_LEGS];
  int count = 0;
  for (int i = 0; i < NUMBER_OF_LEGS; ++i) {
    if (chosen[i]) {
      const Point place = {(feet_[i].place.x + next[i].place.x) / 2, (feet_[i].place.y + next[i].place.y) / 2, 0};
      const Point step = {feet_[i].contact.x - next[i].contact.x, feet_[i].contact.y - next[i].contact.y, 0};
      places[count] = place;
      steps[count] = step;
      ++count;
    }
  }
  return RigidVelocity(places, steps, count, frames * FRAME);
}
