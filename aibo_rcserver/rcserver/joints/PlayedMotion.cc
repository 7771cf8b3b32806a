#include "rcserver/joints/PlayedMotion.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <algorithm>

using namespace robot_model;

const int PlayedMotion::APPROACH_SPEED;

PlayedMotion::PlayedMotion()
    : phase_(OVER), order_(0), repetitions_left_(0), key_frame_(0), milliseconds_(0), duration_(0) {
  name_[0] = '\0';
  problem_[0] = '\0';
  std::fill(begin_, begin_ + MAX_JOINTS, 0);
  std::fill(end_, end_ + MAX_JOINTS, 0);
  std::fill(flicks_, flicks_ + MAX_EARS, false);
}

bool PlayedMotion::Load(const protocol::MotionName& name, size_t size, const RobotModel& robot, bool leave_out) {
  strcpy(name_, name);
  if (!motion_.read(file_, size)) {
    sprintf(problem_, "is not a motion file: %s", motion_.problem());
    return false;
  }
  if (!fitted_.fit(motion_, robot, leave_out)) {
    strcpy(problem_, fitted_.problem());
    return false;
  }
  return true;
}

void PlayedMotion::Start(int repetitions, int order) {
  phase_ = BEGINNING;
  order_ = order;
  repetitions_left_ = repetitions;
}

void PlayedMotion::DescribeChanges(const JointPlanner& planner, char* text) const {
  fitted_.describe(planner.SpeedLimits(), text);
}

bool PlayedMotion::SharesJoint(const PlayedMotion& other, int* joint) const {
  for (int i = 0; i < fitted_.numberOfJoints(); ++i) {
    if (other.Moves(fitted_.joint(i))) {
      *joint = fitted_.joint(i);
      return true;
    }
  }
  return false;
}

void PlayedMotion::NextFrame(JointPlanner& planner) {
  if (phase_ == ARRIVING && HaveArrived(planner)) {
    Repeat();
  }
  if (phase_ == BEGINNING) {
    Approach(planner);
    phase_ = APPROACHING;
  }
  if (phase_ == APPROACHING && HaveArrived(planner)) {
    phase_ = PLAYING;
    milliseconds_ = 0;
    GoTo(1, planner);
  }
  if (phase_ == PLAYING) {
    PassTime(planner);
    Follow(planner);
  }
}

bool PlayedMotion::TakeFlick(int ear) {
  const bool flicks = flicks_[ear];
  flicks_[ear] = false;
  return flicks;
}

void PlayedMotion::Stop(JointPlanner& planner) {
  phase_ = OVER;
  std::fill(flicks_, flicks_ + MAX_EARS, false);
  for (int i = 0; i < fitted_.numberOfJoints(); ++i) {
    planner.Hold(fitted_.joint(i));
  }
}

void PlayedMotion::Approach(JointPlanner& planner) {
  fitted_.posture(0, end_);
  int farthest = 0;
  for (int i = 0; i < fitted_.numberOfJoints(); ++i) {
    planner.Aim(fitted_.joint(i), end_[i]);
    farthest = std::max(farthest, abs(end_[i] - planner.Position(fitted_.joint(i))));
  }
  const double seconds = static_cast<double>(farthest) / APPROACH_SPEED;
  planner.Go(static_cast<int>(seconds * 1000));
}

// Makes the joints move from the current key frame to this one, if the motion has it.
void PlayedMotion::GoTo(int key_frame, const JointPlanner& planner) {
  key_frame_ = key_frame;
  if (key_frame < fitted_.numberOfKeyFrames()) {
    std::copy(end_, end_ + MAX_JOINTS, begin_);
    fitted_.posture(key_frame, end_);
    duration_ = fitted_.milliseconds(key_frame, planner.SpeedLimits());
  }
}

// Finds the key frame that is next at this time, or ends the repetition after the last key frame.
void PlayedMotion::PassTime(const JointPlanner& planner) {
  milliseconds_ += FRAME_MILLISECONDS;
  while (phase_ == PLAYING) {
    if (key_frame_ == fitted_.numberOfKeyFrames()) {
      if (repetitions_left_ == 1 || !IsClosed()) {
        phase_ = ARRIVING;
      } else {
        --repetitions_left_;
        GoTo(1, planner);
      }
    } else if (milliseconds_ >= duration_) {
      milliseconds_ -= duration_;
      FlickEars();
      GoTo(key_frame_ + 1, planner);
    } else {
      return;
    }
  }
}

// Flicks the ears whose value changes at key_frame_.
void PlayedMotion::FlickEars() {
  for (int ear = 0; ear < MAX_EARS; ++ear) {
    flicks_[ear] = fitted_.flicks(key_frame_, ear) || flicks_[ear];
  }
}

void PlayedMotion::Repeat() {
  --repetitions_left_;
  phase_ = repetitions_left_ > 0 ? BEGINNING : OVER;
}

// True if the first key frame equals the last one, where the joints are.
bool PlayedMotion::IsClosed() const {
  int first[MAX_JOINTS];
  fitted_.posture(0, first);
  return fitted_.numberOfKeyFrames() > 1 && std::equal(first, first + fitted_.numberOfJoints(), end_);
}

bool PlayedMotion::HaveArrived(const JointPlanner& planner) const {
  for (int i = 0; i < fitted_.numberOfJoints(); ++i) {
    if (planner.FramesLeft(fitted_.joint(i)) > 0) {
      return false;
    }
  }
  return true;
}

int PlayedMotion::PositionNow(int i) const {
  if (phase_ == ARRIVING) {
    return end_[i];
  }
  const double way = static_cast<double>(end_[i]) - begin_[i];
  return static_cast<int>(floor(begin_[i] + way * milliseconds_ / duration_ + 0.5));
}

void PlayedMotion::Follow(JointPlanner& planner) const {
  for (int i = 0; i < fitted_.numberOfJoints(); ++i) {
    planner.Aim(fitted_.joint(i), PositionNow(i));
  }
  planner.Go(0);
}
