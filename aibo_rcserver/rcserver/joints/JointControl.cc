#include "rcserver/joints/JointControl.h"

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

JointControl::JointControl(const robot_model::RobotModel& robot)
    : robot_(robot), planner_(robot), motions_(planner_, robot) {
  for (int i = 0; i < robot_model::MAX_JOINTS; ++i) {
    positions_[i] = 0;
    duties_[i] = 0;
    faults_[i] = JointWatch::FOLLOWS;
  }
  ForgetCommands();
}

void JointControl::ForgetCommands() {
  for (int i = 0; i < robot_model::MAX_JOINTS; ++i) {
    commanded_[i] = false;
  }
}

void JointControl::SetTargets(MotionPlanner::JointTarget* targets, int count, int duration) {
  for (int i = 0; i < count; ++i) {
    motions_.JointIsCommanded(targets[i].joint);
    commanded_[targets[i].joint] = true;
  }
  planner_.SetTargets(targets, count, duration);
}

void JointControl::NextFrame() {
  motions_.NextFrame();
  planner_.NextFrame();
}

bool JointControl::AreMoving() const {
  for (int i = 0; i < NumberOfJoints(); ++i) {
    if (planner_.FramesLeft(i) > 0) {
      return true;
    }
  }
  return motions_.IsPlaying();
}

void JointControl::Hold(int joint, int position, unsigned frame) {
  positions_[joint] = position;
  planner_.SetPosition(joint, position);
  watches_[joint].Reset(position, frame);
}

JointWatch::Verdict JointControl::Measured(int joint, const JointReading& reading, unsigned frame, bool driven) {
  positions_[joint] = reading.position;
  duties_[joint] = reading.duty;
  if (!driven) {
    watches_[joint].Reset(reading.position, frame);
    return JointWatch::FOLLOWS;
  }
  const JointWatch::Verdict verdict = watches_[joint].Look(reading, frame);
  if (verdict != JointWatch::FOLLOWS) {
    faults_[joint] = verdict;
    motions_.JointFails(joint);
    Hold(joint, reading.position, frame);
  }
  return verdict;
}

JointWatch::Verdict JointControl::TakeFault(int joint) {
  const JointWatch::Verdict fault = faults_[joint];
  faults_[joint] = JointWatch::FOLLOWS;
  return fault;
}

void JointControl::ClientGone() {
  // The limits go first: with low ones left by the client, a joint would take long to stop.
  for (int i = 0; i < NumberOfJoints(); ++i) {
    planner_.SetSpeedLimit(i, robot_.joints[i].highest_speed);
    planner_.SetAccelerationLimit(i, defaultAcceleration(robot_.joints[i]));
    TakeFault(i);
  }
  motions_.ClientGone();
  planner_.HoldAll();
}
