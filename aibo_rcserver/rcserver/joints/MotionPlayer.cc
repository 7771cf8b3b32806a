#include "rcserver/joints/MotionPlayer.h"

#include <stdio.h>
#include <string.h>

using robot_model::NO_JOINT;

const int MotionPlayer::MAX_PLAYING;
const size_t MotionPlayer::MAX_PROBLEM_SIZE;

MotionPlayer::MotionPlayer(MotionPlanner& planner, const robot_model::RobotModel& robot)
    : planner_(planner), robot_(robot) {
  problem_[0] = '\0';
  changes_[0] = '\0';
  ClientGone();
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
      motions_[i].Stop(planner_);
    }
  }
}

void MotionPlayer::StopAll() {
  for (int i = 0; i < MAX_PLAYING; ++i) {
    if (motions_[i].IsPlaying()) {
      motions_[i].Stop(planner_);
    }
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

void MotionPlayer::JointIsCommanded(int joint) {
  if (PlayedMotion* const motion = FindMoving(joint)) {
    motion->Stop(planner_);
  }
}

void MotionPlayer::JointFails(int joint) {
  if (PlayedMotion* const motion = FindMoving(joint)) {
    motion->Stop(planner_);
    Failure& failure = failures_[motion - motions_];
    strcpy(failure.name, motion->Name());
    failure.joint = joint;
  }
}

bool MotionPlayer::TakeFailure(Failure* failure) {
  for (int i = 0; i < MAX_PLAYING; ++i) {
    if (failures_[i].joint != NO_JOINT) {
      *failure = failures_[i];
      failures_[i].joint = NO_JOINT;
      return true;
    }
  }
  return false;
}

void MotionPlayer::ClientGone() {
  StopAll();
  for (int i = 0; i < MAX_PLAYING; ++i) {
    failures_[i].name[0] = '\0';
    failures_[i].joint = NO_JOINT;
  }
}

void MotionPlayer::NextFrame() {
  for (int i = 0; i < MAX_PLAYING; ++i) {
    if (motions_[i].IsPlaying()) {
      motions_[i].NextFrame(planner_);
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

// The motion that moves a joint: there is one at most.
PlayedMotion* MotionPlayer::FindMoving(int joint) {
  for (int i = 0; i < MAX_PLAYING; ++i) {
    if (motions_[i].IsPlaying() && motions_[i].Moves(joint)) {
      return &motions_[i];
    }
  }
  return NULL;
}
