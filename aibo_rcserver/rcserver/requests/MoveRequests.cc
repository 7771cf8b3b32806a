#include "rcserver/requests/MoveRequests.h"

#include <stdio.h>

using namespace protocol::version2;
using robot_model::NO_JOINT;

namespace {

const char CANNOT_SWITCH_ON[] = "the robot cannot switch its motors on; its console says why";

double WholeThousandths(double value) {
  return static_cast<int>(value * 1000 + (value < 0 ? -1e-6 : 1e-6)) * 1e-3;
}

// In the order of JointWatch::Verdict.
const char* const FAULTS[] = {
    NULL,
    "is jammed: its motor pushes, but it does not move. It is held in place until the next command to it",
    "does not follow its commands. It is held in place until the next command to it",
    "is limp: its motor got no gain. Switch the motors off and on again; the robot's console has the reason",
};

}  // namespace

MoveRequests::MoveRequests(const Robot& robot, StickRequests& stick, Exchange& exchange)
    : robot_(robot), stick_(stick), exchange_(exchange), told_() {
  Begin();
}

void MoveRequests::MoveJoints() {
  JointOrder order;
  if (!exchange_.Decode(&order)) {
    return;
  }
  if (!robot_.motors.AreOn()) {
    exchange_.Refuse(CODE_REFUSED, "the motors are off; switch them on first");
    return;
  }
  JointTargets& targets = order.targets;
  if (exchange_.IsInTime(order.not_after) && HasJoints(targets.joints, targets.count)) {
    robot_.joints.SetTargets(&targets, exchange_.Request().request_number);
    exchange_.Reply(targets);
  }
}

void MoveRequests::LimitSpeeds() {
  SpeedLimits limits;
  if (!exchange_.Decode(&limits) || !HasJoints(limits.joints, limits.count) || !ArePositive(limits)) {
    return;
  }
  JointControl& joints = robot_.joints;
  for (int i = 0; i < limits.count; ++i) {
    limits.joints[i].value = joints.Planner().SetSpeedLimit(joints.Find(limits.joints[i].id), limits.joints[i].value);
  }
  if (limits.count == 0) {
    limits.count = static_cast<unsigned char>(joints.NumberOfJoints());
    for (int i = 0; i < joints.NumberOfJoints(); ++i) {
      limits.joints[i].id = joints.Identifier(i);
      limits.joints[i].value = joints.Planner().SpeedLimit(i);
    }
  }
  exchange_.Reply(limits);
}

void MoveRequests::SwitchMotors() {
  MotorSwitch& motors = robot_.motors;
  if (exchange_.HasPayload()) {
    MotorOrder order;
    if (!exchange_.Decode(&order) || (order.on && !exchange_.IsInTime(order.not_after))) {
      return;
    }
    if (!motors.Switch(order.on)) {
      exchange_.Refuse(CODE_REFUSED, CANNOT_SWITCH_ON);
      return;
    }
    if (!order.on) {
      stick_.EndWaitingMotion("is not played: the motors were switched off before its file had been read");
    }
  }
  const MotorState state = {motors.AreOn()};
  exchange_.Reply(state);
}

void MoveRequests::Hold() {
  switch (exchange_.Id()) {
    case HOLD_EVERYTHING:
      if (exchange_.HasNoPayload()) {
        robot_.joints.StopAll();
        stick_.EndWaitingMotion("is not played: everything was told to hold before its file had been read");
        exchange_.ReplyWithoutPayload();
      }
      break;
    case HOLD_JOINTS:
      HoldJoints();
      break;
    default:
      exchange_.Refuse(CODE_REFUSED, "bad request: the id is neither 0 (hold everything) nor 1 (the joints named)");
  }
}

// The protocol has velocities in whole mm/s and mrad/s. The velocities in force are rounded down, so that a client can
// send them back unchanged.
void MoveRequests::Steer() {
  SteeringOrder order;
  if (!exchange_.Decode(&order)) {
    return;
  }
  const protocol::version2::Velocity& wanted = order.velocity;
  Walker& walker = robot_.joints.Walking();
  const bool is_guarded = (exchange_.Id() & STEER_GUARDED) != 0;
  if (!wanted.isZero()) {
    if (!exchange_.IsInTime(order.not_after)) {
      return;
    }
    if (const char* const problem = walker.ProblemOfWalk(robot_.motors.AreOn(), is_guarded ? &wanted : NULL)) {
      return exchange_.Refuse(CODE_REFUSED, problem);
    }
  }
  const protocol::version2::Velocity accepted =
      robot_.joints.Steer(wanted, is_guarded, exchange_.Request().request_number);
  const SteeringReply steered = {
      {WholeThousandths(accepted.forward), WholeThousandths(accepted.left), WholeThousandths(accepted.turn)},
      walker.WalkNumber()};
  exchange_.Reply(steered);
}

void MoveRequests::TakePosture() {
  PostureOrder order;
  if (!exchange_.Decode(&order)) {
    return;
  }
  if (!canTake(exchange_.Id())) {
    exchange_.Refuse(CODE_REFUSED, "bad request: the id is not one of the postures 1 (stand), 2 (sit) and 3 (rest)");
    return;
  }
  const Posture posture = static_cast<Posture>(exchange_.Id());
  if (exchange_.IsInTime(order.not_after) && MayTake(posture)) {
    robot_.joints.Take(posture, exchange_.Request().request_number);
    exchange_.ReplyWithoutPayload();
  }
}

void MoveRequests::PushReports() {
  PushJointFaults();
  PushRecoveries();
  if (exchange_.HasRoom()) {
    exchange_.PushEnds();
  }
  if (exchange_.HasRoom() && robot_.joints.Walking().TakeSoftened()) {
    exchange_.PushError(CODE_REFUSED, "the robot has fallen: its motors are off, so that its legs are limp");
  }
}

void MoveRequests::PushMotorsAndPosture() {
  const MotorsAndPosture now = {robot_.motors.AreOn(), static_cast<unsigned char>(robot_.joints.Posture())};
  const bool is_told = now.motors_on == told_.motors_on && now.posture == told_.posture;
  if (is_told || !exchange_.HasRoom()) {
    return;
  }
  told_ = now;
  exchange_.Push(MOTORS_AND_POSTURE_PUSH, now);
}

bool MoveRequests::ArePositive(const SpeedLimits& limits) {
  for (int i = 0; i < limits.count; ++i) {
    if (limits.joints[i].value <= 0) {
      exchange_.Refuse(CODE_REFUSED, "a speed limit must be above 0, so nothing of the request was done");
      return false;
    }
  }
  return true;
}

// Refuses the request if the robot does not have one of these joints.
bool MoveRequests::HasJoints(const JointValue* joints, int count) {
  for (int i = 0; i < count; ++i) {
    if (!HasJoint(joints[i].id)) {
      return false;
    }
  }
  return true;
}

bool MoveRequests::HasJoint(int identifier) {
  if (robot_.joints.Find(identifier) == NO_JOINT) {
    exchange_.RefuseMissing("joint", identifier);
    return false;
  }
  return true;
}

// If a motion moves one of these joints and its file has not been read yet, it is refused: see JointControl::Play().
void MoveRequests::HoldJoints() {
  JointIds named;
  if (!exchange_.Decode(&named)) {
    return;
  }
  for (int i = 0; i < named.count; ++i) {
    if (!HasJoint(named.ids[i])) {
      return;
    }
  }
  for (int i = 0; i < named.count; ++i) {
    robot_.joints.Stop(robot_.joints.Find(named.ids[i]));
  }
  exchange_.ReplyWithoutPayload();
}

// Switches the motors on if they are off after a rest. Refuses the request if the robot cannot take the posture now.
bool MoveRequests::MayTake(Posture posture) {
  const char* problem = robot_.joints.Walking().Problem(posture);
  if (problem == NULL && !robot_.motors.AreOn()) {
    if (posture == POSTURE_REST) {
      problem = "the motors are off already; to lie down, switch them on first";
    } else if (!robot_.motors.Switch(true)) {
      problem = CANNOT_SWITCH_ON;
    }
  }
  if (problem != NULL) {
    exchange_.Refuse(CODE_REFUSED, problem);
  }
  return problem == NULL;
}

// Pushes the faults of joints. A fault for which the outbox has no room is pushed the next time.
void MoveRequests::PushJointFaults() {
  for (int i = 0; i < robot_.joints.NumberOfJoints() && exchange_.HasRoom(); ++i) {
    const JointWatch::Verdict fault = robot_.joints.TakeFault(i);
    if (fault != JointWatch::FOLLOWS) {
      char text[MAX_ERROR_TEXT_SIZE];
      sprintf(text, "%s %s", robot_.joints.Name(i), FAULTS[fault]);
      exchange_.PushError(CODE_JOINT_FAULT, text);
    }
  }
}

void MoveRequests::PushRecoveries() {
  for (int i = 0; i < robot_.joints.NumberOfJoints() && exchange_.HasRoom(); ++i) {
    if (robot_.joints.TakeRecovery(i)) {
      exchange_.PushEnd(ENDED_JAM, END_DONE, 0, robot_.joints.Name(i), "it follows its commands again");
    }
  }
}
