#include "rcserver/joints/JointPlanner.h"

#include <algorithm>

using namespace robot_model;

const int JointPlanner::FOLLOWING;
const unsigned JointPlanner::NO_COMMAND;

namespace {

const int FRAMES_PER_SECOND = 1000 / FRAME_MILLISECONDS;

// What one microradian per frame is in microradian/s, and one microradian per frame squared in microradian/s^2.
const int SPEED_UNIT = FRAMES_PER_SECOND;
const int ACCELERATION_UNIT = FRAMES_PER_SECOND * FRAMES_PER_SECOND;

int Clamped(int value, int low, int high) {
  return std::min(std::max(value, low), high);
}

// The follower's lower limit if the leader may be anywhere in the span. The limit is highest at one end of the span
// (robot_model.h).
int CoupledLowest(const Coupling& coupling, const JointPath::Span& leader) {
  return std::max(coupledLowest(coupling, leader.low), coupledLowest(coupling, leader.high));
}

}  // namespace

JointPlanner::JointPlanner(const RobotModel& robot) : robot_(robot), last_command_(NO_COMMAND) {
  int posture[MAX_JOINTS] = {0};
  clampPosture(robot_, posture);
  for (int i = 0; i < robot_.number_of_joints; ++i) {
    paths_[i].Place(posture[i]);
    is_aimed_[i] = false;
    LeaveCommand(i);
  }
  for (int i = 0; i < robot_.number_of_joints; ++i) {
    SetSpeedLimit(i, robot_.joints[i].highest_speed);
    SetAccelerationLimit(i, defaultAcceleration(robot_.joints[i]));
  }
}

void JointPlanner::SetPosition(int joint, int measured) {
  const Joint& limits = robot_.joints[joint];
  paths_[joint].Place(Clamped(measured, limits.mechanical_lowest, limits.mechanical_highest));
  LeaveCommand(joint);
  MakePartnersFit(joint);
}

void JointPlanner::Aim(int joint, int position) {
  is_aimed_[joint] = true;
  aims_[joint] = position;
}

void JointPlanner::Go(int duration) {
  FitAims();
  const int frames = duration > 0 ? (duration - 1) / FRAME_MILLISECONDS + 1 : 0;
  const unsigned command = frames > 0 ? ++last_command_ : NO_COMMAND;
  for (int i = 0; i < robot_.number_of_joints; ++i) {
    if (is_aimed_[i]) {
      is_aimed_[i] = false;
      paths_[i].Aim(aims_[i]);
      paths_[i].Delay(std::max(frames, FramesLeft(i)));
      commands_[i] = command;
    }
  }
  ArriveTogether();
}

void JointPlanner::Follow() {
  FitAims();
  for (int i = 0; i < robot_.number_of_joints; ++i) {
    if (is_aimed_[i]) {
      is_aimed_[i] = false;
      paths_[i].Follow(aims_[i], defaultAcceleration(robot_.joints[i]) * FOLLOWING / ACCELERATION_UNIT);
      LeaveCommand(i);
    }
  }
}

void JointPlanner::Hold(int joint) {
  paths_[joint].Stop(defaultAcceleration(robot_.joints[joint]) / ACCELERATION_UNIT);
  LeaveCommand(joint);
  MakePartnersFit(joint);
}

void JointPlanner::HoldAll() {
  for (int i = 0; i < robot_.number_of_joints; ++i) {
    Hold(i);
  }
}

int JointPlanner::SetSpeedLimit(int joint, int limit) {
  speed_limits_[joint] = Clamped(limit, SPEED_UNIT, robot_.joints[joint].highest_speed);
  paths_[joint].LimitStep(speed_limits_[joint] / SPEED_UNIT);
  ArriveTogether();
  return speed_limits_[joint];
}

int JointPlanner::SetAccelerationLimit(int joint, int limit) {
  const int highest = robot_.joints[joint].highest_speed * FRAMES_PER_SECOND;
  acceleration_limits_[joint] = Clamped(limit, ACCELERATION_UNIT, highest);
  paths_[joint].LimitAcceleration(acceleration_limits_[joint] / ACCELERATION_UNIT);
  ArriveTogether();
  return acceleration_limits_[joint];
}

void JointPlanner::NextFrame() {
  for (int i = 0; i < robot_.number_of_joints; ++i) {
    const int wanted = paths_[i].WantedStep();
    const int allowed = AllowedStep(i, wanted);
    if (allowed != wanted) {
      // The joint may have to wait for another joint of the same command, which must not wait for it in turn.
      LeaveCommand(i);
    }
    paths_[i].Advance(allowed);
  }
  ArriveTogether();
}

// Adapts the aims to limits and couplings. A follower that is in the way of its leader gets an aim, too.
void JointPlanner::FitAims() {
  for (int i = 0; i < robot_.number_of_joints; ++i) {
    const Joint& limits = robot_.joints[i];
    aims_[i] = is_aimed_[i] ? Clamped(aims_[i], limits.lowest, limits.highest) : Target(i);
  }
  for (int i = 0; i < robot_.number_of_couplings; ++i) {
    const Coupling& coupling = robot_.couplings[i];
    const int lowest = coupledLowest(coupling, aims_[coupling.leader]);
    if ((is_aimed_[coupling.leader] || is_aimed_[coupling.follower]) && aims_[coupling.follower] < lowest) {
      Aim(coupling.follower, lowest);
    }
  }
}

void JointPlanner::LeaveCommand(int joint) {
  commands_[joint] = NO_COMMAND;
}

// Adapts the joint's partners. The joint's target is now where it stands or stops, and theirs may no longer fit.
void JointPlanner::MakePartnersFit(int joint) {
  for (int i = 0; i < robot_.number_of_couplings; ++i) {
    const Coupling& coupling = robot_.couplings[i];
    const int lowest = coupledLowest(coupling, Target(coupling.leader));
    if (lowest <= Target(coupling.follower)) {
      continue;
    }
    if (coupling.follower == joint) {
      Hold(coupling.leader);
    } else if (coupling.leader == joint) {
      // A follower that somebody has moved out of its limits by hand is not commanded.
      const int stops_at = paths_[coupling.follower].BrakingSpan().low;
      if (Target(coupling.follower) < stops_at) {
        paths_[coupling.follower].Aim(std::min(lowest, stops_at));
        LeaveCommand(coupling.follower);
      }
    }
  }
}

// If a joint cannot arrive in time, the others of the same command arrive later, too.
void JointPlanner::ArriveTogether() {
  for (int i = 0; i < robot_.number_of_joints; ++i) {
    for (int j = 0; commands_[i] != NO_COMMAND && j < robot_.number_of_joints; ++j) {
      if (commands_[i] == commands_[j]) {
        paths_[i].Delay(std::max(FramesLeft(i), FramesLeft(j)));
      }
    }
  }
}

// The safe step that is nearest to the wanted step. It is always safe to brake.
int JointPlanner::AllowedStep(int joint, int wanted) const {
  int allowed = paths_[joint].BrakingStep();
  if (wanted == allowed || IsAllowed(joint, paths_[joint].SpanAfter(wanted))) {
    return wanted;
  }
  int refused = wanted;
  while (refused - allowed > 1 || allowed - refused > 1) {
    const int middle = allowed + (refused - allowed) / 2;
    (IsAllowed(joint, paths_[joint].SpanAfter(middle)) ? allowed : refused) = middle;
  }
  return allowed;
}

// After SetPosition(), two joints may touch, or a joint may be outside its limits. No joint may then go farther out.
bool JointPlanner::IsAllowed(int joint, const JointPath::Span& next) const {
  const JointPath::Span now = paths_[joint].BrakingSpan();
  const Joint& limits = robot_.joints[joint];
  if (next.low < std::min(now.low, limits.lowest) || next.high > std::max(now.high, limits.highest)) {
    return false;
  }
  for (int i = 0; i < robot_.number_of_couplings; ++i) {
    const Coupling& coupling = robot_.couplings[i];
    if (coupling.follower == joint) {
      const int lowest = CoupledLowest(coupling, paths_[coupling.leader].BrakingSpan());
      if (next.low < std::min(now.low, lowest)) {
        return false;
      }
    } else if (coupling.leader == joint) {
      const int follower = paths_[coupling.follower].BrakingSpan().low;
      if (CoupledLowest(coupling, next) > std::max(follower, CoupledLowest(coupling, now))) {
        return false;
      }
    }
  }
  return true;
}
