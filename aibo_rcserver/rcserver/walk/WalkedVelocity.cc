#include "rcserver/walk/WalkedVelocity.h"

#include <string.h>

#include <algorithm>

#include "robot_model/robot_model.h"

using protocol::version2::Velocity;
using robot_model::Leg;
using robot_model::LegAngles;
using robot_model::NUMBER_OF_LEGS;
using robot_model::Point;

namespace {

const double FRAME = robot_model::FRAME_MILLISECONDS * 1e-3;  // s

const Velocity NO_VELOCITY = {0, 0, 0};

Point Mean(const Point* points, int count) {
  Point mean = {0, 0, 0};
  for (int i = 0; i < count; ++i) {
    mean.x += points[i].x / count;
    mean.y += points[i].y / count;
  }
  return mean;
}

// The rigid motion of the body that fits the feet on the floor best.
// @param steps of the body in a frame, seen from each foot
// @param count at least 2
Velocity RigidVelocity(const Point* places, const Point* steps, int count) {
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
  const Velocity velocity = {(step.x + turn * place.y) / FRAME, (step.y - turn * place.x) / FRAME, turn / FRAME};
  return velocity;
}

}  // namespace

WalkedVelocity::WalkedVelocity(const Gait& gait)
    : gait_(gait), phase_(0), in_last_frame_(NO_VELOCITY), sum_(NO_VELOCITY), frames_(0), last_(NO_VELOCITY) {
  memset(legs_, 0, sizeof(legs_));
}

void WalkedVelocity::Begin(const LegAngles* legs) {
  std::copy(legs, legs + NUMBER_OF_LEGS, legs_);
  phase_ = 0;
}

void WalkedVelocity::HaveMoved(const LegAngles* legs) {
  ++frames_;
  std::copy(legs, legs + NUMBER_OF_LEGS, legs_);
}

void WalkedVelocity::HaveWalked(const LegAngles* legs, double phase) {
  in_last_frame_ = VelocityTo(legs, phase);
  sum_.forward += in_last_frame_.forward;
  sum_.left += in_last_frame_.left;
  sum_.turn += in_last_frame_.turn;
  phase_ = phase;
  HaveMoved(legs);
}

Velocity WalkedVelocity::Take(bool walks) {
  if (frames_ > 0) {
    last_.forward = sum_.forward / frames_;
    last_.left = sum_.left / frames_;
    last_.turn = sum_.turn / frames_;
  } else if (!walks) {
    last_ = NO_VELOCITY;
  }
  sum_ = NO_VELOCITY;
  frames_ = 0;
  return last_;
}

Velocity WalkedVelocity::VelocityTo(const LegAngles* legs, double phase) const {
  Point places[NUMBER_OF_LEGS];
  Point steps[NUMBER_OF_LEGS];
  int count = 0;
  for (int i = 0; i < NUMBER_OF_LEGS; ++i) {
    const Leg leg = static_cast<Leg>(i);
    if (!gait_.MovesWithFloor(leg, phase_) || !gait_.MovesWithFloor(leg, phase)) {
      continue;
    }
    const Point was = findFoot(leg, legs_[i]);
    const Point is = findFoot(leg, legs[i]);
    const Point place = {(was.x + is.x) / 2, (was.y + is.y) / 2, 0};
    const Point step = {was.x - is.x, was.y - is.y, 0};
    places[count] = place;
    steps[count] = step;
    ++count;
  }
  return count < 2 ? NO_VELOCITY : RigidVelocity(places, steps, count);
}
