#include "rcserver/walk/LegJoints.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <algorithm>

using namespace robot_model;

namespace {

const double MICRO = 1e-6;

double AngleOf(const LegAngles& leg, int number) {
  return number == 0 ? leg.rotator : number == 1 ? leg.elevator : leg.knee;
}

int Microradians(double angle) {
  return static_cast<int>(floor(angle / MICRO + 0.5));
}

}  // namespace

const int LegJoints::COUNT;

LegJoints::LegJoints(JointPlanner& planner, const RobotModel& robot)
    : planner_(planner), robot_(robot), are_there_(strcmp(robot.design, "ERS-7") == 0) {
  for (int i = 0; i < COUNT; ++i) {
    const Leg leg = static_cast<Leg>(i / JOINTS_OF_A_LEG);
    joints_[i] = findJointByIdentifier(robot, legJointIdentifier(leg, i % JOINTS_OF_A_LEG));
    are_there_ = are_there_ && joints_[i] != NO_JOINT;
  }
}

bool LegJoints::Has(int joint) const {
  return are_there_ && std::find(joints_, joints_ + COUNT, joint) != joints_ + COUNT;
}

void LegJoints::Find(const int* positions, LegAngles* legs) const {
  for (int i = 0; i < NUMBER_OF_LEGS; ++i) {
    const int* const leg = joints_ + i * JOINTS_OF_A_LEG;
    legs[i].rotator = positions[leg[0]] * MICRO;
    legs[i].elevator = positions[leg[1]] * MICRO;
    legs[i].knee = positions[leg[2]] * MICRO;
  }
}

void LegJoints::Find(LegAngles* legs) const {
  int positions[MAX_JOINTS];
  for (int i = 0; i < robot_.number_of_joints; ++i) {
    positions[i] = planner_.Position(i);
  }
  Find(positions, legs);
}

int LegJoints::Aim(const LegAngles* legs, const bool* moves) const {
  int farthest = 0;
  for (int i = 0; i < COUNT; ++i) {
    const int number = i % JOINTS_OF_A_LEG;
    if (moves == NULL || moves[number]) {
      const int target = Microradians(AngleOf(legs[i / JOINTS_OF_A_LEG], number));
      planner_.Aim(joints_[i], target);
      farthest = std::max(farthest, abs(target - planner_.Position(joints_[i])));
    }
  }
  return farthest;
}

bool LegJoints::HaveArrived() const {
  for (int i = 0; i < COUNT; ++i) {
    if (planner_.FramesLeft(joints_[i]) > 0) {
      return false;
    }
  }
  return true;
}

void LegJoints::Hold() const {
  for (int i = 0; i < COUNT; ++i) {
    planner_.Hold(joints_[i]);
  }
}

void LegJoints::ResetSpeedLimits() const {
  for (int i = 0; i < COUNT; ++i) {
    planner_.SetSpeedLimit(joints_[i], robot_.joints[joints_[i]].highest_speed);
  }
}

int LegJoints::FindSlow() const {
  for (int i = 0; i < COUNT; ++i) {
    if (planner_.SpeedLimit(joints_[i]) < robot_.joints[joints_[i]].highest_speed) {
      return joints_[i];
    }
  }
  return NO_JOINT;
}
