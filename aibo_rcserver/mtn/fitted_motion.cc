#include "mtn/fitted_motion.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <algorithm>

namespace mtn {

using robot_model::Coupling;
using robot_model::Joint;
using robot_model::MAX_EARS;
using robot_model::NO_EAR;
using robot_model::NO_JOINT;
using robot_model::RobotModel;

namespace {

const double DEGREE = 3.14159265358979323846e6 / 180;  // in microradians

// A rounded number as text. The robot's sprintf() may not round correctly.
struct Decimal {
  Decimal(double value, int digits) {
    const int unit = digits == 1 ? 10 : 100;
    const int parts = static_cast<int>(std::min(floor(fabs(value) * unit + 0.5), 2e9));
    sprintf(text, "%s%d.%0*d", value < 0 && parts > 0 ? "-" : "", parts / unit, digits, parts % unit);
  }
  char text[16];
};

struct Degrees : Decimal {
  explicit Degrees(int microradians) : Decimal(microradians / DEGREE, 1) {}
};

struct Seconds : Decimal {
  explicit Seconds(double milliseconds) : Decimal(milliseconds / 1000, 2) {}
};

const char* ending(int count) {
  return count == 1 ? "" : "s";
}

const char* verb(int count) {
  return count == 1 ? "is" : "are";
}

int timeOf(const Motion& motion, int key_frame) {
  int milliseconds = 0;
  for (int i = 1; i <= key_frame; ++i) {
    milliseconds += motion.milliseconds(i);
  }
  return milliseconds;
}

}  // namespace

const int FittedMotion::TOLERANCE;
const int FittedMotion::MOST_CLIPPED;
const size_t FittedMotion::MAX_PROBLEM_SIZE;
const size_t FittedMotion::MAX_DESCRIPTION_SIZE;

FittedMotion::FittedMotion() : motion_(NULL), robot_(NULL) {
  problem_[0] = '\0';
  clear();
}

bool FittedMotion::fit(const Motion& motion, const RobotModel& robot, bool leave_out) {
  problem_[0] = '\0';
  clear();
  motion_ = &motion;
  robot_ = &robot;
  number_of_key_frames_ = motion.numberOfKeyFrames();
  if (findParts(leave_out) && checkPositions()) {
    return true;
  }
  clear();
  return false;
}

bool FittedMotion::moves(int joint) const {
  return std::count(joints_, joints_ + number_of_joints_, joint) > 0;
}

void FittedMotion::posture(int key_frame, int* positions) const {
  int place[robot_model::MAX_JOINTS];  // for each of the robot's joints, its index in `positions`
  std::fill(place, place + robot_model::MAX_JOINTS, static_cast<int>(NO_JOINT));
  for (int i = 0; i < number_of_joints_; ++i) {
    const Joint& limits = robot_->joints[joints_[i]];
    place[joints_[i]] = i;
    positions[i] = std::min(std::max(motion_->position(key_frame, columns_[i]), limits.lowest), limits.highest);
  }
  for (int i = 0; i < robot_->number_of_couplings; ++i) {
    const Coupling& coupling = robot_->couplings[i];
    const int leader = place[coupling.leader];
    const int follower = place[coupling.follower];
    if (leader != NO_JOINT && follower != NO_JOINT) {
      positions[follower] = std::max(positions[follower], coupledLowest(coupling, positions[leader]));
    }
  }
}

bool FittedMotion::flicks(int key_frame, int ear) const {
  const int column = ears_[ear];
  return column != NO_EAR && motion_->position(key_frame, column) != motion_->position(key_frame - 1, column);
}

int FittedMotion::milliseconds(int key_frame, const int* speed_limits) const {
  int from[robot_model::MAX_JOINTS];
  int to[robot_model::MAX_JOINTS];
  posture(key_frame - 1, from);
  posture(key_frame, to);
  double longest = motion_->milliseconds(key_frame);
  for (int i = 0; i < number_of_joints_; ++i) {
    const double way = abs(to[i] - from[i]) - TOLERANCE;
    longest = std::max(longest, ceil(way * 1000 / speed_limits[joints_[i]]));
  }
  return static_cast<int>(longest);
}

void FittedMotion::describe(const int* speed_limits, char* text) const {
  const char* separator = "";
  text[0] = '\0';
  if (changes_.left_out > 0) {
    text += sprintf(text, "%d joint%s that this robot does not have %s left out", changes_.left_out,
                    ending(changes_.left_out), verb(changes_.left_out));
    separator = "; ";
  }
  if (changes_.clipped > 0) {
    text += sprintf(text, "%s%d position%s %s clipped, by up to %s degrees (%s at %d ms)", separator, changes_.clipped,
                    ending(changes_.clipped), verb(changes_.clipped), Degrees(changes_.farthest).text,
                    robot_->joints[changes_.farthest_joint].name, timeOf(*motion_, changes_.farthest_key_frame));
    separator = "; ";
  }
  char steps[MAX_DESCRIPTION_SIZE / 2];
  if (describeSteps(speed_limits, steps) > 0) {
    sprintf(text, "%s%s", separator, steps);
  }
}

void FittedMotion::clear() {
  number_of_key_frames_ = 0;
  number_of_joints_ = 0;
  std::fill(ears_, ears_ + MAX_EARS, static_cast<int>(NO_EAR));
  const Changes none = {0, 0, 0, NO_JOINT, 0};
  changes_ = none;
}

// Finds the robot's joints and ears by their locators, which are unique within a motion.
bool FittedMotion::findParts(bool leave_out) {
  bool has_ears = false;
  for (int i = 0; i < motion_->numberOfJoints(); ++i) {
    const char* const locator = motion_->locator(i);
    const int joint = findJointByLocator(*robot_, locator);
    const int ear = findEarByLocator(*robot_, locator);
    if (joint != NO_JOINT) {
      joints_[number_of_joints_] = joint;
      columns_[number_of_joints_] = i;
      ++number_of_joints_;
    } else if (ear != NO_EAR) {
      ears_[ear] = i;
      has_ears = true;
    } else if (leave_out) {
      ++changes_.left_out;
    } else {
      sprintf(problem_, "moves the joint %s, which this robot does not have", locator);
      return false;
    }
  }
  if (number_of_joints_ == 0 && !has_ears) {
    sprintf(problem_, "moves no joint that this robot has");
    return false;
  }
  return true;
}

bool FittedMotion::checkPositions() {
  for (int key_frame = 0; key_frame < number_of_key_frames_; ++key_frame) {
    int positions[robot_model::MAX_JOINTS];
    posture(key_frame, positions);
    countClipped(key_frame, positions);
  }
  if (changes_.farthest <= MOST_CLIPPED) {
    return true;
  }
  const int column = columns_[std::find(joints_, joints_ + number_of_joints_, changes_.farthest_joint) - joints_];
  const int key_frame = changes_.farthest_key_frame;
  sprintf(problem_, "moves %s to %s degrees at %d ms, %s beyond what it can do there; up to %s are clipped",
          robot_->joints[changes_.farthest_joint].name, Degrees(motion_->position(key_frame, column)).text,
          timeOf(*motion_, key_frame), Degrees(changes_.farthest).text, Degrees(MOST_CLIPPED).text);
  return false;
}

void FittedMotion::countClipped(int key_frame, const int* posture) {
  for (int i = 0; i < number_of_joints_; ++i) {
    const int distance = abs(posture[i] - motion_->position(key_frame, columns_[i]));
    if (distance <= TOLERANCE) {
      continue;
    }
    ++changes_.clipped;
    if (distance > changes_.farthest) {
      changes_.farthest = distance;
      changes_.farthest_joint = joints_[i];
      changes_.farthest_key_frame = key_frame;
    }
  }
}

// Describes the steps that take longer, and returns their number.
int FittedMotion::describeSteps(const int* speed_limits, char* text) const {
  int count = 0;
  double all = 0;
  double longer = 0;
  for (int key_frame = 1; key_frame < number_of_key_frames_; ++key_frame) {
    const int time = milliseconds(key_frame, speed_limits);
    const int wanted = motion_->milliseconds(key_frame);
    all += time;
    longer += static_cast<double>(time) - wanted;
    count += time > wanted ? 1 : 0;
  }
  sprintf(text, "%d step%s %s too fast, so it takes %s s, which is %s s longer", count, ending(count), verb(count),
          Seconds(all).text, Seconds(longer).text);
  return count;
}

}  // namespace mtn
