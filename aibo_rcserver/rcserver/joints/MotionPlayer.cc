#include "rcserver/joints/MotionPlayer.h"

#include <stdio.h>
#include <string.h>

using namespace protocol::version2;
using robot_model::NO_JOINT;

namespace {

const EndReason DONE = {END_DONE, "", ""};
const EndReason STOPPED_BY_CLIENT = {END_STOPPED, "the client stopped it", ""};

}  // namespace

const int MotionPlayer::MAX_PLAYING;
const size_t MotionPlayer::MAX_PROBLEM_SIZE;

MotionPlayer::MotionPlayer(JointPlanner& planner, const robot_model::RobotModel& robot, OrderBook& orders)
    : planner_(planner), robot_(robot), orders_(orders) {
  problem_[0] = '\0';
  changes_[0] = '\0';
}

unsigned char* MotionPlayer::FindRoom() {
  PlayedMotion* const motion = FindFree();
  return motion != NULL ? motion->Room() : NULL;
}

const char* MotionPlayer::Play(const protocol::MotionName& name, size_t size, int repetitions, bool leave_out,
                               const bool* commanded, unsigned short number) {
  PlayedMotion& motion = *FindFree();
  if (!motion.Load(name, size, robot_, leave_out)) {
    sprintf(problem_, "%s %s", name, motion.Problem());
    return problem_;
  }
  if (!FindsJointsFree(motion) || !FindsJointsUncommanded(motion, commanded)) {
    return problem_;
  }
  motion.DescribeChanges(planner_, changes_);
  motion.Start(repetitions, orders_.Begin(ENDED_MOTION, number, name));
  return NULL;
}

void MotionPlayer::Stop(const protocol::MotionName& name) {
  for (int i = 0; i < MAX_PLAYING; ++i) {
    if (motions_[i].IsPlaying() && (name[0] == '\0' || strcmp(motions_[i].Name(), name) == 0)) {
      Stop(motions_[i], STOPPED_BY_CLIENT);
    }
  }
}

void MotionPlayer::StopAll(const EndReason& reason) {
  for (int i = 0; i < MAX_PLAYING; ++i) {
    if (motions_[i].IsPlaying()) {
      Stop(motions_[i], reason);
    }
  }
}

void MotionPlayer::StopMotionOf(int joint, const EndReason& reason) {
  if (Moves(joint)) {
    Stop(motions_[FindMoving(joint)], reason);
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

void MotionPlayer::NextFrame() {
  for (int i = 0; i < MAX_PLAYING; ++i) {
    if (motions_[i].IsPlaying()) {
      motions_[i].NextFrame(planner_);
      if (!motions_[i].IsPlaying()) {
        orders_.End(motions_[i].Order(), DONE);
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

// Returns false if another motion moves one of the joints, and describes this in problem_.
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
      sprintf(problem_, "%s was commanded while the file of %s was being read; that command takes precedence",
              robot_.joints[i].name, motion.Name());
      return false;
    }
  }
  return true;
}

// The motion that moves this joint, or MAX_PLAYING if there is none. Two motions never share a joint.
int MotionPlayer::FindMoving(int joint) const {
  int i = 0;
  while (i < MAX_PLAYING && !(motions_[i].IsPlaying() && motions_[i].Moves(joint))) {
    ++i;
  }
  return i;
}

void MotionPlayer::Stop(PlayedMotion& motion, const EndReason& reason) {
  motion.Stop(planner_);
  orders_.End(motion.Order(), reason);
}
