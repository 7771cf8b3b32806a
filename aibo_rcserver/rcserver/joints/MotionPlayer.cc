#include "rcserver/joints/MotionPlayer.h"

#include <stdio.h>
#include <string.h>

using robot_model::NO_JOINT;

const int MotionPlayer::MAX_PLAYING;
const int MotionPlayer::MAX_ENDS;
const size_t MotionPlayer::MAX_PROBLEM_SIZE;

MotionPlayer::MotionPlayer(MotionPlanner& planner, const robot_model::RobotModel& robot)
    : planner_(planner), robot_(robot), number_of_ends_(0) {
  problem_[0] = '\0';
  changes_[0] = '\0';
}

unsigned char* MotionPlayer::FindRoom() {
  PlayedMotion* const motion = FindFree();
  return motion != NULL ? motion->Room() : NULL;
}

const char* MotionPlayer::Play(const protocol::MotionName& name, size_t size, int repetitions, bool leave_out,
                               const bool* commanded) {
  PlayedMotion& motion = *FindFree();
  if (!motion.Load(name, size, robot_, leave_out)) {
    sprintf(problem_, "%s %s", name, motion.Problem());
    return problem_;
  }
  if (!FindsJointsFree(motion) || (commanded != NULL && !FindsJointsUncommanded(motion, commanded))) {
    return problem_;
  }
  motion.DescribeChanges(planner_, changes_);
  motion.Start(repetitions);
  return NULL;
}

void MotionPlayer::Stop(const protocol::MotionName& name) {
  for (int i = 0; i < MAX_PLAYING; ++i) {
    if (motions_[i].IsPlaying() && strcmp(motions_[i].Name(), name) == 0) {
      Stop(motions_[i], STOPPED, NO_JOINT);
    }
  }
}

void MotionPlayer::StopAll(Cause cause) {
  for (int i = 0; i < MAX_PLAYING; ++i) {
    if (motions_[i].IsPlaying()) {
      Stop(motions_[i], cause, NO_JOINT);
    }
  }
}

void MotionPlayer::StopMotionOf(int joint, Cause cause) {
  if (Moves(joint)) {
    Stop(motions_[FindMoving(joint)], cause, joint);
  }
}

void MotionPlayer::EndRepetitions() {
  for (int i = 0; i < MAX_PLAYING; ++i) {
    motions_[i].EndRepetitions();
  }
}

bool MotionPlayer::IsPlaying() const {
  for (int i = 0; i < MAX_PLAYING; ++i) {
    if (motions_[i].IsPlaying()) {
      return true;
    }
  }
  return false;
}

bool MotionPlayer::TakeFlick(int ear) {
  bool flicks = false;
  for (int i = 0; i < MAX_PLAYING; ++i) {
    flicks = motions_[i].TakeFlick(ear) || flicks;
  }
  return flicks;
}

bool MotionPlayer::TakeEnd(End* end) {
  if (number_of_ends_ == 0) {
    return false;
  }
  *end = ends_[0];
  --number_of_ends_;
  memmove(ends_, ends_ + 1, static_cast<size_t>(number_of_ends_) * sizeof(End));
  return true;
}

void MotionPlayer::ClientGone() {
  StopAll(STOPPED);
  number_of_ends_ = 0;
}

void MotionPlayer::NextFrame() {
  for (int i = 0; i < MAX_PLAYING; ++i) {
    if (motions_[i].IsPlaying()) {
      motions_[i].NextFrame(planner_);
      if (!motions_[i].IsPlaying()) {
        Report(motions_[i], PLAYED, NO_JOINT);
      }
    }
  }
}

PlayedMotion* MotionPlayer::FindFree() {
  for (int i = 0; i < MAX_PLAYING; ++i) {
    if (!motions_[i].IsPlaying()) {
      return &motions_[i];
    }
  }
  return NULL;
}

// False if another motion moves one of the joints; problem_ names it.
bool MotionPlayer::FindsJointsFree(const PlayedMotion& motion) {
  for (int i = 0; i < MAX_PLAYING; ++i) {
    int joint = NO_JOINT;
    if (motions_[i].IsPlaying() && motions_[i].SharesJoint(motion, &joint)) {
      sprintf(problem_, "%s is being played and moves %s, too; stop it first", motions_[i].Name(),
              robot_.joints[joint].name);
      return false;
    }
  }
  return true;
}

bool MotionPlayer::FindsJointsUncommanded(const PlayedMotion& motion, const bool* commanded) {
  for (int i = 0; i < robot_.number_of_joints; ++i) {
    if (commanded[i] && motion.Moves(i)) {
      sprintf(problem_, "%s was commanded while the file of %s was being read; that command counts",
              robot_.joints[i].name, motion.Name());
      return false;
    }
  }
  return true;
}

// The motion that moves a joint: there is one at most. MAX_PLAYING if there is none.
int MotionPlayer::FindMoving(int joint) const {
  int i = 0;
  while (i < MAX_PLAYING && !(motions_[i].IsPlaying() && motions_[i].Moves(joint))) {
    ++i;
  }
  return i;
}

void MotionPlayer::Stop(PlayedMotion& motion, Cause cause, int joint) {
  motion.Stop(planner_);
  Report(motion, cause, joint);
}

void MotionPlayer::Report(const PlayedMotion& motion, Cause cause, int joint) {
  End oldest;
  if (number_of_ends_ == MAX_ENDS) {
    TakeEnd(&oldest);
  }
  End& end = ends_[number_of_ends_];
  ++number_of_ends_;
  strcpy(end.name, motion.Name());
  end.cause = cause;
  end.joint = joint;
}
