#include "rcserver/joints/Walker.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <algorithm>

using protocol::version2::END_DONE;
using protocol::version2::END_FELL;
using protocol::version2::END_REFUSED;
using protocol::version2::END_REPLACED;
using protocol::version2::END_STOPPED;
using protocol::version2::ENDED_POSTURE;
using protocol::version2::ENDED_WALK;
using protocol::version2::Posture;
using protocol::version2::POSTURE_REST;
using protocol::version2::POSTURE_SIT;
using protocol::version2::POSTURE_STAND;
using protocol::version2::POSTURE_WALK;
using protocol::version2::Velocity;
using protocol::version2::WALK_NAME;
using robot_model::JOINTS_OF_A_LEG;
using robot_model::Leg;
using robot_model::LegAngles;
using robot_model::NO_JOINT;
using robot_model::NUMBER_OF_LEGS;

namespace {

const double FRAME = robot_model::FRAME_MILLISECONDS * 1e-3;  // s
const int LEG_JOINTS = NUMBER_OF_LEGS * JOINTS_OF_A_LEG;

const double MICRO = 1e-6;

// Frames until joints have followed their commands. Commands are up to 8 frames ahead, and servos lag. Our choice.
const unsigned FRAMES_TO_FOLLOW = 25;

// Frames after which the motors of a robot on its side go off: 1 s.
const unsigned FRAMES_TO_SOFTEN = 125;

// Frames until a robot that has rolled over lies still: the joints follow, and the body settles. Our choice.
const int FRAMES_TO_SETTLE = 45;

// How fast the correction of the velocity grows with what is missing, in 1/s, and the time in s over which that is
// smoothed. Our choice: a lasting error of the legs is made up for in a step, and the swaying of a step has little
// effect.
const double CORRECTION_RATE = 3;
const double SMOOTHING = 0.25;

// Largest correction, as a share of the highest velocity. Our choice.
const double CORRECTION_LIMIT = 0.3;

// s; from the planned to the measured motion of the legs: commands wait for up to 8 frames, and servos lag by 3.
const double DELAY = 0.09;

// The feet go to the side to which the robot leans more than it should: by this many metres for each radian, within
// this time in s, and at most this far. Found with the bench: the robot rocks the least.
const double BALANCE = 0.24;
const double BALANCE_TIME = 0.8;
const double BALANCE_LIMIT = 0.015;

// m; where the feet have gone farther, the ground slopes by 3 degrees or more, and a robot that walks too fast to trot
// may fall.
const double STEEP = 0.0125;

const double GRAVITY = 9.81;  // m/s^2

const Velocity NO_VELOCITY = {0, 0, 0};

const EndReason DONE = {END_DONE, "", ""};
const EndReason POSTURE_BEGAN = {END_REPLACED, "the robot was told to take a posture", ""};
const EndReason WALK_BEGAN = {END_REPLACED, "the robot was told to walk", ""};
const EndReason NOT_STEERED = {END_STOPPED, "it was not steered for 500 ms", ""};  // STEERING_TIMEOUT_MS
const EndReason CLIENT_GONE = {END_STOPPED, "the client is gone", ""};

double Towards(double value, double target, double step) {
  return value + std::min(std::max(target - value, -step), step);
}

// A value that follows another one within this time.
double Following(double value, double target, double time, double seconds) {
  return value + (target - value) * seconds / (time + seconds);
}

double Corrected(double correction, double missing, double highest) {
  const double limit = CORRECTION_LIMIT * highest;
  return std::min(std::max(correction + CORRECTION_RATE * missing * FRAME, -limit), limit);
}

double Balanced(double shift, double lean) {
  const double next = Following(shift, BALANCE * lean, BALANCE_TIME, FRAME);
  return std::min(std::max(next, -BALANCE_LIMIT), BALANCE_LIMIT);
}

double AngleOf(const LegAngles& leg, int number) {
  return number == 0 ? leg.rotator : number == 1 ? leg.elevator : leg.knee;
}

Velocity Following(const Velocity& value, const Velocity& target, double time, double seconds) {
  const Velocity result = {Following(value.forward, target.forward, time, seconds),
                           Following(value.left, target.left, time, seconds),
                           Following(value.turn, target.turn, time, seconds)};
  return result;
}

Velocity Towards(const Velocity& value, const Velocity& target, const Velocity& step) {
  const Velocity result = {Towards(value.forward, target.forward, step.forward),
                           Towards(value.left, target.left, step.left), Towards(value.turn, target.turn, step.turn)};
  return result;
}

int Microradians(double angle) {
  return static_cast<int>(floor(angle / MICRO + 0.5));
}

}  // namespace

const int Walker::POSTURE_SPEED;
const int Walker::UNLOADED_SPEED;
const int Walker::ATTEMPTS;
const int Walker::STEERING_FRAMES;

Walker::Walker(MotionPlanner& planner, const robot_model::RobotModel& robot, OrderBook& orders)
    : planner_(planner),
      robot_(robot),
      postures_(gait_),
      guard_(gait_),
      orders_(orders),
      can_walk_(FindJoints()),
      activity_(IDLE),
      has_legs_(false),
      is_resting_(false),
      has_rested_(false),
      goes_soft_(false),
      has_softened_(false),
      measured_(0),
      rests_since_(0),
      order_(OrderBook::NO_ORDER),
      is_walk_(false),
      posture_(POSTURE_STAND),
      way_size_(0),
      way_begun_(0),
      gets_up_(false),
      rolls_(false),
      attempts_(0),
      plans_again_(false),
      frames_to_settle_(0),
      is_guarded_(false),
      ends_(false),
      end_reason_(DONE),
      has_next_(false),
      next_(POSTURE_STAND),
      wanted_(NO_VELOCITY),
      pace_(),
      frames_since_steered_(0) {
  problem_[0] = '\0';
  static const char* const HEAD[LEVELLED] = {"neck_tilt", "head_pan", "head_tilt"};
  for (int i = 0; i < LEVELLED; ++i) {
    head_[i] = findJointByName(robot_, HEAD[i]);
    levels_[i] = false;
  }
}

// False if the robot does not have the legs of an ERS-7.
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

const char* Walker::Problem(Posture posture) {
  const FallWatch::Verdict fall = fall_watch_.Now();
  const bool has_fallen = FallWatch::IsFallen(fall);
  if (fall == FallWatch::UPRIGHT || (has_fallen && posture == POSTURE_STAND)) {
    return NULL;
  }
  sprintf(problem_, "%s; %s", FallWatch::Words(fall),
          has_fallen ? "let it stand up first" : "set it down on its belly or its feet first");
  return problem_;
}

const char* Walker::ProblemOfWalk(bool motors_are_on, const Velocity* guarded) {
  if (const char* fall = FallWatch::Words(fall_watch_.Now())) {
    orders_.DemandLettingGo(EndReason::Of(END_FELL, fall));
    return Problem(POSTURE_WALK);
  }
  if (!motors_are_on) {
    orders_.DemandLettingGo(EndReason::Of(END_STOPPED, "the motors were off"));
    return "the motors are off; switch them on first";
  }
  if (const char* why = orders_.WhyToLetGo()) {
    sprintf(problem_, "%.100s; let go first: send zero velocities", why);
    return problem_;
  }
  const char* const objection = guarded != NULL && activity_ == IDLE ? guard_.Objection(*guarded) : NULL;
  if (objection != NULL) {
    orders_.DemandLettingGo(EndReason::Of(END_REFUSED, objection));
  }
  return objection;
}

Velocity Walker::Steer(const Velocity& wanted, bool guarded, unsigned short number) {
  if (wanted.isZero()) {
    orders_.LetGo();
    EndWalkInStand(DONE);
    return NO_VELOCITY;
  }
  for (int i = 0; i < LEG_JOINTS; ++i) {
    const int joint = joints_[i / JOINTS_OF_A_LEG][i % JOINTS_OF_A_LEG];
    planner_.SetSpeedLimit(joint, robot_.joints[joint].highest_speed);
  }
  std::fill(levels_, levels_ + LEVELLED, false);
  if (!IsWalk() || ends_) {
    ReplaceOrder(WALK_BEGAN, ENDED_WALK, number, WALK_NAME);
  }
  if (!IsWalk()) {
    Begin(true, POSTURE_STAND);
  }
  has_next_ = false;
  ends_ = false;
  frames_since_steered_ = 0;
  if (!guarded) {  // meanwhile it does not look
    guard_.Forget();
  }
  is_guarded_ = guarded;
  Velocity asked = wanted;
  if (guarded) {  // faster, it could not stop before what it sees
    asked.forward = std::min(asked.forward, gait_.Parameters().highest.forward);
  }
  wanted_ = gait_.Limited(asked);
  return wanted_;
}

void Walker::Take(Posture posture, unsigned short number) {
  std::fill(levels_, levels_ + LEVELLED, NeedsLevelHead(posture));
  ReplaceOrder(POSTURE_BEGAN, ENDED_POSTURE, number, postureName(posture));
  if (activity_ != WALKING) {
    Begin(false, posture);
    return;
  }
  ends_ = true;
  has_next_ = true;
  next_ = posture;
}

void Walker::Stop(const EndReason& reason) {
  has_legs_ = false;
  goes_soft_ = false;
  Brake(reason);
}

void Walker::MotorsGoOff(const EndReason& reason) {
  has_softened_ = has_softened_ || goes_soft_;
  Stop(has_rested_ ? DONE : reason);
}

void Walker::Brake(const EndReason& reason) {
  if (!IsActive()) {
    return;
  }
  for (int i = 0; i < LEG_JOINTS; ++i) {
    planner_.Hold(joints_[i / JOINTS_OF_A_LEG][i % JOINTS_OF_A_LEG]);
  }
  Finish(reason);
}

void Walker::ClientGone() {
  const bool rests =
      activity_ == WALKING ? has_next_ && next_ == POSTURE_REST : IsActive() && !is_walk_ && posture_ == POSTURE_REST;
  if (activity_ != WALKING && !rests) {
    Stop(CLIENT_GONE);
  } else if (activity_ == WALKING && has_next_ && !rests) {
    has_next_ = false;
    orders_.End(order_, CLIENT_GONE);
    order_ = OrderBook::NO_ORDER;
  } else if (activity_ == WALKING && !has_next_) {
    ends_ = true;
    end_reason_ = CLIENT_GONE;
  }
  has_softened_ = false;
}

bool Walker::Moves(int joint) const {
  for (int i = 0; can_walk_ && i < LEG_JOINTS; ++i) {
    if (joints_[i / JOINTS_OF_A_LEG][i % JOINTS_OF_A_LEG] == joint) {
      return true;
    }
  }
  return false;
}

bool Walker::NeedsLevelHead(Posture posture) const {
  return posture == POSTURE_REST || HasFallen();
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
    EndWalkInStand(NOT_STEERED);
  }
  if (activity_ == TAKING_POSTURE && plans_again_) {
    PlanWay(true);
    BeginNextStage();
  } else if (activity_ == TAKING_POSTURE && HaveArrived()) {
    BeginNextStage();
  }
  if (activity_ == WALKING) {
    const int slow = FindSlowJoint();
    if (slow != NO_JOINT) {
      const EndReason reason = {END_REFUSED, "the speed limit of %s is too low for walking", robot_.joints[slow].name};
      if (!ends_) {
        orders_.DemandLettingGo(reason);
      }
      EndWalkInStand(reason);
    }
    Walk();
  }
}

void Walker::Measured(const FallWatch::Reading& reading, const int* positions, unsigned frame) {
  measured_ = frame;
  if (!can_walk_) {
    return;
  }
  LegAngles legs[NUMBER_OF_LEGS];
  FindLegs(positions, legs);
  fall_watch_.Look(reading, postures_.Stands(legs), frame);
  const FallWatch::Verdict fall = fall_watch_.Now();
  const bool lies = FallWatch::IsFallen(fall);
  if (gets_up_ && lies && attempts_ < ATTEMPTS) {
    plans_again_ = plans_again_ || (!rolls_ && FallWatch::IsFallen(fall_watch_.Last()));
  } else if (gets_up_ && lies && (rolls_ || !FallWatch::IsFallen(fall_watch_.Last()))) {
    // This is the last attempt, or the robot is on its belly already, and the verdict is late.
  } else if (fall != FallWatch::UPRIGHT) {
    const EndReason reason = EndReason::Of(END_FELL, FallWatch::Words(fall));
    orders_.DemandLettingGo(reason);
    Brake(reason);
  }
  if (activity_ == WALKING) {
    const unsigned frames = walked_.Measured(legs, reading.paws, frame, gait_.UnseenWay(pace_.velocity));
    CompareVelocity(frames);
    FeelLean(reading, frames);
    if (is_guarded_) {
      guard_.HaveWalked(walked_.Now(), pace_.velocity, frames);
    }
  }
  goes_soft_ = has_legs_ && !gets_up_ && lies && fall_watch_.Duration(frame) >= FRAMES_TO_SOFTEN;
  rests_since_ = is_resting_ ? rests_since_ : frame;
  has_rested_ = is_resting_ && frame - rests_since_ >= FRAMES_TO_FOLLOW;
}

// A robot that has been somewhere else knows nothing about the ground around it.
void Walker::HaveLooked(const WalkGuard::Reading& reading) {
  if (!can_walk_ || !is_guarded_) {
    return;
  }
  LegAngles legs[NUMBER_OF_LEGS];
  FindLegs(legs);
  if (fall_watch_.Now() != FallWatch::UPRIGHT || !has_legs_ || (activity_ != WALKING && !postures_.Stands(legs))) {
    guard_.Forget();
    return;
  }
  const StepParameters step = gait_.StepAt(pace_.velocity);
  guard_.Look(reading, legs, pace_.phase, activity_ == WALKING ? &step : NULL);
  if (activity_ != WALKING || ends_) {
    return;
  }
  const char* objection = guard_.Objection(pace_.velocity);
  objection = objection == NULL ? guard_.Objection(wanted_) : objection;
  if (objection != NULL) {
    const EndReason reason = {END_REFUSED, objection, ""};
    orders_.DemandLettingGo(reason);
    EndWalkInStand(reason);
  }
}

bool Walker::TriesAnotherWay(int joint) {
  if (activity_ != TAKING_POSTURE || is_resting_ || !Moves(joint) || attempts_ >= ATTEMPTS) {
    return false;
  }
  plans_again_ = true;
  return true;
}

bool Walker::TakeSoftened() {
  const bool has_softened = has_softened_;
  has_softened_ = false;
  return has_softened;
}

protocol::version2::Posture Walker::Now(const int* positions) const {
  using namespace protocol::version2;
  switch (fall_watch_.Now()) {
    case FallWatch::ON_LEFT_SIDE:
    case FallWatch::ON_RIGHT_SIDE:
    case FallWatch::UPSIDE_DOWN:
      return POSTURE_FALLEN;
    case FallWatch::CARRIED:
      return POSTURE_CARRIED;
    case FallWatch::UPRIGHT:
      break;
  }
  if (activity_ == WALKING || !can_walk_) {
    return can_walk_ ? POSTURE_WALK : POSTURE_UNKNOWN;
  }
  LegAngles legs[NUMBER_OF_LEGS];
  FindLegs(positions, legs);
  if (postures_.Stands(legs)) {
    return POSTURE_STAND;
  }
  if (postures_.Is(POSTURE_SIT, legs)) {
    return POSTURE_SIT;
  }
  return postures_.Is(POSTURE_REST, legs) ? POSTURE_REST : POSTURE_UNKNOWN;
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

// The planned angles of the legs.
void Walker::FindLegs(LegAngles* legs) const {
  int positions[robot_model::MAX_JOINTS];
  for (int i = 0; i < robot_.number_of_joints; ++i) {
    positions[i] = planner_.Position(i);
  }
  FindLegs(positions, legs);
}

void Walker::FindLegs(const int* positions, LegAngles* legs) const {
  for (int i = 0; i < NUMBER_OF_LEGS; ++i) {
    legs[i].rotator = positions[joints_[i][0]] * MICRO;
    legs[i].elevator = positions[joints_[i][1]] * MICRO;
    legs[i].knee = positions[joints_[i][2]] * MICRO;
  }
}

// Begins an order in place of what is being done. A walk that was to end anyway ends for its own reason.
void Walker::ReplaceOrder(const EndReason& reason, unsigned char what, unsigned short number, const char* name) {
  orders_.End(order_, IsWalk() && ends_ && !has_next_ ? end_reason_ : reason);
  order_ = orders_.Begin(what, number, name);
}

void Walker::Begin(bool is_walk, Posture posture) {
  activity_ = TAKING_POSTURE;
  has_legs_ = true;
  is_resting_ = false;
  has_rested_ = false;
  has_softened_ = false;
  is_walk_ = is_walk;
  posture_ = posture;
  gets_up_ = HasFallen();
  attempts_ = 0;
  pace_ = Pace();
  PlanWay(false);
  BeginNextStage();
}

// Finds the way from here to the posture, or to the belly.
void Walker::PlanWay(bool lies_down) {
  plans_again_ = false;
  way_begun_ = 0;
  rolls_ = gets_up_ && FallWatch::IsFallen(fall_watch_.Last());
  if (rolls_) {
    way_size_ = Postures::FindWayToBelly(fall_watch_.Last(), attempts_, way_);
  } else {
    LegAngles legs[NUMBER_OF_LEGS];
    FindLegs(legs);
    way_size_ = postures_.FindWay(legs, posture_, lies_down, way_);
  }
  ++attempts_;
}

// Begins the next stage of the way. After the last one, finishes the order.
void Walker::BeginNextStage() {
  if (way_begun_ == way_size_) {
    FinishWay();
    return;
  }
  const Postures::Stage next = way_[way_begun_++];
  const LegAngles* const legs = postures_.Legs(next);
  int farthest = 0;
  for (int i = 0; i < LEG_JOINTS; ++i) {
    const int number = i % JOINTS_OF_A_LEG;
    if (Postures::Moves(next, number)) {
      const int joint = joints_[i / JOINTS_OF_A_LEG][number];
      const int target = Microradians(AngleOf(legs[i / JOINTS_OF_A_LEG], number));
      planner_.Aim(joint, target);
      farthest = std::max(farthest, abs(target - planner_.Position(joint)));
    }
  }
  const int milliseconds = static_cast<int>(static_cast<double>(farthest) / SpeedIn(next) * 1000);
  planner_.Go(milliseconds);
  frames_to_settle_ = rolls_ && way_begun_ == way_size_ ? FRAMES_TO_SETTLE : 0;
  const bool rests = !is_walk_ && posture_ == POSTURE_REST && next == Postures::REST;
  if (rests || rolls_) {
    LevelHead(milliseconds);
  }
}

int Walker::SpeedIn(Postures::Stage stage) const {
  const int speed = Postures::IsPosture(stage) ? POSTURE_SPEED : UNLOADED_SPEED;
  const bool pushes = stage == Postures::PUSH_LEFT || stage == Postures::PUSH_RIGHT;
  return gets_up_ && !pushes ? 2 * speed : speed;
}

void Walker::FinishWay() {
  const bool still_lies = FallWatch::IsFallen(fall_watch_.Last());
  if (rolls_ && !(still_lies && attempts_ >= ATTEMPTS)) {
    PlanWay(true);
    BeginNextStage();
  } else if (rolls_) {
    Brake(EndReason::Of(END_FELL, FallWatch::Words(fall_watch_.Now())));
  } else if (is_walk_ && !ends_) {
    walked_.Begin();
    activity_ = WALKING;
  } else if (!is_walk_ && posture_ == POSTURE_REST) {
    is_resting_ = true;
  } else {
    Finish(is_walk_ ? end_reason_ : DONE);
  }
}

bool Walker::HaveArrived() {
  for (int i = 0; i < LEG_JOINTS; ++i) {
    if (planner_.FramesLeft(joints_[i / JOINTS_OF_A_LEG][i % JOINTS_OF_A_LEG]) > 0) {
      return false;
    }
  }
  return frames_to_settle_-- <= 0;
}

// A head that hangs down would hit the floor, or keep the robot from rolling over.
void Walker::LevelHead(int milliseconds) {
  for (int i = 0; i < LEVELLED; ++i) {
    if (levels_[i]) {
      planner_.Aim(head_[i], i == 0 ? -174533 : 0);  // the neck 10 degrees forward
    }
  }
  planner_.Go(milliseconds);
}

// Only the first reason is kept.
void Walker::EndWalkInStand(const EndReason& reason) {
  if (IsWalk() && !ends_) {
    ends_ = true;
    end_reason_ = reason;
  }
}

void Walker::Walk() {
  ChangeVelocity();
  const bool stops = ends_ && pace_.velocity.isZero() && pace_.correction.isZero();
  if (stops && pace_.effort == 0) {
    if (has_next_) {
      has_next_ = false;
      Begin(false, next_);
    } else {
      Finish(end_reason_);
    }
    return;
  }
  const Velocity sum = {pace_.velocity.forward + pace_.correction.forward, pace_.velocity.left + pace_.correction.left,
                        pace_.velocity.turn + pace_.correction.turn};
  const Velocity velocity = gait_.LimitedForLegs(sum, pace_.velocity.forward);
  const double period = gait_.StepAt(velocity).period;
  pace_.effort = Towards(pace_.effort, stops ? 0 : 1, FRAME / (period / 2));
  pace_.phase += FRAME / period;
  pace_.phase -= floor(pace_.phase);
  pace_.shift.x = Balanced(pace_.shift.x, pace_.lean.x);
  pace_.shift.y = Balanced(pace_.shift.y, pace_.lean.y);
  SetFeet(velocity);
}

void Walker::ChangeVelocity() {
  const protocol::version2::WalkLimits& limits = gait_.Parameters().highest;
  Velocity target = ends_ ? NO_VELOCITY : wanted_;
  if (is_guarded_) {
    target.forward = std::min(target.forward, guard_.HighestForward());
  }
  if (std::max(fabs(pace_.shift.x), fabs(pace_.shift.y)) > STEEP) {
    target.forward = std::min(target.forward, limits.forward);
  }
  const bool is_back = pace_.velocity.forward < 0 || (pace_.velocity.forward == 0 && target.forward < 0);
  const double step = SPEED_CHANGE * FRAME;
  const Velocity most = {step * (is_back ? limits.back : limits.forward), step * limits.left, step * limits.turn};
  pace_.velocity = gait_.LimitedInWalk(Towards(pace_.velocity, target, most));
  if (ends_) {
    pace_.correction = Towards(pace_.correction, NO_VELOCITY, most);
  } else {
    CorrectVelocity();
  }
}

// A little in each frame: a foot must not jump.
void Walker::CorrectVelocity() {
  const protocol::version2::WalkLimits& limits = gait_.Parameters().highest;
  pace_.correction.forward = Corrected(pace_.correction.forward, pace_.missing.forward, limits.forward);
  pace_.correction.left = Corrected(pace_.correction.left, pace_.missing.left, limits.left);
  pace_.correction.turn = Corrected(pace_.correction.turn, pace_.missing.turn, limits.turn);
}

// Compares the measured velocity with the commanded one, which the legs follow with a delay.
void Walker::CompareVelocity(unsigned frames) {
  const double seconds = frames * FRAME;
  const Velocity& now = walked_.Now();
  pace_.expected = Following(pace_.expected, pace_.velocity, DELAY, seconds);
  const Velocity missing = {pace_.expected.forward - now.forward, pace_.expected.left - now.left,
                            pace_.expected.turn - now.turn};
  pace_.missing = Following(pace_.missing, missing, SMOOTHING, seconds);
}

// The accelerometer measures gravity only on average, because each foot that touches down shakes the body.
void Walker::FeelLean(const FallWatch::Reading& reading, unsigned frames) {
  if (reading.up > 0) {  // it is 0 without an accelerometer
    const double ahead = -reading.forward / GRAVITY - gait_.NoseDown(pace_.velocity);
    pace_.lean.x = Following(pace_.lean.x, ahead, SMOOTHING, frames * FRAME);
    pace_.lean.y = Following(pace_.lean.y, -reading.left / GRAVITY, SMOOTHING, frames * FRAME);
  }
}

void Walker::SetFeet(const Velocity& velocity) {
  LegAngles legs[NUMBER_OF_LEGS];
  gait_.FindPosture(pace_.phase, velocity, pace_.effort, legs, pace_.shift);
  for (int i = 0; i < LEG_JOINTS; ++i) {
    planner_.Aim(joints_[i / JOINTS_OF_A_LEG][i % JOINTS_OF_A_LEG],
                 Microradians(AngleOf(legs[i / JOINTS_OF_A_LEG], i % JOINTS_OF_A_LEG)));
  }
  planner_.Follow();
}

void Walker::Finish(const EndReason& reason) {
  activity_ = IDLE;
  gets_up_ = false;
  is_resting_ = false;
  has_rested_ = false;
  has_next_ = false;
  orders_.End(order_, reason);
  order_ = OrderBook::NO_ORDER;
}
