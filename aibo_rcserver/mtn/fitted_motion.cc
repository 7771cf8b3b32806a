#include "mtn/fitted_motion.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <algorithm>

namespace mtn {

using robot_model::Coupling;
using robot_model::CouplingRow;
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

}  // namespace

const int FittedMotion::TOLERANCE;
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
  if (!findParts(leave_out)) {
    clear();
    return false;
  }
  measureClips();
  return true;
}

void FittedMotion::posture(int key_frame, int* positions) const {
  for (int i = 0; i < number_of_joints_; ++i) {
    const Joint& limits = robot_->joints[joints_[i]];
    positions[i] = std::min(std::max(motion_->position(key_frame, columns_[i]), limits.lowest), limits.highest);
  }
  for (int i = 0; i < robot_->number_of_couplings; ++i) {
    const Coupling& coupling = robot_->couplings[i];
    const int leader = places_[coupling.leader];
    const int follower = places_[coupling.follower];
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
  int slowest = NO_JOINT;
  const double needed = slowestTime(key_frame, speed_limits, &slowest);
  return std::max(motion_->milliseconds(key_frame), static_cast<int>(needed));
}

void FittedMotion::describe(const int* speed_limits, char* text) const {
  const char* separator = "";
  text[0] = '\0';
  if (left_out_ > 0) {
    text += sprintf(text, "%d joint%s that this robot does not have %s left out", left_out_, ending(left_out_),
                    verb(left_out_));
    separator = "; ";
  }
  char part[MAX_DESCRIPTION_SIZE];
  if (describeClips(part) > 0) {
    text += sprintf(text, "%s%s", separator, part);
    separator = "; ";
  }
  if (describeSteps(speed_limits, part) > 0) {
    sprintf(text, "%s%s", separator, part);
  }
}

void FittedMotion::clear() {
  number_of_key_frames_ = 0;
  number_of_joints_ = 0;
  std::fill(places_, places_ + robot_model::MAX_JOINTS, static_cast<int>(NO_JOINT));
  std::fill(ears_, ears_ + MAX_EARS, static_cast<int>(NO_EAR));
  left_out_ = 0;
  for (int i = 0; i < robot_model::MAX_JOINTS; ++i) {
    const Clip none = {i, 0, 0};
    clips_[i] = none;
  }
}

// Finds the robot's joints and ears by their locators, which are unique within a motion.
bool FittedMotion::findParts(bool leave_out) {
  bool has_ears = false;
  for (int i = 0; i < motion_->numberOfJoints(); ++i) {
    const char* const locator = motion_->locator(i);
    const int joint = findJointByLocator(*robot_, locator);
    const int ear = findEarByLocator(*robot_, locator);
    if (joint != NO_JOINT) {
      places_[joint] = number_of_joints_;
      joints_[number_of_joints_] = joint;
      columns_[number_of_joints_] = i;
      ++number_of_joints_;
    } else if (ear != NO_EAR) {
      ears_[ear] = i;
      has_ears = true;
    } else if (leave_out) {
      ++left_out_;
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

void FittedMotion::measureClips() {
  int from[robot_model::MAX_JOINTS];
  int to[robot_model::MAX_JOINTS];
  int begin = 0;
  for (int key_frame = 0; key_frame < number_of_key_frames_; ++key_frame) {
    const int duration = motion_->milliseconds(key_frame);
    posture(key_frame, to);
    if (key_frame > 0) {
      measureOnTheWay(from, to, begin, duration);
    }
    begin += duration;
    for (int i = 0; i < number_of_joints_; ++i) {
      noteClip(joints_[i], abs(to[i] - motion_->position(key_frame, columns_[i])), begin);
    }
    std::copy(to, to + number_of_joints_, from);
  }
}

// Both ways are straight. So while the leader passes a row and the gaps beside it, the follower is farthest below the
// row's limit when the leader enters or leaves them.
void FittedMotion::measureOnTheWay(const int* from, const int* to, int begin, int duration) {
  for (int i = 0; i < robot_->number_of_couplings; ++i) {
    const Coupling& coupling = robot_->couplings[i];
    const int leader = places_[coupling.leader];
    const int follower = places_[coupling.follower];
    if (leader == NO_JOINT || follower == NO_JOINT) {
      continue;
    }
    for (int end = 1; end < 2 * coupling.number_of_rows - 1; ++end) {
      const CouplingRow* const row = &coupling.rows[end / 2];
      const int at = end % 2 == 0 ? std::min(row[0].from, row[-1].to) : std::max(row[0].to, row[1].from);
      if (at > std::min(from[leader], to[leader]) && at < std::max(from[leader], to[leader])) {
        const double passed = static_cast<double>(at - from[leader]) / (to[leader] - from[leader]);
        const double position = from[follower] + passed * (to[follower] - from[follower]);
        noteClip(coupling.follower, row->lowest - position, begin + passed * duration);
      }
    }
  }
}

void FittedMotion::noteClip(int joint, double distance, double time) {
  if (distance > TOLERANCE && distance > clips_[joint].distance) {
    clips_[joint].distance = static_cast<int>(distance);
    clips_[joint].time = static_cast<int>(time + 0.5);
  }
}

bool FittedMotion::isFarther(const Clip& a, const Clip& b) {
  return a.distance != b.distance ? a.distance > b.distance : a.joint < b.joint;
}

// The time that the joints need for the step to a key frame at these speeds, in milliseconds.
double FittedMotion::slowestTime(int key_frame, const int* speed_limits, int* joint) const {
  int from[robot_model::MAX_JOINTS];
  int to[robot_model::MAX_JOINTS];
  posture(key_frame - 1, from);
  posture(key_frame, to);
  double longest = 0;
  for (int i = 0; i < number_of_joints_; ++i) {
    const double way = abs(to[i] - from[i]) - TOLERANCE;
    const double time = ceil(way * 1000 / speed_limits[joints_[i]]);
    if (time > longest) {
      longest = time;
      *joint = joints_[i];
    }
  }
  return longest;
}

// Describes the largest clips, and returns the number of clipped joints.
int FittedMotion::describeClips(char* text) const {
  const int most_told = 3;
  Clip clips[robot_model::MAX_JOINTS];
  std::copy(clips_, clips_ + robot_model::MAX_JOINTS, clips);
  std::sort(clips, clips + robot_model::MAX_JOINTS, isFarther);
  int count = 0;
  for (; count < robot_model::MAX_JOINTS && clips[count].distance > 0; ++count) {
    const Clip& clip = clips[count];
    if (count < most_told) {
      text += sprintf(text, count == 0 ? "%s is clipped by up to %s degrees (at %d ms)" : ", %s by up to %s (at %d ms)",
                      robot_->joints[clip.joint].name, Degrees(clip.distance).text, clip.time);
    }
  }
  if (count > most_told) {
    sprintf(text, ", and %d more joint%s", count - most_told, ending(count - most_told));
  }
  return count;
}

// Describes the steps that take longer, and returns their number.
int FittedMotion::describeSteps(const int* speed_limits, char* text) const {
  int count = 0;
  double all = 0;
  double longer = 0;
  double worst = 0;
  int worst_joint = NO_JOINT;
  int worst_time = 0;
  int time = 0;
  for (int key_frame = 1; key_frame < number_of_key_frames_; ++key_frame) {
    int slowest = NO_JOINT;
    const int wanted = motion_->milliseconds(key_frame);
    const double excess = std::max(slowestTime(key_frame, speed_limits, &slowest) - wanted, 0.0);
    time += wanted;
    all += wanted + excess;
    longer += excess;
    count += excess > 0 ? 1 : 0;
    if (excess > worst) {
      worst = excess;
      worst_joint = slowest;
      worst_time = time;
    }
  }
  if (count > 0) {
    sprintf(text, "%d step%s %s too fast (%s%s at %d ms), so it takes %s s, which is %s s longer", count, ending(count),
            verb(count), count > 1 ? "most of all " : "", robot_->joints[worst_joint].name, worst_time,
            Seconds(all).text, Seconds(longer).text);
  }
  return count;
}

}  // namespace mtn
