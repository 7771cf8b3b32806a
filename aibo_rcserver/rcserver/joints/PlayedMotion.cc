#include "rcserver/joints/PlayedMotion.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <algorithm>

using robot_model::NO_JOINT;
using robot_model::RobotModel;

const int PlayedMotion::APPROACH_SPEED;

const char* findJoints(const mtn::Motion& motion, const RobotModel& robot, int* joints) {
  for (int i = 0; i < motion.numberOfJoints(); ++i) {
    joints[i] = findJointByLocator(robot, motion.locator(i));
    if (joints[i] == NO_JOINT) {
      return motion.locator(i);
    }
  }
  return NULL;
}

PlayedMotion::PlayedMotion() : phase_(OVER), repetitions_left_(0), key_frame_(0), milliseconds_(0) {
  name_[0] = '\0';
  problem_[0] = '\0';
}

bool PlayedMotion::Load(const protocol::MotionName& name, size_t size, const RobotModel& robot) {
  strcpy(name_, name);
  if (!motion_.read(file_, size)) {
    sprintf(problem_, "is not a motion file: %s", motion_.problem());
    return false;
  }
  if (const char* missing = findJoints(motion_, robot, joints_)) {
    sprintf(problem_, "moves the joint %s, which this robot does not have", missing);
    return false;
  }
  return true;
}

void PlayedMotion::Start(int repetitions) {
  phase_ = BEGINNING;
  repetitions_left_ = repetitions;
}

bool PlayedMotion::Moves(int joint) const {
  return std::count(joints_, joints_ + motion_.numberOfJoints(), joint) > 0;
}

bool PlayedMotion::SharesJoint(const PlayedMotion& other, int* joint) const {
  for (int i = 0; i < motion_.numberOfJoints(); ++i) {
    if (other.Moves(joints_[i])) {
      *joint = joints_[i];
      return true;
    }
  }
  return false;
}

void PlayedMotion::NextFrame(MotionPlanner& planner) {
  if (phase_ == ARRIVING && HaveArrived(planner)) {
    Repeat();
  }
  if (phase_ == BEGINNING) {
    Approach(planner);
    phase_ = APPROACHING;
  }
  if (phase_ == APPROACHING && HaveArrived(planner)) {
    phase_ = PLAYING;
    key_frame_ = 1;
    milliseconds_ = 0;
  }
  if (phase_ == PLAYING) {
    PassTime();
    Follow(planner);
  }
}

void PlayedMotion::Stop(MotionPlanner& planner) {
  phase_ = OVER;
  for (int i = 0; i < motion_.numberOfJoints(); ++i) {
    planner.Hold(joints_[i]);
  }
}

void PlayedMotion::Approach(MotionPlanner& planner) {
  MotionPlanner::JointTarget targets[mtn::MAX_JOINTS];
  int farthest = 0;
  for (int i = 0; i < motion_.numberOfJoints(); ++i) {
    targets[i].joint = joints_[i];
    targets[i].position = motion_.position(0, i);
    farthest = std::max(farthest, abs(targets[i].position - planner.Position(joints_[i])));
  }
  const double seconds = static_cast<double>(farthest) / APPROACH_SPEED;
  planner.SetTargets(targets, motion_.numberOfJoints(), static_cast<int>(seconds * 1000));
}

// Finds the next key frame for this time, or the end of the repetition after the last one.
void PlayedMotion::PassTime() {
  milliseconds_ += MotionPlanner::FRAME_MILLISECONDS;
  while (phase_ == PLAYING) {
    if (key_frame_ == motion_.numberOfKeyFrames()) {
      if (repetitions_left_ == 1 || !IsClosed()) {
        phase_ = ARRIVING;
      } else {
        --repetitions_left_;
        key_frame_ = 1;
      }
    } else if (milliseconds_ >= motion_.milliseconds(key_frame_)) {
      milliseconds_ -= motion_.milliseconds(key_frame_);
      ++key_frame_;
    } else {
      return;
    }
  }
}

void PlayedMotion::Repeat() {
  --repetitions_left_;
  phase_ = repetitions_left_ > 0 ? BEGINNING : OVER;
}

bool PlayedMotion::IsClosed() const {
  const int last = motion_.numberOfKeyFrames() - 1;
  for (int i = 0; i < motion_.numberOfJoints(); ++i) {
    if (motion_.position(last, i) != motion_.position(0, i)) {
      return false;
    }
  }
  return last > 0;
}

bool PlayedMotion::HaveArrived(const MotionPlanner& planner) const {
  for (int i = 0; i < motion_.numberOfJoints(); ++i) {
    if (planner.FramesLeft(joints_[i]) > 0) {
      return false;
    }
  }
  return true;
}

int PlayedMotion::PositionNow(int i) const {
  if (phase_ == ARRIVING) {
    return motion_.position(motion_.numberOfKeyFrames() - 1, i);
  }
  const double from = motion_.position(key_frame_ - 1, i);
  const double way = motion_.position(key_frame_, i) - from;
  return static_cast<int>(floor(from + way * milliseconds_ / motion_.milliseconds(key_frame_) + 0.5));
}

void PlayedMotion::Follow(MotionPlanner& planner) const {
  MotionPlanner::JointTarget targets[mtn::MAX_JOINTS];
  for (int i = 0; i < motion_.numberOfJoints(); ++i) {
    targets[i].joint = joints_[i];
    targets[i].position = PositionNow(i);
  }
  planner.SetTargets(targets, motion_.numberOfJoints(), 0);
}
