#include "rcserver/walk/Walker.h"

#include <stdio.h>

#include <algorithm>

using namespace protocol::version2;
using namespace robot_model;

namespace {

// Frames until joints have followed commands, which are up to 8 frames ahead, and servos lag. Our choice.
const unsigned FRAMES_TO_FOLLOW = 25;

// Frames after which the motors of a robot on its side go off: 1 s.
const unsigned FRAMES_TO_SOFTEN = 125;

// Frames until the joints of a robot that has rolled over have followed, and its body lies still. Our choice.
const int FRAMES_TO_SETTLE = 45;

const Velocity NO_VELOCITY = {0, 0, 0};

const EndReason DONE = {END_DONE, "", ""};
const EndReason POSTURE_BEGAN = {END_REPLACED, "the robot was told to take a posture", ""};
const EndReason WALK_BEGAN = {END_REPLACED, "the robot was told to walk", ""};
const EndReason NOT_STEERED = {END_STOPPED, "it was not steered for 500 ms", ""};  // STEERING_TIMEOUT_MS
const EndReason CLIENT_GONE = {END_STOPPED, "the client is gone", ""};

}  // namespace

const int Walker::POSTURE_SPEED;
const int Walker::UNLOADED_SPEED;
const int Walker::ATTEMPTS;
const int Walker::STEERING_FRAMES;

Walker::Walker(JointPlanner& planner, const RobotModel& robot, OrderBook& orders)
    : planner_(planner),
      robot_(robot),
      postures_(gait_),
      pace_(gait_),
      guard_(gait_),
      orders_(orders),
      legs_(planner, robot),
      head_(planner, robot),
      activity_(IDLE),
      has_legs_(false),
      goes_soft_(false),
      has_softened_(false),
      before_rest_(0),
      order_(OrderBook::NO_ORDER),
      posture_(POSTURE_STAND),
      route_(),
      walk_() {
  problem_[0] = '\0';
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
  legs_.ResetSpeedLimits();
  head_.Begin(false);
  if (BeginsOrder(wanted)) {
    ReplaceOrder(WALK_BEGAN, ENDED_WALK, number, WALK_NAME);
  }
  if (!IsWalk()) {
    Begin(POSTURE_WALK);
  }
  walk_.next = POSTURE_UNKNOWN;
  walk_.ends = false;
  walk_.frames_since_steered = 0;
  if (!guarded) {  // an unguarded walk does not look at the ground
    guard_.Forget();
  }
  walk_.is_guarded = guarded;
  Velocity asked = wanted;
  if (guarded) {  // if the robot walked faster, it could not stop before what it sees
    asked.forward = std::min(asked.forward, gait_.Parameters().highest.forward);
  }
  walk_.wanted = gait_.Limited(asked);
  return walk_.wanted;
}

void Walker::Take(Posture posture, unsigned short number) {
  head_.Begin(NeedsLevelHead(posture));
  ReplaceOrder(POSTURE_BEGAN, ENDED_POSTURE, number, postureName(posture));
  if (activity_ != WALKING) {
    Begin(posture);
    return;
  }
  walk_.ends = true;
  walk_.next = posture;
}

void Walker::Stop(const EndReason& reason) {
  has_legs_ = false;
  goes_soft_ = false;
  Brake(reason);
}

void Walker::MotorsGoOff(const EndReason& reason) {
  has_softened_ = has_softened_ || goes_soft_;
  Stop(activity_ == HAS_RESTED ? DONE : reason);
}

void Walker::Brake(const EndReason& reason) {
  if (!IsActive()) {
    return;
  }
  legs_.Hold();
  Finish(reason);
}

void Walker::ClientGone() {
  const bool rests = activity_ == WALKING ? walk_.next == POSTURE_REST : IsActive() && posture_ == POSTURE_REST;
  if (activity_ != WALKING && !rests) {
    Stop(CLIENT_GONE);
  } else if (activity_ == WALKING && HasNext() && !rests) {
    walk_.next = POSTURE_UNKNOWN;
    orders_.End(order_, CLIENT_GONE);
    order_ = OrderBook::NO_ORDER;
  } else if (!rests) {
    EndWalkInStand(CLIENT_GONE);
  }
  has_softened_ = false;
}

bool Walker::NeedsLevelHead(Posture posture) const {
  return posture == POSTURE_REST || HasFallen();
}

void Walker::NextFrame() {
  if (!IsMoving()) {
    return;
  }
  if (IsWalk() && ++walk_.frames_since_steered >= STEERING_FRAMES) {
    EndWalkInStand(NOT_STEERED);
  }
  if (activity_ == TAKING_POSTURE && route_.plans_again) {
    PlanRoute(true);
    BeginNextStage();
  } else if (activity_ == TAKING_POSTURE && HaveArrived()) {
    BeginNextStage();
  }
  if (activity_ == WALKING) {
    const int slow = legs_.FindSlow();  // the gait needs nearly the highest speeds of the joints
    if (slow != NO_JOINT) {
      const EndReason reason = {END_REFUSED, "the speed limit of %s is too low for walking", robot_.joints[slow].name};
      if (!walk_.ends) {
        orders_.DemandLettingGo(reason);
      }
      EndWalkInStand(reason);
    }
    Walk();
  }
}

void Walker::Measured(const FallWatch::Reading& reading, const int* positions, unsigned frame) {
  if (!CanWalk()) {
    return;
  }
  LegAngles legs[NUMBER_OF_LEGS];
  legs_.Find(positions, legs);
  fall_watch_.Look(reading, postures_.Stands(legs), frame);
  const FallWatch::Verdict fall = fall_watch_.Now();
  const bool lies = FallWatch::IsFallen(fall);
  if (route_.gets_up && lies && route_.attempts < ATTEMPTS) {
    route_.plans_again = route_.plans_again || (!route_.rolls && FallWatch::IsFallen(fall_watch_.Last()));
  } else if (route_.gets_up && lies && (route_.rolls || !FallWatch::IsFallen(fall_watch_.Last()))) {
    // The attempts are used up, or the robot is on its belly already and the verdict comes late.
  } else if (fall != FallWatch::UPRIGHT) {
    const EndReason reason = EndReason::Of(END_FELL, FallWatch::Words(fall));
    orders_.DemandLettingGo(reason);
    Brake(reason);
  }
  if (activity_ == WALKING) {
    const unsigned frames = walked_.Measured(legs, reading.paws, frame, gait_.UnseenWay(pace_.Commanded()));
    pace_.Measured(walked_.Now(), reading, frames);
    if (walk_.is_guarded) {
      guard_.HaveWalked(walked_.Now(), pace_.Commanded(), frames);
    }
  }
  goes_soft_ = has_legs_ && !route_.gets_up && lies && fall_watch_.Duration(frame) >= FRAMES_TO_SOFTEN;
  if (activity_ != RESTING) {
    before_rest_ = frame;
  } else if (frame - before_rest_ >= FRAMES_TO_FOLLOW) {
    activity_ = HAS_RESTED;
  }
}

// Makes the guard forget the ground if the robot has been somewhere else.
void Walker::HaveLooked(const WalkGuard::Reading& reading) {
  if (!CanWalk() || !walk_.is_guarded) {
    return;
  }
  LegAngles legs[NUMBER_OF_LEGS];
  legs_.Find(legs);
  if (fall_watch_.Now() != FallWatch::UPRIGHT || !has_legs_ || (activity_ != WALKING && !postures_.Stands(legs))) {
    guard_.Forget();
    return;
  }
  const StepParameters step = gait_.StepAt(pace_.Commanded());
  guard_.Look(reading, legs, pace_.Phase(), activity_ == WALKING ? &step : NULL);
  if (activity_ != WALKING || walk_.ends) {
    return;
  }
  const char* objection = guard_.Objection(pace_.Commanded());
  objection = objection == NULL ? guard_.Objection(walk_.wanted) : objection;
  if (objection != NULL) {
    const EndReason reason = {END_REFUSED, objection, ""};
    orders_.DemandLettingGo(reason);
    EndWalkInStand(reason);
  }
}

bool Walker::TriesAnotherRoute(int joint) {
  if (activity_ != TAKING_POSTURE || !Moves(joint) || route_.attempts >= ATTEMPTS) {
    return false;
  }
  route_.plans_again = true;
  return true;
}

bool Walker::TakeSoftened() {
  const bool has_softened = has_softened_;
  has_softened_ = false;
  return has_softened;
}

Posture Walker::Now(const int* positions) const {
  const FallWatch::Verdict fall = fall_watch_.Now();
  if (fall != FallWatch::UPRIGHT) {
    return fall == FallWatch::CARRIED ? POSTURE_CARRIED : POSTURE_FALLEN;
  }
  if (activity_ == WALKING || !CanWalk()) {
    return CanWalk() ? POSTURE_WALK : POSTURE_UNKNOWN;
  }
  LegAngles legs[NUMBER_OF_LEGS];
  legs_.Find(positions, legs);
  if (postures_.Stands(legs)) {
    return POSTURE_STAND;
  }
  if (postures_.Is(POSTURE_SIT, legs)) {
    return POSTURE_SIT;
  }
  return postures_.Is(POSTURE_REST, legs) ? POSTURE_REST : POSTURE_UNKNOWN;
}

WalkState Walker::State() const {
  if (!IsWalk()) {
    return WALK_STATE_NONE;
  }
  return activity_ == WALKING ? WALK_STATE_WALKS : WALK_STATE_GETS_READY;
}

// Begins an order in place of the present one. A walk that was to end anyway ends for its own reason.
void Walker::ReplaceOrder(const EndReason& reason, unsigned char what, unsigned short number, const char* name) {
  orders_.End(order_, IsWalk() && walk_.ends && !HasNext() ? walk_.end_reason : reason);
  order_ = orders_.Begin(what, number, name);
}

void Walker::Begin(Posture posture) {
  activity_ = TAKING_POSTURE;
  has_legs_ = true;
  has_softened_ = false;
  posture_ = posture;
  route_ = Route();
  route_.gets_up = HasFallen();
  pace_.Begin();
  PlanRoute(false);
  BeginNextStage();
}

// Finds the route from here to the posture or, if the robot rolls, to its belly.
void Walker::PlanRoute(bool lies_down) {
  route_.plans_again = false;
  route_.begun = 0;
  route_.rolls = route_.gets_up && FallWatch::IsFallen(fall_watch_.Last());
  if (route_.rolls) {
    route_.size = Postures::FindRouteToBelly(fall_watch_.Last(), route_.attempts, route_.stages);
  } else {
    LegAngles legs[NUMBER_OF_LEGS];
    legs_.Find(legs);
    const Posture posture = IsWalk() ? POSTURE_STAND : posture_;
    route_.size = postures_.FindRoute(legs, posture, lies_down, route_.stages);
  }
  ++route_.attempts;
}

// Begins the next stage of the route. After the last one, finishes the order.
void Walker::BeginNextStage() {
  if (route_.begun == route_.size) {
    FinishRoute();
    return;
  }
  const Postures::Stage next = route_.stages[route_.begun++];
  const bool moves[] = {Postures::Moves(next, 0), Postures::Moves(next, 1), Postures::Moves(next, 2)};
  const int farthest = legs_.Aim(postures_.Legs(next), moves);
  const int milliseconds = static_cast<int>(static_cast<double>(farthest) / SpeedIn(next) * 1000);
  planner_.Go(milliseconds);
  route_.frames_to_settle = route_.rolls && route_.begun == route_.size ? FRAMES_TO_SETTLE : 0;
  const bool rests = posture_ == POSTURE_REST && next == Postures::REST;
  if (rests || route_.rolls) {
    head_.Go(milliseconds);
  }
}

int Walker::SpeedIn(Postures::Stage stage) const {
  const int speed = Postures::IsPosture(stage) ? POSTURE_SPEED : UNLOADED_SPEED;
  const bool pushes = stage == Postures::PUSH_LEFT || stage == Postures::PUSH_RIGHT;
  return route_.gets_up && !pushes ? 2 * speed : speed;
}

void Walker::FinishRoute() {
  const bool still_lies = FallWatch::IsFallen(fall_watch_.Last());
  if (route_.rolls && !(still_lies && route_.attempts >= ATTEMPTS)) {
    PlanRoute(true);
    BeginNextStage();
  } else if (route_.rolls) {
    Brake(EndReason::Of(END_FELL, FallWatch::Words(fall_watch_.Now())));
  } else if (IsWalk() && !walk_.ends) {
    walked_.Begin();
    activity_ = WALKING;
  } else if (posture_ == POSTURE_REST) {
    activity_ = RESTING;
  } else {
    Finish(IsWalk() ? walk_.end_reason : DONE);
  }
}

bool Walker::HaveArrived() {
  return legs_.HaveArrived() && route_.frames_to_settle-- <= 0;
}

// Ends the walk as soon as the robot stands. If the walk is ending already, the first reason stays.
void Walker::EndWalkInStand(const EndReason& reason) {
  if (IsWalk() && !walk_.ends) {
    walk_.ends = true;
    walk_.end_reason = reason;
  }
}

void Walker::Walk() {
  Velocity target = walk_.ends ? NO_VELOCITY : walk_.wanted;
  if (walk_.is_guarded) {
    target.forward = std::min(target.forward, guard_.HighestForward());
  }
  LegAngles legs[NUMBER_OF_LEGS];
  if (pace_.NextFrame(target, walk_.ends, legs)) {
    legs_.Aim(legs);
    planner_.Follow();
  } else if (HasNext()) {
    const Posture next = walk_.next;
    walk_.next = POSTURE_UNKNOWN;
    Begin(next);
  } else {
    Finish(walk_.end_reason);
  }
}

void Walker::Finish(const EndReason& reason) {
  activity_ = IDLE;
  route_.gets_up = false;
  walk_.next = POSTURE_UNKNOWN;
  orders_.End(order_, reason);
  order_ = OrderBook::NO_ORDER;
}
