#include "rcserver/joints/JointControl.h"

#include <algorithm>

using namespace protocol::version2;

JointControl::JointControl(const robot_model::RobotModel& robot)
    : robot_(robot),
      planner_(robot),
      commands_(planner_, robot, orders_),
      motions_(planner_, robot, orders_),
      walker_(planner_, robot, orders_) {
  for (int i = 0; i < robot_model::MAX_JOINTS; ++i) {
    positions_[i] = 0;
    duties_[i] = 0;
    faults_[i] = JointWatch::FOLLOWS;
    has_recovered_[i] = false;
  }
  ForgetOrders();
}

void JointControl::SetTargets(JointTargets* targets, unsigned short number) {
  int joints[MAX_JOINTS];
  for (int i = 0; i < targets->count; ++i) {
    const int joint = Find(targets->joints[i].id);
    joints[i] = joint;
    TakeForClient(joint, EndReason::Of(END_REPLACED, "%s was commanded", Name(joint)));
  }
  for (int i = 0; i < targets->count; ++i) {
    planner_.Aim(joints[i], targets->joints[i].value);
  }
  planner_.Go(targets->duration_ms);
  for (int i = 0; i < targets->count; ++i) {
    targets->joints[i].value = planner_.Target(joints[i]);
  }
  if (number != 0) {
    commands_.Begin(joints, targets->count, number);
  }
}

void JointControl::Stop(int joint) {
  TakeForClient(joint, EndReason::Of(END_STOPPED, "%s was told to hold", Name(joint)));
  planner_.Hold(joint);
}

void JointControl::StopAll() {
  const EndReason reason = {END_STOPPED, "everything was told to hold", ""};
  EndCommandsAndMotions(reason);
  walker_.Stop(reason);
  orders_.DemandLettingGo(reason);
  planner_.HoldAll();
  std::fill(ordered_, ordered_ + robot_model::MAX_JOINTS, true);
}

Velocity JointControl::Steer(const Velocity& wanted, bool guarded, unsigned short number) {
  if (walker_.BeginsOrder(wanted)) {
    TakeLegs();
  }
  return walker_.Steer(wanted, guarded, number);
}

void JointControl::Take(protocol::version2::Posture posture, unsigned short number) {
  orders_.DemandLettingGo(EndReason::Of(END_REPLACED, "the robot was told to take a posture"));
  TakeLegs();
  for (int i = 0; i < NumberOfJoints(); ++i) {
    if (walker_.NeedsLevelHead(posture) && walker_.IsOfHead(i)) {
      TakeForWalker(i);
    }
  }
  walker_.Take(posture, number);
}

const char* JointControl::Play(const protocol::MotionName& name, size_t size, int repetitions, bool leave_out,
                               unsigned short number) {
  const char* const problem = motions_.Play(name, size, repetitions, leave_out, ordered_, number);
  for (int i = 0; problem == NULL && i < NumberOfJoints(); ++i) {
    if (motions_.Moves(i)) {  // nothing else has the joints of earlier motions
      const EndReason reason = EndReason::Of(END_REPLACED, "a motion moves %s", Name(i));
      commands_.Leave(i, reason);
      walker_.LeaveAlone(i);
      TakeFromWalker(i, reason);
    }
  }
  return problem;
}

void JointControl::MotorsGoOff() {
  const EndReason reason = {END_STOPPED, "the motors were switched off", ""};
  EndCommandsAndMotions(reason);
  walker_.MotorsGoOff(reason);
  orders_.DemandLettingGo(reason);
}

void JointControl::ForgetOrders() {
  std::fill(ordered_, ordered_ + robot_model::MAX_JOINTS, false);
}

void JointControl::NextFrame() {
  motions_.NextFrame();
  walker_.NextFrame();
  planner_.NextFrame();
}

bool JointControl::AreMoving() const {
  for (int i = 0; i < NumberOfJoints(); ++i) {
    if (planner_.FramesLeft(i) > 0) {
      return true;
    }
  }
  return motions_.IsPlaying() || walker_.IsMoving();
}

void JointControl::Hold(int joint, int position, unsigned frame) {
  positions_[joint] = position;
  planner_.SetPosition(joint, position);
  watches_[joint].Reset(position, frame);
  recoveries_[joint].Reset(position, frame);
}

JointWatch::Verdict JointControl::Measured(int joint, const JointReading& reading, unsigned frame, bool driven) {
  positions_[joint] = reading.position;
  duties_[joint] = reading.duty;
  if (!driven) {
    watches_[joint].Reset(reading.position, frame);
    return JointWatch::FOLLOWS;
  }
  const JointWatch::Verdict verdict = watches_[joint].Look(reading, frame);
  if (verdict != JointWatch::FOLLOWS && walker_.TriesAnotherRoute(joint)) {
    Hold(joint, reading.position, frame);
    return JointWatch::FOLLOWS;
  }
  if (verdict != JointWatch::FOLLOWS) {
    EndWhatMoves(joint, EndReason::Of(END_REFUSED, "%s does not follow", Name(joint)));
    Hold(joint, reading.position, frame);
    Failed(joint, verdict);
  } else if (recoveries_[joint].Look(reading, frame)) {
    has_recovered_[joint] = true;
  }
  return verdict;
}

void JointControl::Failed(int joint, JointWatch::Verdict fault) {
  faults_[joint] = fault;
  has_recovered_[joint] = false;
  recoveries_[joint].Await();
}

JointWatch::Verdict JointControl::TakeFault(int joint) {
  const JointWatch::Verdict fault = faults_[joint];
  faults_[joint] = JointWatch::FOLLOWS;
  return fault;
}

bool JointControl::TakeRecovery(int joint) {
  const bool has_recovered = has_recovered_[joint];
  has_recovered_[joint] = false;
  return has_recovered;
}

void JointControl::Measured(const FallWatch::Reading& reading, unsigned frame) {
  walker_.Measured(reading, positions_, frame);
  commands_.Measured(positions_, frame);
}

void JointControl::ClientGone() {
  // The limits are reset first, so that a movement that goes on, such as lying down, does not keep the limits of the
  // last client.
  for (int i = 0; i < NumberOfJoints(); ++i) {
    planner_.SetSpeedLimit(i, robot_.joints[i].highest_speed);
    planner_.SetAccelerationLimit(i, defaultAcceleration(robot_.joints[i]));
    TakeFault(i);
    TakeRecovery(i);
    recoveries_[i].Forget();
  }
  EndCommandsAndMotions(EndReason::Of(END_STOPPED, "the client is gone"));
  walker_.ClientGone();
  orders_.ClientGone();
  for (int i = 0; i < NumberOfJoints(); ++i) {
    if (!walker_.IsMoving() || !(walker_.Moves(i) || walker_.Levels(i))) {
      planner_.Hold(i);
    }
  }
}

void JointControl::EndWhatMoves(int joint, const EndReason& reason) {
  commands_.Leave(joint, reason);
  motions_.StopMotionOf(joint, reason);
  TakeFromWalker(joint, reason);
}

// Ends a walk or posture that moves the joint.
void JointControl::TakeFromWalker(int joint, const EndReason& reason) {
  if (walker_.Moves(joint)) {
    walker_.Stop(reason);
    orders_.DemandLettingGo(reason);
  }
}

void JointControl::EndCommandsAndMotions(const EndReason& reason) {
  for (int i = 0; i < NumberOfJoints(); ++i) {
    commands_.Leave(i, reason);
  }
  motions_.StopAll(reason);
}

void JointControl::TakeForClient(int joint, const EndReason& reason) {
  EndWhatMoves(joint, reason);
  walker_.LeaveAlone(joint);
  ordered_[joint] = true;
}

void JointControl::TakeForWalker(int joint) {
  const EndReason reason = {END_REPLACED, "the robot was told to walk or to take a posture", ""};
  commands_.Leave(joint, reason);
  motions_.StopMotionOf(joint, reason);
  ordered_[joint] = true;
}

void JointControl::TakeLegs() {
  for (int i = 0; i < NumberOfJoints(); ++i) {
    if (walker_.Moves(i)) {
      TakeForWalker(i);
    }
  }
}
