#include "rcserver/joints/JointWatch.h"

#include <stdlib.h>

const int JointWatch::TOLERANCE;
const int JointWatch::MOVEMENT;
const unsigned JointWatch::PATIENCE;
const int JointWatch::HIGH_DUTY;

void JointWatch::Reset(int position, unsigned frame) {
  position_ = position;
  since_ = frame;
}

JointWatch::Verdict JointWatch::Look(const JointReading& reading, unsigned frame) {
  const bool is_there = abs(reading.reference - reading.position) <= TOLERANCE;
  const bool has_moved = abs(reading.position - position_) >= MOVEMENT;
  if (is_there || has_moved) {
    Reset(reading.position, frame);
    return FOLLOWS;
  }
  if (frame - since_ < PATIENCE) {
    return FOLLOWS;
  }
  Reset(reading.position, frame);
  return abs(reading.duty) >= HIGH_DUTY ? JAMMED : UNCONTROLLABLE;
}

void JointRecovery::Reset(int position, unsigned frame) {
  held_at_ = position;
  since_ = frame;
}

bool JointRecovery::Look(const JointReading& reading, unsigned frame) {
  if (!is_awaited_) {
    return false;
  }
  const bool has_moved = abs(reading.position - held_at_) >= JointWatch::MOVEMENT &&
                         abs(reading.reference - held_at_) >= JointWatch::MOVEMENT;
  if (!has_moved || abs(reading.reference - reading.position) > JointWatch::TOLERANCE) {
    since_ = frame;
  }
  is_awaited_ = frame - since_ < JointWatch::PATIENCE;
  return !is_awaited_;
}
