#include "rcserver/walk/Walker.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <algorithm>

using protocol::version2::Posture;
using protocol::version2::POSTURE_REST;
using protocol::version2::POSTURE_SIT;
using protocol::version2::POSTURE_STAND;
using robot_model::JOINTS_OF_A_LEG;
using robot_model::Leg;
using robot_model::LegAngles;
using robot_model::NO_JOINT;
using robot_model::NUMBER_OF_LEGS;

namespace {

const double FRAME = MotionPlanner::FRAME_MILLISECONDS * 1e-3;  // s
const int LEG_JOINTS = NUMBER_OF_LEGS * JOINTS_OF_A_LEG;

const double MICRO = 1e-6;

// Velocities change by this many times the highest ones in a second.
const double SLEW = 2;

// Frames until joints have followed their commands: these are up to 8 frames ahead, and servos lag by some. Our choice.
const unsigned FRAMES_TO_FOLLOW = 25;

// Frames after which a robot that lies on its side goes soft: 1 s.
const unsigned FRAMES_TO_SOFTEN = 125;

const WalkVelocity NO_VELOCITY = {0, 0, 0};

double Towards(double value, double target, double step) {
  return value + std::min(std::max(target - value, -step), step);
}

int Microradians(double angle) {
  return static_cast<int>(floor(angle / MICRO + 0.5));
}

}  // namespace

const int Walker::POSTURE_SPEED;
const int Walker::STEERING_FRAMES;
const int Walker::MAX_TEXT_SIZE;

Walker::Walker(MotionPlanner& planner, const robot_model::RobotModel& robot)
    : planner_(planner),
      robot_(robot),
      postures_(gait_),
      walked_(gait_),
      can_walk_(FindJoints()),
      activity_(IDLE),
      has_legs_(false),
      is_resting_(false),
      has_rested_(false),
      goes_soft_(false),
      has_softened_(false),
      is_orphan_(false),
      measured_(0),
      rests_since_(0),
      must_let_go_(false),
      last_asked_(0),
      is_walk_(false),
      posture_(POSTURE_STAND),
      way_size_(0),
      way_begun_(0),
      ends_(false),
      cause_(DONE),
      cause_joint_(NO_JOINT),
      has_next_(false),
      next_(POSTURE_STAND),
      wanted_(NO_VELOCITY),
      velocity_(NO_VELOCITY),
      effort_(0),
      phase_(0),
      frames_since_steered_(0) {
  problem_[0] = '\0';
  why_[0] = '\0';
  static const char* const HEAD[LEVELLED] = {"neck_tilt", "head_pan", "head_tilt"};
  for (int i = 0; i < LEVELLED; ++i) {
    head_[i] = findJointByName(robot_, HEAD[i]);
    levels_[i] = false;
  }
}

// False if it has no legs of an ERS-7.
bool Walker::FindJoints() {
  for (int i = 0; i < LEG_JOINTS; ++i) {
    const int number = i % JOINTS_OF_A_LEG;
    const Leg leg = static_cast<Leg>(i / JOINTS_OF_A_LEG);
    joints_[leg][number] = findJointByIdentifier(robot_, legJointIdentifier(leg, number));
    if (joints_[leg][number] == NO_JOINT) {
      return false;
    }
  }
  return strcmp(robot_.design, "ERS-7") == 0;
}

const char* Walker::Problem() {
  const char* const fall = FallWatch::Words(fall_watch_.Now());
  if (fall == NULL) {
    return NULL;
  }
  sprintf(problem_, "%s; set it down on its belly or its feet first", fall);
  return problem_;
}

const char* Walker::ProblemOfWalk(bool motors_are_on) {
  const bool had_to_let_go = must_let_go_ && measured_ - last_asked_ < static_cast<unsigned>(STEERING_FRAMES);
  last_asked_ = measured_;
  must_let_go_ = true;
  if (const char* fall = FallWatch::Words(fall_watch_.Now())) {
    strcpy(why_, fall);
    return Problem();
  }
  if (!motors_are_on) {
    strcpy(why_, "the motors were off");
    return "the motors are off; switch them on first";
  }
  must_let_go_ = had_to_let_go;
  if (!must_let_go_) {
    return NULL;
  }
  sprintf(problem_, "%.80s: let go first; it walks after zeros, or nothing for %u ms", why_,
          protocol::version2::STEERING_TIMEOUT_MS);
  return problem_;
}

WalkVelocity Walker::Steer(const WalkVelocity& wanted) {
  if (IsZero(wanted)) {
    must_let_go_ = false;
    EndWalkInStand(DONE, NO_JOINT);
    return NO_VELOCITY;
  }
  last_asked_ = measured_;
  for (int i = 0; i < LEG_JOINTS; ++i) {
    const int joint = joints_[i / JOINTS_OF_A_LEG][i % JOINTS_OF_A_LEG];
    planner_.SetSpeedLimit(joint, robot_.joints[joint].highest_speed);
  }
  if (!IsWalk()) {
    std::fill(levels_, levels_ + LEVELLED, false);
    Begin(true, POSTURE_STAND);
  }
  ReplaceNext(WALK_BEGAN);
  ends_ = false;
  frames_since_steered_ = 0;
  wanted_ = gait_.Limited(wanted);
  return wanted_;
}

void Walker::Take(Posture posture) {
  std::fill(levels_, levels_ + LEVELLED, posture == POSTURE_REST);
  if (activity_ != WALKING) {
    Begin(false, posture);
    return;
  }
  ReplaceNext(POSTURE_BEGAN);
  EndWalkInStand(POSTURE_BEGAN, NO_JOINT);
  has_next_ = true;
  next_ = posture;
}

void Walker::Stop(Cause cause, int joint) {
  has_legs_ = has_legs_ && cause == FELL;
  if (cause == MOTORS_OFF && goes_soft_) {
    has_softened_ = true;
  }
  goes_soft_ = goes_soft_ && has_legs_;
  if (!IsActive()) {
    return;
  }
  const bool has_rested = cause == MOTORS_OFF && has_rested_;
  ReplaceNext(cause);
  for (int i = 0; i < LEG_JOINTS; ++i) {
    planner_.Hold(joints_[i / JOINTS_OF_A_LEG][i % JOINTS_OF_A_LEG]);
  }
  Finish(has_rested ? DONE : cause, joint);
}

void Walker::ClientGone() {
  const bool rests =
      activity_ == WALKING ? has_next_ && next_ == POSTURE_REST : IsActive() && !is_walk_ && posture_ == POSTURE_REST;
  if (activity_ == WALKING) {
    if (!rests) {
      ReplaceNext(CLIENT_GONE);
    }
    ends_ = true;
    cause_ = CLIENT_GONE;
  } else if (!rests) {
    Stop(CLIENT_GONE, NO_JOINT);
  }
  is_orphan_ = rests;
  has_softened_ = false;
  must_let_go_ = false;
  for_client_.Clear();
}

bool Walker::Moves(int joint) const {
  for (int i = 0; can_walk_ && i < LEG_JOINTS; ++i) {
    if (joints_[i / JOINTS_OF_A_LEG][i % JOINTS_OF_A_LEG] == joint) {
      return true;
    }
  }
  return false;
}

bool Walker::IsOfHead(int joint) const {
  return std::find(head_, head_ + LEVELLED, joint) != head_ + LEVELLED;
}

bool Walker::Levels(int joint) const {
  for (int i = 0; i < LEVELLED; ++i) {
    if (head_[i] == joint && levels_[i]) {
      return true;
    }
  }
  return false;
}

void Walker::LeaveAlone(int joint) {
  for (int i = 0; i < LEVELLED; ++i) {
    levels_[i] = levels_[i] && head_[i] != joint;
  }
}

void Walker::NextFrame() {
  if (!IsMoving()) {
    return;
  }
  if (is_walk_ && ++frames_since_steered_ >= STEERING_FRAMES) {
    EndWalkInStand(NOT_STEERED, NO_JOINT);
  }
  if (activity_ == TAKING_POSTURE && HaveArrived()) {
    TakeNextPosture();
  }
  if (activity_ == WALKING) {
    const int slow = FindSlowJoint();
    if (slow != NO_JOINT) {
      EndWalkInStand(JOINT_SLOW, slow);
    }
    Walk();
  }
}

void Walker::HaveMoved() {
  if (!can_walk_) {
    return;
  }
  LegAngles legs[NUMBER_OF_LEGS];
  FindLegs(legs);
  if (activity_ == WALKING) {
    walked_.HaveWalked(legs, phase_);
  } else {
    walked_.HaveMoved(legs);
  }
}

void Walker::Measured(FallWatch::Reading reading, unsigned frame) {
  measured_ = frame;
  if (!can_walk_) {
    return;
  }
  LegAngles legs[NUMBER_OF_LEGS];
  FindLegs(legs);
  fall_watch_.Look(reading, postures_.Stands(legs), frame);
  const FallWatch::Verdict fall = fall_watch_.Now();
  if (fall != FallWatch::UPRIGHT) {
    Stop(FELL, NO_JOINT);
  }
  const bool lies = fall == FallWatch::ON_ITS_SIDE || fall == FallWatch::UPSIDE_DOWN;
  goes_soft_ = has_legs_ && lies && fall_watch_.Duration(frame) >= FRAMES_TO_SOFTEN;
  rests_since_ = is_resting_ ? rests_since_ : frame;
  has_rested_ = is_resting_ && frame - rests_since_ >= FRAMES_TO_FOLLOW;
}

bool Walker::TakeSoftened() {
  const bool has_softened = has_softened_;
  has_softened_ = false;
  return has_softened;
}

void Walker::Describe(const End& end, char* text) const {
  const char* const joint = end.joint == NO_JOINT ? "" : robot_.joints[end.joint].name;
  text[0] = '\0';
  switch (end.cause) {
    case DONE:
      break;
    case NOT_STEERED:
      sprintf(text, "it was not steered for %u ms", protocol::version2::STEERING_TIMEOUT_MS);
      break;
    case JOINT_COMMANDED:
      sprintf(text, "%s was commanded", joint);
      break;
    case JOINT_HELD:
      sprintf(text, "%s was told to hold", joint);
      break;
    case EVERYTHING_HELD:
      strcpy(text, "everything was told to hold");
      break;
    case MOTORS_OFF:
      strcpy(text, "the motors were switched off");
      break;
    case MOTION_BEGAN:
      sprintf(text, "a motion moves %s", joint);
      break;
    case POSTURE_BEGAN:
      strcpy(text, "the robot was told to take a posture");
      break;
    case WALK_BEGAN:
      strcpy(text, "the robot was told to walk");
      break;
    case JOINT_FAILED:
      sprintf(text, "%s does not follow", joint);
      break;
    case JOINT_SLOW:
      sprintf(text, "the speed limit of %s is too low for walking", joint);
      break;
    case FELL:
      strcpy(text, FallWatch::Words(end.fall));
      break;
    case CLIENT_GONE:
      strcpy(text, "the client is gone");
      break;
  }
}

protocol::version2::PostureNow Walker::Now(const int* positions) const {
  using namespace protocol::version2;
  switch (fall_watch_.Now()) {
    case FallWatch::ON_ITS_SIDE:
    case FallWatch::UPSIDE_DOWN:
      return POSTURE_NOW_FALLEN;
    case FallWatch::CARRIED:
      return POSTURE_NOW_CARRIED;
    case FallWatch::UPRIGHT:
      break;
  }
  if (activity_ == WALKING || !can_walk_) {
    return can_walk_ ? POSTURE_NOW_WALKING : POSTURE_NOW_UNKNOWN;
  }
  LegAngles legs[NUMBER_OF_LEGS];
  for (int i = 0; i < NUMBER_OF_LEGS; ++i) {
    legs[i].rotator = positions[joints_[i][0]] * MICRO;
    legs[i].elevator = positions[joints_[i][1]] * MICRO;
    legs[i].knee = positions[joints_[i][2]] * MICRO;
  }
  if (postures_.Stands(legs)) {
    return POSTURE_NOW_STANDING;
  }
  if (postures_.Is(POSTURE_SIT, legs)) {
    return POSTURE_NOW_SITTING;
  }
  return postures_.Is(POSTURE_REST, legs) ? POSTURE_NOW_LYING : POSTURE_NOW_UNKNOWN;
}

protocol::version2::WalkState Walker::State() const {
  if (!IsWalk()) {
    return protocol::version2::WALK_STATE_NONE;
  }
  return activity_ == WALKING ? protocol::version2::WALK_STATE_WALKS : protocol::version2::WALK_STATE_GETS_READY;
}

// The gait comes close to the highest speeds of the joints.
int Walker::FindSlowJoint() const {
  for (int i = 0; i < LEG_JOINTS; ++i) {
    const int joint = joints_[i / JOINTS_OF_A_LEG][i % JOINTS_OF_A_LEG];
    if (planner_.SpeedLimit(joint) < robot_.joints[joint].highest_speed) {
      return joint;
    }
  }
  return NO_JOINT;
}

// Where the planner has the legs.
void Walker::FindLegs(LegAngles* legs) const {
  for (int i = 0; i < NUMBER_OF_LEGS; ++i) {
    legs[i].rotator = planner_.Position(joints_[i][0]) * MICRO;
    legs[i].elevator = planner_.Position(joints_[i][1]) * MICRO;
    legs[i].knee = planner_.Position(joints_[i][2]) * MICRO;
  }
}

void Walker::Begin(bool is_walk, Posture posture) {
  if (IsActive()) {
    Finish(is_walk ? WALK_BEGAN : POSTURE_BEGAN, NO_JOINT);
  }
  LegAngles legs[NUMBER_OF_LEGS];
  FindLegs(legs);
  walked_.Begin(legs);
  activity_ = TAKING_POSTURE;
  has_legs_ = true;
  is_orphan_ = false;
  has_softened_ = false;
  is_walk_ = is_walk;
  posture_ = posture;
  way_size_ = postures_.FindWay(legs, posture, way_);
  way_begun_ = 0;
  ends_ = false;
  velocity_ = NO_VELOCITY;
  effort_ = 0;
  phase_ = 0;
  frames_since_steered_ = 0;
  TakeNextPosture();
}

// Begins the next posture of the way, or what comes after the last one.
void Walker::TakeNextPosture() {
  if (way_begun_ == way_size_) {
    if (is_walk_ && !ends_) {
      activity_ = WALKING;
    } else if (!is_walk_ && posture_ == POSTURE_REST) {
      is_resting_ = true;
    } else {
      Finish(is_walk_ ? cause_ : DONE, is_walk_ ? cause_joint_ : NO_JOINT);
    }
    return;
  }
  const Posture next = way_[way_begun_++];
  const LegAngles* const legs = postures_.Legs(next);
  MotionPlanner::JointTarget targets[LEG_JOINTS];
  int farthest = 0;
  for (int i = 0; i < LEG_JOINTS; ++i) {
    const LegAngles& leg = legs[i / JOINTS_OF_A_LEG];
    const int number = i % JOINTS_OF_A_LEG;
    targets[i].joint = joints_[i / JOINTS_OF_A_LEG][number];
    targets[i].position = Microradians(number == 0 ? leg.rotator : number == 1 ? leg.elevator : leg.knee);
    farthest = std::max(farthest, abs(targets[i].position - planner_.Position(targets[i].joint)));
  }
  const int milliseconds = static_cast<int>(static_cast<double>(farthest) / POSTURE_SPEED * 1000);
  planner_.SetTargets(targets, LEG_JOINTS, milliseconds);
  if (!is_walk_ && posture_ == POSTURE_REST && next == POSTURE_REST) {
    LevelHead(milliseconds);
  }
}

bool Walker::HaveArrived() const {
  for (int i = 0; i < LEG_JOINTS; ++i) {
    if (planner_.FramesLeft(joints_[i / JOINTS_OF_A_LEG][i % JOINTS_OF_A_LEG]) > 0) {
      return false;
    }
  }
  return true;
}

// A head that hangs down would hit the floor.
void Walker::LevelHead(int milliseconds) {
  MotionPlanner::JointTarget targets[LEVELLED];
  int count = 0;
  for (int i = 0; i < LEVELLED; ++i) {
    if (levels_[i]) {
      targets[count].joint = head_[i];
      targets[count].position = i == 0 ? -174533 : 0;  // the neck 10 degrees forward
      ++count;
    }
  }
  planner_.SetTargets(targets, count, milliseconds);
}

// The first cause counts.
void Walker::EndWalkInStand(Cause cause, int joint) {
  if (IsWalk() && !ends_) {
    ends_ = true;
    cause_ = cause;
    cause_joint_ = joint;
    MustLetGo(cause, joint);
  }
}

// Unless the client itself has ended the walk.
void Walker::MustLetGo(Cause cause, int joint) {
  if (cause != DONE && cause != NOT_STEERED && cause != CLIENT_GONE) {
    const End end = {true, posture_, cause, joint, fall_watch_.Now()};
    Describe(end, why_);
    must_let_go_ = true;
  }
}

void Walker::Walk() {
  ChangeVelocity();
  const bool stops = ends_ && IsZero(velocity_);
  if (stops && effort_ == 0) {
    StandsAfterWalk();
    return;
  }
  const GaitParameters& parameters = gait_.Parameters();
  effort_ = Towards(effort_, stops ? 0 : 1, FRAME / (parameters.period / 2));
  phase_ += FRAME / parameters.period;
  phase_ -= floor(phase_);
  SetFeet();
}

void Walker::ChangeVelocity() {
  const GaitParameters& parameters = gait_.Parameters();
  const WalkVelocity target = ends_ ? NO_VELOCITY : wanted_;
  const bool is_back = velocity_.forward < 0 || (velocity_.forward == 0 && target.forward < 0);
  const double highest = is_back ? parameters.highest_back : parameters.highest_forward;
  velocity_.forward = Towards(velocity_.forward, target.forward, SLEW * highest * FRAME);
  velocity_.left = Towards(velocity_.left, target.left, SLEW * parameters.highest_left * FRAME);
  velocity_.turn = Towards(velocity_.turn, target.turn, SLEW * parameters.highest_turn * FRAME);
  velocity_ = gait_.Limited(velocity_);
}

void Walker::SetFeet() {
  LegAngles legs[NUMBER_OF_LEGS];
  gait_.FindPosture(phase_, velocity_, effort_, legs);
  MotionPlanner::JointTarget targets[LEG_JOINTS];
  for (int i = 0; i < NUMBER_OF_LEGS; ++i) {
    const double angles[JOINTS_OF_A_LEG] = {legs[i].rotator, legs[i].elevator, legs[i].knee};
    for (int number = 0; number < JOINTS_OF_A_LEG; ++number) {
      MotionPlanner::JointTarget& target = targets[i * JOINTS_OF_A_LEG + number];
      target.joint = joints_[i][number];
      target.position = Microradians(angles[number]);
    }
  }
  planner_.Follow(targets, LEG_JOINTS);
}

void Walker::StandsAfterWalk() {
  const bool has_next = has_next_;
  const bool is_orphan = is_orphan_;
  has_next_ = false;
  Finish(cause_, cause_joint_);
  if (has_next) {
    Begin(false, next_);
    is_orphan_ = is_orphan;
  }
}

// The posture that should have followed the walk will not.
void Walker::ReplaceNext(Cause cause) {
  if (has_next_) {
    has_next_ = false;
    Report(false, next_, cause, NO_JOINT);
  }
}

void Walker::Finish(Cause cause, int joint) {
  activity_ = IDLE;
  is_resting_ = false;
  has_rested_ = false;
  if (is_walk_) {
    MustLetGo(cause, joint);
  }
  Report(is_walk_, posture_, cause, joint);
}

void Walker::Report(bool is_walk, Posture posture, Cause cause, int joint) {
  const End end = {is_walk, posture, cause, joint, fall_watch_.Now()};
  for_console_.Add(end);
  if (cause != CLIENT_GONE && !is_orphan_) {
    for_client_.Add(end);
  }
}

void Walker::Ends::Add(const End& end) {
  End oldest;
  if (count_ == MAX_ENDS) {
    Take(&oldest);
  }
  ends_[count_] = end;
  ++count_;
}

bool Walker::Ends::Take(End* end) {
  if (count_ == 0) {
    return false;
  }
  *end = ends_[0];
  --count_;
  memmove(ends_, ends_ + 1, static_cast<size_t>(count_) * sizeof(End));
  return true;
}
