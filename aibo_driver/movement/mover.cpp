#include "movement/mover.h"

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "aibo_client/exceptions.h"
#include "aibo_client/names.h"
#include "text/plain_text.h"
#include "text/sentence.h"

namespace aibo_driver::movement {

using aibo_client::CommandException;
using aibo_client::EndedHow;
using aibo_client::EndedKind;
using aibo_client::Exception;
using aibo_client::MotorState;
using aibo_client::NetworkException;
using aibo_client::OrderTerms;
using aibo_client::Posture;
using aibo_client::RefusalCause;
using aibo_client::WalkVelocity;

namespace {

using Lock = std::lock_guard<std::mutex>;
using Kind = Movement::Kind;
using std::chrono::milliseconds;

// The robot ends its reason with this when its client, which is this driver, has to let go.
constexpr const char* kLetGoFirst = "; let go first";

constexpr const char* kNeverWalked = "it was let go before the robot walked";

OrderTerms termsOf(const Order& order, std::uint64_t number) {
  return {order.received + Mover::kLongestWait, number};
}

// Returns the future of ask(), or one that throws what ask() has thrown.
template <typename Ask>
auto futureOf(const Ask& ask) {
  try {
    return ask();
  } catch (const Exception&) {
    std::promise<decltype(ask().get())> promise;
    promise.set_exception(std::current_exception());
    return promise.get_future();
  }
}

// Turns a sentence into a reason to put after a colon.
std::string reasonOf(std::string sentence) {
  if (!sentence.empty() && sentence.back() == '.') {
    sentence.pop_back();
  }
  return sentence;
}

std::string reasonOf(const std::exception& error) {
  return reasonOf(std::string(error.what()));
}

// How an order ends that could not be sent.
EndedHow howOf(const Exception& error, EndedHow unless_lost) {
  const bool is_lost = dynamic_cast<const NetworkException*>(&error) != nullptr &&
                       dynamic_cast<const aibo_client::TimeoutException*>(&error) == nullptr;
  return is_lost ? EndedHow::kLost : unless_lost;
}

bool isTrajectoryOf(const MovementBook::Record& record, const std::vector<std::string>& joints) {
  const std::vector<std::string>& moved = record.movement.joints;
  return record.is(Kind::kTrajectory) &&
         std::find_first_of(moved.begin(), moved.end(), joints.begin(), joints.end()) != moved.end();
}

}  // namespace

Mover::Mover(const JointTable& table, const MeasuredJoints& measured, aibo_client::RcServerClient& client,
             double approach_speed, Clock clock)
    : table_(table),
      client_(client),
      clock_(std::move(clock)),
      filter_(table, measured, approach_speed),
      plan_(table, measured),
      book_(plan_) {}

// Does some work with the lock, and then calls the listener without it.
template <typename Work>
auto Mover::change(const Work& work) {
  std::unique_lock<std::mutex> lock(mutex_);
  if constexpr (std::is_void_v<decltype(work())>) {
    work();
    tell(&lock);
  } else {
    auto result = work();
    tell(&lock);
    return result;
  }
}

void Mover::tell(std::unique_lock<std::mutex>* lock) {
  const std::vector<EndedMovement> ended = book_.takeNews();
  lock->unlock();
  for (const EndedMovement& each : ended) {
    listener_.on_ended(each);
  }
  listener_.on_change();
}

// Gives an order, unless it must not act.
// @param act sends what the robot has to do, and begins the movement; what it throws is the reason for a refusal
template <typename Act>
Mover::Answer Mover::give(const Order& order, Kind kind, const std::string& name,
                          const std::vector<std::string>& joints, const Act& act, bool may_act_while_stopped) {
  return change([&] {
    checkConnection();
    Movement movement{kind, name, order.source, {}, std::nullopt};
    std::string reason = describeTooMany(joints.size());
    if (reason.empty()) {
      movement.joints = known(joints);
      reason = refusalOf(order, may_act_while_stopped);
    }
    if (!reason.empty()) {
      return refuse(std::move(movement), reason);
    }
    try {
      requireDesign(client_, table_.design());
      return act(&movement);
    } catch (const Exception& error) {
      return refuse(std::move(movement), reasonOf(error));
    }
  });
}

Mover::Answer Mover::command(const Order& order, const std::vector<std::string>& names,
                             const std::vector<double>& positions, const std::vector<double>& velocities, Kind kind) {
  const auto act = [&](Movement* movement) {
    const SteadyTime now = clock_();
    JointTargets targets;
    const std::string left_out = listOf(filter_.filter(names, positions, velocities, now, &targets), " ");
    if (targets.empty()) {
      throw aibo_client::InvalidArgumentException(left_out);
    }
    movement->joints = table_.namesOf([&targets](const JointProperties& joint) { return targets.count(joint.id) > 0; });
    const OrderNumber number = book_.nextNumber();
    try {
      sendTargets(client_, table_.design(), targets, milliseconds(0), termsOf(order, number));
    } catch (const Exception&) {
      filter_.startApproach();
      throw;
    }
    Record* const same = book_.findCommand(*movement);
    Record& record = same != nullptr ? *same : book_.begin(*movement);
    record.orders.insert(number);
    record.trouble.clear();  // the robot tries the command again
    plan_.command(record.id(), targets, now);
    book_.haltEach([&](const Record& each) { return isTrajectoryOf(each, movement->joints); },
                   {EndedHow::kReplaced, "a command moves its joints"});
    takeLegsFromWalks(*movement);
    Answer answer = answerOf(record);
    answer.remark = left_out;
    return answer;
  };
  return give(order, kind, "", names, act);
}

Mover::Answer Mover::follow(const Order& order, const TrajectoryRequest& request, std::chrono::nanoseconds wait,
                            const Arrival& arrival) {
  const auto act = [&](Movement* movement) {
    if (plan_.empty()) {
      advanced_ = order.received;
    }
    const SteadyTime now = clock_();
    const bool is_version_1 = client_.status().protocol_version == 1;
    Arrival judged = arrival;
    judged.is_measured = arrival.is_measured || is_version_1;
    movement->order = book_.nextNumber();
    plan_.add(movement->order, request, judged, now + wait, now, is_version_1 ? kFreshVersion1 : kFresh);
    const Answer result = answerOf(book_.begin(*movement));
    takeLegsFromWalks(*movement);
    sendSteps(now);
    return result;
  };
  const Answer begun = give(order, Kind::kTrajectory, "", request.joints, act);
  listener_.on_begin();
  return begun;
}

Mover::Answer Mover::play(const Order& order, const std::string& name, int repetitions) {
  std::future<std::string> answer;
  const auto act = [&](Movement* movement) {
    requireRoom(movement->kind);
    const std::string cause = order.source + " plays " + name;
    endTrajectories(cause);
    // The robot would keep lower limits of earlier commands during the motion.
    client_.setJointSpeedLimits(table_.motionSpeedLimits());
    const OrderNumber number = book_.nextNumber();
    answer = client_.beginMotion(name, repetitions, kTimeout, termsOf(order, number));
    if (book_.findWalk() == nullptr) {
      streams_.overrule(clock_(), cause);  // a motion may need the legs; during a walk, the robot says whether it does
    }
    return answerOf(book_.begin(*movement, number));
  };
  const Answer begun = give(order, Kind::kMotion, name, {}, act);
  return await(begun, &answer);
}

Mover::Answer Mover::takePosture(const Order& order, Posture posture) {
  std::future<void> answer;
  const auto act = [&](Movement* movement) {
    requireRoom(movement->kind);
    const std::string cause = order.source + " called " + movement->name;
    endTrajectories(cause);  // the trajectories of the head, too, because the robot may level its head on its way
    freeLegs(cause);
    const OrderNumber number = book_.nextNumber();
    answer = client_.beginPosture(posture, kTimeout, termsOf(order, number));
    overrule(order.received, cause);
    overruleWalks({EndedHow::kReplaced, cause});
    return answerOf(book_.begin(*movement, number));
  };
  const Answer begun =
      give(order, Kind::kPosture, aibo_client::nameOfPosture(posture), {}, act, posture == Posture::kRest);
  return await(begun, &answer);
}

void Mover::requireRoom(Kind kind) const {
  if (book_.idsOf([kind](const Record& each) { return each.is(kind); }).size() >= kMostOfAKind) {
    throw CommandException(std::to_string(kMostOfAKind) +
                           " others of this kind have not ended yet, and no more are accepted.");
  }
}

Mover::Answer Mover::refuse(const Order& order, Kind kind, const std::vector<std::string>& names,
                            const std::string& reason) {
  return change([&] { return refuse({kind, "", order.source, known(names), std::nullopt}, reasonOf(reason)); });
}

void Mover::requirePermission(const Order& order) const {
  const Lock lock(mutex_);
  const std::string refusal = refusalOf(order);
  if (!refusal.empty()) {
    throw CommandException(refusal + ".");
  }
}

// Why an order must not act now; empty if it may. An order is too old whatever it has waited for.
std::string Mover::refusalOf(const Order& order, bool may_act_while_stopped) const {
  if (stopped_by_ && !may_act_while_stopped) {
    return "stopped by " + *stopped_by_ + "; call release";
  }
  if (order.received < overruled_) {
    return "it came before " + overruled_by_;
  }
  const std::chrono::duration<double> age = clock_() - order.received;
  return age <= kLongestWait
             ? ""
             : "too old: it has waited for " + text::decimal(age.count(), 1) + " s, and 0.5 s are allowed";
}

void Mover::overrule(SteadyTime received, const std::string& what) {
  if (received > overruled_) {
    overruled_ = received;
    overruled_by_ = what;
  }
}

// Waits until the robot has answered a request that begins a movement. The movement's end is reported elsewhere.
template <typename Reply>
Mover::Answer Mover::await(Answer begun, std::future<Reply>* reply) {
  if (!reply->valid()) {
    return begun;
  }
  try {
    if constexpr (std::is_void_v<Reply>) {
      reply->get();
    } else {
      begun.remark = reply->get();
    }
  } catch (const Exception& error) {
    begun.is_uncertain = begun.ended() == nullptr;
    begun.remark = reasonOf(error);
  }
  return begun;
}

void Mover::steer(const Order& order, const WalkVelocity& velocity) {
  change([&] {
    checkConnection();
    const std::string overruled_by = streams_.receive(order, velocity.isZero(), clock_());
    if (velocity.isZero()) {
      stopWalk(order.source);
      return;
    }
    std::string reason = refusalOf(order);
    if (reason.empty() && !overruled_by.empty()) {
      reason = overruled_by + kLetGoFirst + ": 0, or nothing for 0.5 s";
    }
    Movement movement{Kind::kWalk, "", order.source, {}, std::nullopt};
    if (reason.empty()) {
      walk(order, velocity, std::move(movement));
    } else {
      refuse(std::move(movement), reason);
    }
  });
}

// A velocity of 0 is sent even if the walk is braking already.
void Mover::stopWalk(const std::string& node) {
  if (book_.findIf([](const Record& each) { return each.is(Kind::kWalk) && !each.orders.empty(); }) != nullptr) {
    sendZeros();
  }
  if (Record* const walk = book_.findWalk()) {
    const bool is_own = !walk->steered && walk->movement.source == node;
    book_.halt(walk, is_own ? Halt{EndedHow::kDone, ""} : Halt{EndedHow::kStopped, node + " sent a velocity of 0"});
  }
}

void Mover::walk(const Order& order, const WalkVelocity& velocity, Movement movement) {
  Record* record = book_.findWalk();
  if (record != nullptr && (record->steered || !streams_.goesOn(record->movement.source, clock_()))) {
    book_.halt(record, {EndedHow::kReplaced, order.source + " steers now"});
    record = nullptr;
  }
  const OrderNumber number = book_.nextNumber();
  try {
    requireDesign(client_, table_.design());
    freeLegs(order.source + " lets the robot walk");
    if (record == nullptr) {
      client_.steer({}, termsOf(order, 0));  // the node has let go, and the robot may be waiting for that
    }
    client_.steer(velocity, termsOf(order, number));
  } catch (const Exception& error) {
    if (record == nullptr) {
      refuse(std::move(movement), reasonOf(error));
    }
    return;
  }
  record = record == nullptr ? &book_.begin(std::move(movement)) : record;
  record->orders.insert(number);
}

Mover::Answer Mover::walkToGoal(const Order& order, const std::string& goal) {
  const auto act = [&](Movement* movement) {
    const std::string cause = order.source + " sends the robot to a goal";
    freeLegs(cause);
    client_.steer({}, termsOf(order, 0));
    overruleWalks({EndedHow::kReplaced, cause});
    Record& record = book_.begin(*movement);
    record.steered = order.received;
    return answerOf(record);
  };
  return give(order, Kind::kWalk, goal, {}, act);
}

// The order is taken to be as old as the previous call, because the pose behind its velocity may be as old.
void Mover::steerToGoal(MovementId walk, const WalkVelocity& velocity) {
  change([&] {
    checkConnection();
    Record* const record = book_.find(walk);
    if (record == nullptr || record->halt) {
      return;
    }
    const OrderTerms terms{std::exchange(*record->steered, clock_()) + kLongestWait, book_.nextNumber()};
    if (velocity.isZero()) {
      brake(record, {EndedHow::kDone, ""});
      return;
    }
    try {
      if (record->orders.empty()) {
        client_.steer({}, {terms.not_after, 0});
      }
      client_.steer(velocity, terms);
      record->orders.insert(terms.number);
    } catch (const Exception& error) {
      book_.close(walk, howOf(error, EndedHow::kRefused), reasonOf(error));
    }
  });
}

void Mover::stopWalking(const std::string& reason) {
  change([&] {
    Record* const walk = book_.findWalk();
    if (walk != nullptr && !walk->steered) {
      brake(walk, {EndedHow::kStopped, reason});
    }
  });
}

void Mover::brake(Record* walk, const Halt& halt) {
  if (!walk->orders.empty()) {
    sendZeros();
  }
  book_.halt(walk, halt);
}

void Mover::sendZeros() {
  try {
    client_.steer({}, {clock_() + kLongestWait, 0});
  } catch (const Exception&) {
    return;  // without a connection, the robot stops by itself
  }
}

// Tells the robot to end movements. A movement that the robot has not reported as ended when it answers ends then.
// @param only the movement to halt; empty means all
template <typename Ask>
auto Mover::halt(std::optional<MovementId> only, const std::string& reason, const Ask& ask) {
  std::vector<MovementId> halted;
  const auto halt_and_ask = [&] {
    ++pending_halts_;
    filter_.interruptApproach(clock_());
    auto future = futureOf(ask);
    halted = book_.idsOf([only](const Record& each) { return !only || each.id() == *only; });
    for (const MovementId id : halted) {
      book_.halt(book_.find(id), {EndedHow::kStopped, reason});
    }
    return future;
  };
  const auto end_as = [&](EndedHow how, const std::string& why) {
    change([&] {
      --pending_halts_;
      for (const MovementId id : halted) {
        book_.close(id, how, why);
      }
    });
  };
  const auto answer = change(halt_and_ask).share();
  try {
    answer.get();
  } catch (const Exception& error) {
    const EndedHow how = howOf(error, EndedHow::kUnknown);
    end_as(how, how == EndedHow::kLost ? reasonOf(error) : reason + ", but " + reasonOf(error));
    throw;
  }
  end_as(EndedHow::kStopped, reason);
  return answer.get();
}

// Overrules everything that was asked for before, and ends everything that moves the robot.
template <typename Ask>
auto Mover::haltAll(const Order& by, const std::string& reason, const Ask& ask) {
  const auto overrule_and_ask = [&] {
    overrule(by.received, reason);
    streams_.overrule(clock_(), reason);
    return ask();
  };
  return halt(std::nullopt, reason, overrule_and_ask);
}

void Mover::stop(const Order& by) {
  haltAll(by, by.source + " called stop", [&] {
    stopped_by_ = by.source;
    return hold({}, std::nullopt);
  });
}

void Mover::release(const Order& by) {
  change([&] {
    if (pending_halts_ > 0) {
      throw CommandException("the robot is still being told to stop. Call release again.");
    }
    if (stopped_by_) {
      streams_.overrule(clock_(), "the robot was stopped");
    }
    stopped_by_.reset();
    overrule(by.received, by.source + " called release");
  });
}

void Mover::hold(const Order& by, const std::string& reason) {
  haltAll(by, reason, [this] { return hold({}, std::nullopt); });
}

void Mover::cancel(MovementId movement, const std::string& reason) {
  const bool is_over = change([&] {
    Record* const record = book_.find(movement);
    const bool is_walk = record != nullptr && record->steered;
    if (is_walk) {
      brake(record, {EndedHow::kStopped, reason});
    }
    return is_walk || record == nullptr;
  });
  if (is_over) {
    return;
  }
  const auto hold_joints = [&] {
    const Record* const record = book_.find(movement);
    const bool is_posture = record != nullptr && record->is(Kind::kPosture);
    const std::vector<int> legs = table_.collect(isOfLeg, [](const JointProperties& joint) { return joint.id; });
    std::vector<int> joints = is_posture ? legs : std::vector<int>();
    for (const auto& [joint, target] : plan_.holdingTargets(clock_(), movement)) {
      joints.push_back(joint);
    }
    if (std::find_first_of(joints.begin(), joints.end(), legs.begin(), legs.end()) != joints.end()) {
      streams_.overrule(clock_(), reason);  // the robot, too, ends a walk when a leg is held
    }
    return joints.empty() ? std::async(std::launch::deferred, [] {}) : hold(joints, movement);
  };
  halt(movement, reason, hold_joints);
}

void Mover::stopMotion(const Order& by, const std::string& name) {
  const Halt stopped{EndedHow::kStopped, by.source + " stopped it"};
  const auto is_meant = [&name](const Record& each) {
    return each.is(Kind::kMotion) && (name.empty() || each.movement.name == name);
  };
  const std::vector<MovementId> motions = change([&] {
    book_.haltEach(is_meant, stopped);
    return book_.idsOf(is_meant);
  });
  client_.stopMotion(name, kTimeout);
  change([&] {
    for (const MovementId id : motions) {
      book_.close(id, stopped.how, stopped.reason);
    }
  });
}

bool Mover::setMotors(const Order& order, bool on) {
  const std::string cause = order.source + " switched the motors " + (on ? "on" : "off");
  bool is_on = false;
  if (on) {
    std::future<bool> answer = change([&] {
      const std::string refusal = refusalOf(order);
      if (!refusal.empty()) {
        throw CommandException(refusal + ".");
      }
      overrule(order.received, cause);
      return client_.beginMotors(true, kTimeout, termsOf(order, 0));
    });
    is_on = answer.get();
  } else {
    is_on = haltAll(order, cause, [&] { return client_.beginMotors(false, kTimeout, termsOf(order, 0)); });
  }
  change([&] { filter_.startApproach(); });
  return is_on;
}

// Ends all walks. A node that goes on steering has to let go first.
void Mover::overruleWalks(const Halt& halt) {
  streams_.overrule(clock_(), halt.reason);
  book_.haltEach([](const Record& each) { return each.is(Kind::kWalk); }, halt);
}

// Holds joints. A version 1 server cannot hold, so it is told where the joints should be, and to end its motions.
std::future<void> Mover::hold(const std::vector<int>& joints, std::optional<MovementId> only) {
  try {
    return client_.beginHold(joints, kTimeout);
  } catch (const CommandException&) {
    if (client_.status().protocol_version != 1) {
      throw;
    }
  }
  sendTargets(client_, table_.design(), plan_.holdingTargets(clock_(), only), milliseconds(0), {});
  return std::async(std::launch::deferred, [this, only] {
    if (!only) {
      client_.stopMotion("", kTimeout);
    }
  });
}

void Mover::steered(const WalkVelocity& in_force, std::uint64_t order, std::uint64_t walk) {
  change([&] {
    Record* const record = book_.ownerOf(order);
    Record* const walker = book_.ownerOf(walk);
    if (record == nullptr) {
      if (walk != 0 && walker == nullptr && !in_force.isZero()) {
        sendZeros();  // the node that asked for this walk was told that it has ended
      }
      return;
    }
    record->trouble.clear();
    if (walk == order) {
      return;
    }
    if (walk != 0 && walker != record) {
      record->orders.insert(walk);
      if (walker != nullptr) {
        book_.endOrder(walker, walk, EndedHow::kReplaced, record->movement.source + " steers now");
      }
    }
    book_.endOrder(record, order, EndedHow::kStopped, kNeverWalked);
  });
}

void Mover::ended(const aibo_client::ActivityEnd& end) {
  // With version 1, kRefused says that some of the joints were refused.
  const bool is_not_reached =
      end.kind == EndedKind::kJoints && end.how == EndedHow::kRefused && client_.status().protocol_version != 1;
  const EndedHow how = is_not_reached ? EndedHow::kNotReached : end.how;
  if (end.kind == EndedKind::kJoints && endOlder(end.order, how, end.reason)) {
    return;
  }
  change([&] {
    if (end.kind == EndedKind::kWalk || end.kind == EndedKind::kPosture) {
      // After this, the legs may be anywhere. After "rest", the robot may even be in somebody's hands.
      filter_.startApproach();
    }
    Record* const record = book_.ownerOf(end.order);
    // A walk that ends by a velocity of 0 or by silence has been ended by its node, and overrules nobody.
    const bool is_walk = end.kind == EndedKind::kWalk;
    const bool is_steerings = end.how == EndedHow::kDone || end.how == EndedHow::kStopped;
    if (is_walk && !is_steerings) {
      const bool is_halted = record != nullptr && record->hasReasonToEnd();
      streams_.overrule(clock_(), is_halted ? record->halt->reason : end.reason);
    }
    if (record == nullptr) {
      return;
    }
    if (is_walk && (!is_steerings || record->steered)) {
      record->orders = {end.order};  // no end will come for its later velocities
    }
    book_.endOrder(record, end.order, how, end.reason);
  });
}

// The end of an older command of the same movement calls no listener, because there may be hundreds in a second.
bool Mover::endOlder(OrderNumber order, EndedHow how, const std::string& reason) {
  const Lock lock(mutex_);
  Record* const record = book_.ownerOf(order);
  const bool is_older = record != nullptr && record->orders.size() > 1;
  if (is_older) {
    book_.endOrder(record, order, how, reason);
  }
  return is_older;
}

void Mover::refused(const aibo_client::Refusal& refusal) {
  change([&] {
    const bool is_robots = refusal.cause == RefusalCause::kRobot;
    const bool is_stopped = refusal.cause == RefusalCause::kStopped;
    const bool is_refused = is_robots || refusal.cause == RefusalCause::kTooOld;
    const bool is_walk = refusal.request == aibo_client::RefusedRequest::kWalk;
    if (is_refused && refusal.request == aibo_client::RefusedRequest::kJoints) {
      filter_.startApproach();
    }
    Record* const record = book_.ownerOf(refusal.order);
    if (record == nullptr) {
      return;
    }
    const bool never_walks = is_walk && is_stopped && record->orders.size() == 1;
    if (never_walks || (is_walk && is_robots)) {
      streams_.overrule(clock_(), refusal.reason.substr(0, refusal.reason.find(kLetGoFirst)));
    }
    // A request that waited for the memory stick is refused if a stop, or anything else, has halted its movement.
    const bool was_halted = record->hasReasonToEnd();
    // A trajectory must have no gap, and a robot that has refused to walk is not asked again.
    const bool is_trajectory = record->is(Kind::kTrajectory);
    if (!record->halt && ((is_trajectory && is_refused) || (is_walk && is_robots))) {
      book_.halt(record, {EndedHow::kRefused, refusal.reason});
    }
    const bool is_let_go = is_walk && record->halt && refusal.cause == RefusalCause::kReplaced;
    const bool is_users = is_stopped || is_let_go || (is_robots && was_halted);
    const EndedHow how = is_users ? EndedHow::kStopped : is_refused ? EndedHow::kRefused : EndedHow::kReplaced;
    book_.endOrder(record, refusal.order, how, is_let_go ? kNeverWalked : refusal.reason);
  });
}

void Mover::robotChanged(const aibo_client::MotorsAndPosture& state) {
  change([&] {
    const aibo_client::MotorsAndPosture before = std::exchange(robot_, state);
    if (before.motors == MotorState::kOn && state.motors == MotorState::kOff) {
      const Halt halt{EndedHow::kStopped, "the motors are off"};
      book_.haltEach([](const Record& each) { return each.is(Kind::kTrajectory); }, halt);
      overruleWalks(halt);
      filter_.startApproach();
    }
    if (state.posture == aibo_client::PostureNow::kFallen) {
      overruleWalks({EndedHow::kFell, "the robot has fallen"});
    } else if (state.posture == aibo_client::PostureNow::kCarried) {
      overruleWalks({EndedHow::kFell, "the robot was lifted"});
    }
  });
}

void Mover::connected() {
  change([this] { checkConnection(); });
}

void Mover::disconnected() {
  change([this] {
    loseAll();
    robot_ = {};
  });
}

bool Mover::advance() {
  return change([this] {
    checkConnection();
    const SteadyTime now = clock_();
    sendSteps(now);
    advanced_ = now;
    return !plan_.empty();
  });
}

std::vector<Trajectory::Start> Mover::wantedBy(MovementId trajectory, SteadyTime time) const {
  const Lock lock(mutex_);
  return plan_.wantedBy(trajectory, time);
}

Mover::State Mover::state() const {
  const Lock lock(mutex_);
  return {book_.movements(), book_.ended(), book_.ends(), robot_, stopped_by_, overruled_};
}

Mover::Answer Mover::refuse(Movement movement, const std::string& reason) {
  EndedMovement refused = book_.refuse(std::move(movement), reason, clock_());
  const MovementId id = refused.movement.order;
  std::promise<EndedMovement> promise;
  promise.set_value(std::move(refused));
  return {id, promise.get_future().share(), false, ""};
}

void Mover::loseAll() {
  book_.closeAll(EndedHow::kLost, "the connection to the robot was lost; the movement will not be resumed");
}

// The robot's joints among these names, in the robot's order.
std::vector<std::string> Mover::known(const std::vector<std::string>& names) const {
  return table_.namesOf([&names](const JointProperties& joint) {
    return std::find(names.begin(), names.end(), joint.name) != names.end();
  });
}

// Ends everything after a new connection, because the robot has stopped and may have any posture.
void Mover::checkConnection() {
  const std::uint64_t present = client_.statistics().connections;
  if (connection_ != present) {
    connection_ = present;
    filter_.startApproach();
    loseAll();
    overrule(clock_(), "the robot was connected");
    streams_.overrule(clock_(), "the connection is a new one");
  }
}

// Ends the walks if an order moves a leg.
void Mover::takeLegsFromWalks(const Movement& movement) {
  const std::vector<std::string> legs = table_.namesOf(isOfLeg);
  const auto leg = std::find_first_of(legs.begin(), legs.end(), movement.joints.begin(), movement.joints.end());
  if (leg != legs.end()) {
    overruleWalks({EndedHow::kReplaced, movement.source + " moves " + *leg});
  }
}

void Mover::endTrajectories(const std::string& reason) {
  book_.haltEach([](const Record& each) { return each.is(Kind::kTrajectory); }, {EndedHow::kReplaced, reason});
}

// Frees the legs for a walk or a posture. Movements of the head alone go on. A walk needs the full speed of the legs,
// but the robot would keep lower speed limits of earlier commands.
void Mover::freeLegs(const std::string& reason) {
  const std::vector<std::string> legs = table_.namesOf(isOfLeg);
  book_.haltEach([&](const Record& each) { return isTrajectoryOf(each, legs); }, {EndedHow::kReplaced, reason});
  plan_.forget(legs);
  if (client_.status().robot.hasCapability("S")) {
    client_.setJointSpeedLimits(table_.ownSpeedsOfLegs());
  }
}

// The orders are taken to be as old as the previous call, because the joints may have moved elsewhere since.
void Mover::sendSteps(SteadyTime now) {
  for (const JointStep& step : plan_.advance(now)) {
    const OrderNumber number = book_.nextNumber();
    try {
      sendTargets(client_, table_.design(), step.targets, step.duration, {advanced_ + kLongestWait, number});
      book_.find(step.movement)->orders.insert(number);
    } catch (const Exception& error) {
      book_.close(step.movement, howOf(error, EndedHow::kRefused), reasonOf(error));
    }
  }
  book_.takeEndsOfPlan();
}

}  // namespace aibo_driver::movement
