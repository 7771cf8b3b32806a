#include "movement/mover.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "aibo_client/exceptions.h"
#include "text/plain_text.h"

namespace aibo_driver::movement {

using aibo_client::CommandException;
using aibo_client::EndedHow;
using aibo_client::EndedKind;
using aibo_client::Exception;
using aibo_client::MotorState;
using aibo_client::NetworkException;
using aibo_client::Posture;
using aibo_client::RefusalCause;
using aibo_client::WalkVelocity;

namespace {

using Lock = std::lock_guard<std::mutex>;
using Kind = Movement::Kind;
using std::chrono::milliseconds;

// Orders that are repeated after shorter breaks are one order to their user.
constexpr milliseconds kRepeatedWithin{500};

constexpr const char* kConnectionLost = "the connection to the robot was lost; the movement will not be resumed";

// Also the robot says it, of its own client: this driver.
constexpr const char* kLetGoFirst = "; let go first";

bool isEndOf(const Movement& movement, const aibo_client::MotionEnd& end) {
  switch (movement.kind) {
    case Kind::kMotion:
      return end.kind == EndedKind::kMotion && movement.name == end.name;
    case Kind::kPosture:
      return end.kind == EndedKind::kPosture && movement.name == end.name;
    case Kind::kWalk:
      return end.kind == EndedKind::kWalk;
    default:
      return false;
  }
}

std::string nameOf(Posture posture) {
  switch (posture) {
    case Posture::kStand:
      return "stand";
    case Posture::kSit:
      return "sit";
    case Posture::kRest:
      break;
  }
  return "rest";
}

bool areSame(const EndedMovement& a, const EndedMovement& b) {
  return a.movement.kind == b.movement.kind && a.movement.source == b.movement.source &&
         a.movement.joints == b.movement.joints && a.reason == b.reason;
}

std::vector<std::string> namesOf(const JointTargets& targets, const JointTable& table) {
  std::vector<std::string> names;
  for (const JointProperties& joint : table.joints()) {
    if (targets.count(joint.id) > 0) {
      names.push_back(joint.name);
    }
  }
  return names;
}

std::vector<int> identifiersOfLegs(const JointTable& table) {
  std::vector<int> identifiers;
  for (const JointProperties& joint : table.joints()) {
    if (joint.is_of_leg) {
      identifiers.push_back(joint.id);
    }
  }
  return identifiers;
}

// Turns a sentence into a reason that follows a colon.
std::string reasonOf(std::string sentence) {
  if (!sentence.empty() && sentence.back() == '.') {
    sentence.pop_back();
  }
  return sentence;
}

std::string reasonOf(const std::exception& error) {
  return reasonOf(std::string(error.what()));
}

// The sender of an order chooses a part of the reason. It is published, remembered, and sent to other nodes.
EndedMovement endOf(Movement movement, EndedHow how, const std::string& reason) {
  constexpr std::size_t kLongestReason = 1000;
  return {std::move(movement), how, text::plainLine(reason, kLongestReason)};
}

}  // namespace

Mover::Mover(const JointTable& table, const MeasuredJoints& measured, aibo_client::RcServerClient& client,
             double approach_speed, bool slow_down, std::function<bool()> telemetry_wanted, Clock clock)
    : table_(table),
      client_(client),
      telemetry_wanted_(std::move(telemetry_wanted)),
      clock_(std::move(clock)),
      filter_(table, measured, approach_speed),
      plan_(table, measured, slow_down) {}

// Does some work with the lock, and then calls the listener without it.
template <typename Work>
auto Mover::change(const Work& work) {
  const auto locked = [&] {
    const Lock lock(mutex_);
    return work();
  };
  if constexpr (std::is_void_v<decltype(work())>) {
    locked();
    tell();
  } else {
    auto result = locked();
    tell();
    return result;
  }
}

void Mover::tell() {
  News news;
  {
    const Lock lock(mutex_);
    std::swap(news, news_);
  }
  for (const EndedMovement& ended : news.ended) {
    if (listener_.on_ended) {
      listener_.on_ended(ended);
    }
  }
  for (const std::string& warning : news.warnings) {
    if (listener_.on_warning) {
      listener_.on_warning(warning);
    }
  }
  if (listener_.on_change) {
    listener_.on_change();
  }
}

Mover::Begun Mover::command(const Order& order, const std::vector<std::string>& names,
                            const std::vector<double>& positions, const std::vector<double>& velocities, Kind kind) {
  const std::string too_many = describeTooMany(names.size());
  if (!too_many.empty()) {
    return refuse(order, kind, {}, too_many);
  }
  Begun begun = change([&] {
    checkConnection();
    const SteadyTime now = clock_();
    Movement movement{kind, "", order.source, known(names), std::nullopt};
    const std::string reason = gate_.refusal(order, now);
    if (!reason.empty()) {
      return refuse(std::move(movement), reason);
    }
    JointTargets targets;
    const std::string left_out = listOf(filter_.filter(names, positions, velocities, now, &targets), " ");
    if (targets.empty()) {
      return refuse(std::move(movement), reasonOf(left_out));
    }
    movement.joints = namesOf(targets, table_);
    Record* const same = findCommand(movement);
    const MovementId id = same != nullptr ? same->id : last_id_ + 1;
    try {
      send(targets, milliseconds(0), termsOf(order, id));
    } catch (const Exception& error) {
      filter_.startApproach();
      return refuse(std::move(movement), reasonOf(error));
    }
    if (!left_out.empty()) {
      news_.warnings.push_back(left_out);
    }
    overruleWalk(movement);
    plan_.command(id, targets, now);
    takeEndsOfPlan();
    if (same != nullptr) {
      same->troubles.clear();  // the robot tries again, and says so if the joint still does not follow
    }
    return same != nullptr ? Begun{id, same->end, false, ""} : begin(std::move(movement));
  });
  if (listener_.on_begin) {
    listener_.on_begin();
  }
  return begun;
}

Mover::Begun Mover::follow(const Order& order, const TrajectoryRequest& request, std::chrono::nanoseconds wait,
                           const Arrival& arrival) {
  const std::string too_many = describeTooMany(request.joints.size());
  if (!too_many.empty()) {
    return refuse(order, Kind::kTrajectory, {}, too_many);
  }
  Begun begun = change([&] {
    checkConnection();
    const SteadyTime now = clock_();
    Movement movement{Kind::kTrajectory, "", order.source, known(request.joints), std::nullopt};
    const std::string reason = gate_.refusal(order, now);
    if (!reason.empty()) {
      return refuse(std::move(movement), reason);
    }
    endIfHeldUp(now);
    double stretch = 1;
    try {
      checkTelemetry();
      requireDesign(client_, table_.design());
      const milliseconds oldest = client_.status().protocol_version == 1 ? kFreshVersion1 : kFresh;
      stretch = plan_.add(last_id_ + 1, request, arrival, now + wait, now, oldest);
    } catch (const Exception& error) {
      return refuse(std::move(movement), reasonOf(error));
    }
    overruleWalk(movement);
    Begun result = begin(std::move(movement));
    if (stretch > 1) {
      result.remark = "slowed down " + std::to_string(stretch) + " times to keep the joints' speed limits";
    }
    sendSteps(plan_.advance(now));
    takeEndsOfPlan();
    return result;
  });
  if (listener_.on_begin) {
    listener_.on_begin();
  }
  return begun;
}

Mover::Begun Mover::play(const Order& order, const std::string& name, int repetitions) {
  const Begun begun = change([&] {
    checkConnection();
    Movement movement{Kind::kMotion, name, order.source, {}, std::nullopt};
    const std::string reason = refusalOf(order, movement, false);
    if (!reason.empty()) {
      return refuse(std::move(movement), reason);
    }
    plan_.endTrajectories(EndedHow::kReplaced, order.source + " plays " + name);
    takeEndsOfPlan();
    try {
      // Otherwise the robot would keep lower limits of earlier commands.
      limitSpeeds(table_.motionSpeedLimits());
    } catch (const Exception& error) {
      return refuse(std::move(movement), reasonOf(error));
    }
    motions_connection_ = connections();
    // The movement begins now, because its end may be reported before the robot's answer.
    return begin(std::move(movement));
  });
  return askRobot(
      begun, [&] { return client_.playMotion(name, repetitions, kTimeout, termsOf(order, begun.id)); },
      [&] { client_.stopMotion(name, kTimeout); });
}

Mover::Begun Mover::takePosture(const Order& order, Posture posture) {
  const Begun begun = change([&] {
    checkConnection();
    Movement movement{Kind::kPosture, nameOf(posture), order.source, {}, std::nullopt};
    const std::string reason = refusalOf(order, movement, posture == Posture::kRest);
    if (!reason.empty()) {
      return refuse(std::move(movement), reason);
    }
    const std::string cause = order.source + " called " + movement.name;
    try {
      freeLegs(cause);
    } catch (const Exception& error) {
      return refuse(std::move(movement), reasonOf(error));
    }
    gate_.overrule(order.received, cause);
    streams_.overrule(cause);
    return begin(std::move(movement));
  });
  const auto ask = [&] {
    client_.takePosture(posture, kTimeout, termsOf(order, begun.id));
    return std::string();
  };
  return askRobot(begun, ask, [&] { client_.hold({}, kTimeout); });
}

// Why the robot may not be asked to move by itself.
std::string Mover::refusalOf(const Order& order, const Movement& movement, bool may_act_while_stopped) const {
  const std::string reason = gate_.refusal(order, clock_(), may_act_while_stopped);
  const auto is_alike = [&movement](const Movement& other) { return other.kind == movement.kind; };
  if (!reason.empty() || idsOf(is_alike).size() < kMostOfAKind) {
    return reason;
  }
  return std::to_string(kMostOfAKind) + " others of its kind have not ended yet, and no more may begin";
}

Mover::Begun Mover::refuse(const Order& order, Kind kind, const std::vector<std::string>& names,
                           const std::string& reason) {
  return change([&] { return refuse({kind, "", order.source, known(names), std::nullopt}, reasonOf(reason)); });
}

std::string Mover::refusal(const Order& order) const {
  const Lock lock(mutex_);
  return gate_.refusal(order, clock_());
}

// Waits for the robot's answer to a request that begins something. If everything is stopped meanwhile, the new movement
// is stopped, too.
template <typename Ask, typename Undo>
Mover::Begun Mover::askRobot(Begun begun, const Ask& ask, const Undo& undo) {
  if (begun.ended() != nullptr) {
    return begun;
  }
  const auto end_as = [&](EndedHow how, const std::string& reason) {
    change([&] { end(begun.id, how, reason); });
    return begun;
  };
  try {
    begun.remark = ask();
  } catch (const aibo_client::TimeoutException& error) {
    if (!error.wasSent()) {
      return end_as(EndedHow::kRefused, reasonOf(error));
    }
    begun.is_uncertain = true;
    begun.remark = reasonOf(error);
    return begun;
  } catch (const NetworkException& error) {
    return end_as(error.wasSent() ? EndedHow::kLost : EndedHow::kRefused, reasonOf(error));
  } catch (const Exception& error) {
    return end_as(EndedHow::kRefused, reasonOf(error));
  }
  const EndedMovement* const ended = begun.ended();
  if (ended != nullptr && ended->how == EndedHow::kStopped) {
    try {
      undo();
    } catch (const Exception& error) {
      change([&] { news_.warnings.push_back(describe(ended->movement) + " may go on: " + error.what()); });
    }
  } else if (!client_.status().robot.hasCapability("I")) {
    return end_as(EndedHow::kUnknown, "this robot does not say when a motion ends");
  }
  return begun;
}

void Mover::steer(const Order& order, const WalkVelocity& velocity) {
  change([&] {
    checkConnection();
    std::string overruled_by = streams_.receive(order, velocity.isZero());
    if (velocity.isZero()) {
      const Record* const walk = findWalk();
      const bool is_own = walk == nullptr || (!walk->steered && walk->movement.source == order.source);
      letGo(is_own ? "" : order.source + " sent a velocity of 0");
      return;
    }
    std::string reason = gate_.refusal(order, clock_());
    if (gate_.stoppedBy()) {
      streams_.overrule(order.source, "the robot was stopped");
    }
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

void Mover::walk(const Order& order, const WalkVelocity& velocity, Movement movement) {
  Record* record = findWalk();
  if (record != nullptr && (record->steered || !streams_.goesOn(record->movement.source, clock_()))) {
    end(record->id, EndedHow::kReplaced, order.source + " steers now");
    record = nullptr;
  }
  try {
    freeLegs(order.source + " lets the robot walk");
    client_.steer(velocity, termsOf(order, record != nullptr ? record->id : last_id_ + 1));
  } catch (const Exception& error) {
    if (record == nullptr) {
      refuse(std::move(movement), reasonOf(error));
    }
    return;
  }
  is_told_to_walk_ = true;
  if (record == nullptr) {
    begin(std::move(movement));
    record = &records_.back();
  }
  noteRival(record, order.source);
}

// The robot starts and stops, and nobody who looks at one of the two nodes can see why.
void Mover::noteRival(Record* walk, const std::string& node) {
  const SteadyTime now = clock_();
  const std::string rival = streams_.rivalOf(node, now);
  walk->rival = rival.empty() || walk->movement.source == node ? rival : node;
  if (!rival.empty() && now - std::exchange(contradicted_, now) > kRepeatedWithin) {
    news_.warnings.push_back(node + " and " + rival + " both send cmd_vel and contradict each other. The newest " +
                             "velocity counts, also a zero. Let only one of them send.");
  }
}

Mover::Begun Mover::walkToGoal(const Order& order, const std::string& goal) {
  return change([&] {
    checkConnection();
    Movement movement{Kind::kWalk, goal, order.source, {}, std::nullopt};
    const std::string reason = gate_.refusal(order, clock_());
    if (!reason.empty()) {
      return refuse(std::move(movement), reason);
    }
    const std::string cause = order.source + " sends the robot to a goal";
    const Record* const walk = findWalk();
    try {
      freeLegs(cause);
      if (walk == nullptr) {
        client_.steer({}, {clock_() + OrderGate::kLongestWait, 0});  // the robot may wait until somebody lets go
      }
    } catch (const Exception& error) {
      return refuse(std::move(movement), reasonOf(error));
    }
    is_told_to_walk_ = walk != nullptr && walk->has_begun && is_told_to_walk_;
    if (walk != nullptr) {
      end(walk->id, EndedHow::kReplaced, cause);
    }
    streams_.overrule(cause);
    Begun begun = begin(std::move(movement));
    records_.back().steered = clock_();
    records_.back().has_begun = is_told_to_walk_;  // a robot that was walking goes on walking
    return begun;
  });
}

bool Mover::walkOn(MovementId walk, const WalkVelocity& velocity) {
  return change([&] {
    checkConnection();
    Record* const record = find(walk);
    if (record == nullptr) {
      return false;
    }
    const SteadyTime before = std::exchange(*record->steered, clock_());
    const bool is_being_stopped = halts_ > 0 || !record->stop_reason.empty();
    if (*record->steered - before > OrderGate::kLongestWait) {
      letGo("");
      end(walk, EndedHow::kRefused, "the driver was held up");
    } else if (!is_being_stopped) {
      steerOn(walk, velocity);
    }
    return find(walk) != nullptr;
  });
}

void Mover::steerOn(MovementId walk, const WalkVelocity& velocity) {
  if (velocity.isZero() && !is_told_to_walk_) {
    end(walk, EndedHow::kDone, "");
  } else if (velocity.isZero()) {
    letGo("");
  } else {
    try {
      client_.steer(velocity, {clock_() + OrderGate::kLongestWait, walk});
      is_told_to_walk_ = true;
    } catch (const NetworkException& error) {
      end(walk, EndedHow::kLost, reasonOf(error));
    } catch (const Exception& error) {
      end(walk, EndedHow::kRefused, reasonOf(error));
    }
  }
}

void Mover::stopWalking(const std::string& reason) {
  change([&] {
    const Record* const walk = findWalk();
    if (walk != nullptr && !walk->steered) {
      letGo(reason);
    }
  });
}

void Mover::letGo(const std::string& reason) {
  Record* const record = findWalk();
  if (record == nullptr || (!is_told_to_walk_ && !reason.empty())) {
    return;
  }
  try {
    client_.steer({}, {clock_() + OrderGate::kLongestWait, record->id});
    is_told_to_walk_ = false;
    record->stop_reason = reason;
  } catch (const Exception&) {
    return;  // without a connection the robot stops by itself
  }
}

void Mover::stop(const Order& by) {
  {
    const Lock lock(mutex_);
    gate_.stop(by.source);
  }
  hold(by, by.source + " called stop");
}

void Mover::release(const Order& by) {
  const bool is_stopping = change([&] {
    if (halts_ > 0) {
      return true;
    }
    gate_.release();
    gate_.overrule(by.received, by.source + " called release");
    return false;
  });
  if (is_stopping) {
    throw CommandException("the robot is still being told to stop. Call release again.");
  }
}

void Mover::hold(const Order& by, const std::string& reason) {
  halt(overruleAll(by, reason), reason, [this] { tellToHold({}, std::nullopt, true); });
}

void Mover::cancel(MovementId movement, const std::string& reason) {
  const std::vector<int> joints = change([&] {
    const Record* const record = find(movement);
    if (record != nullptr && record->movement.kind == Kind::kPosture) {
      return identifiersOfLegs(table_);
    }
    std::vector<int> moving = plan_.identifiersOf(movement);
    if (record != nullptr && record->steered && is_told_to_walk_) {
      letGo(reason);
    } else if (moving.empty()) {
      end(movement, EndedHow::kStopped, reason);
    }
    return moving;
  });
  if (!joints.empty()) {
    halt({movement}, reason, [&] { tellToHold(joints, movement, false); });
  }
}

void Mover::stopMotion(const Order& by, const std::string& name) {
  client_.stopMotion(name, kTimeout);
  change([&] {
    for (const MovementId id : idsOf([&](const Movement& movement) {
           return movement.kind == Kind::kMotion && (name.empty() || movement.name == name);
         })) {
      end(id, EndedHow::kStopped, by.source + " stopped it");
    }
  });
}

bool Mover::setMotors(const Order& order, bool on) {
  const std::string cause = order.source + " switched the motors " + (on ? "on" : "off");
  bool is_on = false;
  const auto ask = [&] { is_on = client_.setMotors(on, kTimeout); };
  if (on) {
    const std::string reason = change([&] {
      std::string refusal = gate_.refusal(order, clock_());
      if (refusal.empty()) {
        gate_.overrule(order.received, cause);
      }
      return refusal;
    });
    if (!reason.empty()) {
      throw CommandException(reason + ".");
    }
    ask();
  } else {
    halt(overruleAll(order, cause), cause, ask);
  }
  change([&] {
    filter_.startApproach();
    robot_.motors = is_on ? MotorState::kOn : MotorState::kOff;
  });
  return is_on;
}

// Overrules everything that was asked for before.
// @return the movements that move the robot
std::vector<MovementId> Mover::overruleAll(const Order& by, const std::string& reason) {
  return change([&] {
    gate_.overrule(by.received, reason);
    streams_.overrule(reason);
    return idsOf([](const Movement&) { return true; });
  });
}

// Tells the robot to end movements. Meanwhile nothing is moved on.
template <typename Tell>
void Mover::halt(const std::vector<MovementId>& movements, const std::string& reason, const Tell& tell_robot) {
  change([&] {
    ++halts_;
    halt_reason_ = reason;
    filter_.interruptApproach(clock_());
  });
  const auto end_as = [&](EndedHow how, const std::string& why) {
    change([&] {
      --halts_;
      for (const MovementId id : movements) {
        end(id, how, why);
      }
    });
  };
  try {
    tell_robot();
  } catch (const aibo_client::TimeoutException& error) {
    end_as(EndedHow::kUnknown, reason + ", but the robot has not answered: " + reasonOf(error));
    throw;
  } catch (const NetworkException& error) {
    end_as(EndedHow::kLost, reasonOf(error));
    throw;
  } catch (const Exception& error) {
    end_as(EndedHow::kUnknown, reason + ", but " + reasonOf(error));
    throw;
  }
  end_as(EndedHow::kStopped, reason);
}

// A server that cannot hold gets the places where the joints should be. If a motion was played, the server is told to
// end its motions.
void Mover::tellToHold(const std::vector<int>& joints, std::optional<MovementId> only, bool motions_too) {
  try {
    client_.hold(joints, kTimeout);
    return;
  } catch (const CommandException&) {
    if (client_.status().robot.hasCapability("I")) {
      throw;  // it can hold, but refuses to
    }
    const Lock lock(mutex_);
    send(plan_.holdingTargets(clock_(), only), milliseconds(0), {});
    motions_too = motions_too && motions_connection_ == connections();
  }
  if (motions_too) {
    client_.stopMotion("", kTimeout);
  }
}

void Mover::steered(const WalkVelocity& in_force, std::uint64_t order) {
  change([&] {
    Record* const record = find(order);
    if (record == nullptr || record->movement.kind != Kind::kWalk) {
      return;
    }
    record->has_begun = record->has_begun || is_told_to_walk_ || !in_force.isZero();
    if (!record->has_begun && !is_told_to_walk_) {
      end(record->id, EndedHow::kStopped,
          record->stop_reason.empty() ? "it was let go before the robot walked" : record->stop_reason);
    }
  });
}

void Mover::ended(const aibo_client::MotionEnd& end) {
  change([&] {
    const auto found = std::find_if(records_.begin(), records_.end(),
                                    [&end](const Record& record) { return isEndOf(record.movement, end); });
    if (found == records_.end()) {
      return;
    }
    EndedHow how = end.how;
    std::string reason = end.reason;
    if (how == EndedHow::kStopped && halts_ > 0) {
      reason = halt_reason_;
    }
    const Kind kind = found->movement.kind;
    if (kind == Kind::kWalk) {
      if (how == EndedHow::kDone && !found->stop_reason.empty()) {
        how = EndedHow::kStopped;
        reason = found->stop_reason;
      } else if (how == EndedHow::kReplaced || how == EndedHow::kFell || how == EndedHow::kRefused) {
        streams_.overrule(reason);
      }
    }
    if (kind != Kind::kMotion) {
      // The legs may be anywhere. After "rest" the robot may even be in somebody's hands.
      filter_.startApproach();
    }
    const bool is_of_older_walk = kind == Kind::kWalk && !found->has_begun;
    if (!is_of_older_walk) {
      this->end(found->id, how, reason);
    }
  });
}

void Mover::refused(const aibo_client::Refusal& refusal) {
  change([&] {
    if (refusal.cause == RefusalCause::kStopped && halts_ > 0) {
      return;  // the movement ends with the halt
    }
    const EndedHow how = refusal.cause == RefusalCause::kReplaced ? EndedHow::kReplaced : EndedHow::kRefused;
    if (refusal.cause == RefusalCause::kJointFault) {
      for (const MovementId id : commandersOf(refusal)) {
        for (const int joint : refusal.ids) {  // the movement's other joints go on
          if (const std::optional<std::size_t> index = table_.findById(joint)) {
            find(id)->troubles[table_[*index].name] = refusal.reason;
          }
        }
      }
    } else if (refusal.request == aibo_client::RefusedRequest::kJoints) {
      for (const MovementId id : commandersOf(refusal)) {
        end(id, how, refusal.reason);
      }
      filter_.startApproach();
    } else if (refusal.request == aibo_client::RefusedRequest::kWalk) {
      const Record* const record = findWalk();
      const bool is_about_it = record != nullptr && (refusal.order == 0 || refusal.order == record->id);
      if (is_about_it && !record->has_begun) {
        end(record->id, how, refusal.reason);
      }
      if (refusal.cause != RefusalCause::kTooOld) {
        streams_.overrule(refusal.reason.substr(0, refusal.reason.find(kLetGoFirst)));
      }
    }
  });
}

void Mover::answeredLate(const aibo_client::LateAnswer& answer) {
  change([&] {
    if (!answer.accepted) {
      end(answer.order, EndedHow::kRefused, reasonOf(answer.reason));
    } else if (!client_.status().robot.hasCapability("I")) {
      end(answer.order, EndedHow::kUnknown, "this robot does not say when a motion ends");
    }
  });
}

void Mover::robotChanged(const aibo_client::MotorsAndPosture& state) {
  change([&] {
    const aibo_client::MotorsAndPosture before = std::exchange(robot_, state);
    if (before.motors == MotorState::kOn && state.motors == MotorState::kOff && halts_ == 0) {
      plan_.endAll(EndedHow::kStopped, "the motors are off");
      takeEndsOfPlan();
      streams_.overrule("the motors are off");
      filter_.startApproach();
    }
    if (state.posture == aibo_client::PostureNow::kFallen) {
      streams_.overrule("the robot has fallen");
    } else if (state.posture == aibo_client::PostureNow::kCarried) {
      streams_.overrule("the robot was lifted");
    }
  });
}

void Mover::connected() {
  change([this] { checkConnection(); });
}

void Mover::disconnected() {
  change([this] {
    endAll(EndedHow::kLost, kConnectionLost);
    robot_ = {};
  });
}

bool Mover::goOn() {
  return change([this] {
    checkConnection();
    const SteadyTime now = clock_();
    endIfHeldUp(now);
    if (halts_ == 0) {
      sendSteps(plan_.advance(now));
    }
    takeEndsOfPlan();
    return !plan_.empty();
  });
}

std::vector<Trajectory::Start> Mover::wantedBy(MovementId trajectory, SteadyTime time) const {
  const Lock lock(mutex_);
  return plan_.wantedBy(trajectory, time);
}

std::vector<std::string> Mover::jointsOf(MovementId id) const {
  const Lock lock(mutex_);
  return plan_.jointsOf(id);
}

Mover::State Mover::state() const {
  const Lock lock(mutex_);
  State state{{}, {ended_.begin(), ended_.end()}, ends_, robot_, gate_.stoppedBy(), gate_.overruled()};
  const SteadyTime now = clock_();
  for (const Record& record : records_) {
    state.movements.push_back(whole(record));
    const std::vector<std::string> joints = plan_.jointsOf(record.id);
    if (!joints.empty()) {
      state.movements.back().joints = joints;
      state.movements.back().end = plan_.endOf(record.id, now);
    }
  }
  return state;
}

// With all nodes that it is from.
Movement Mover::whole(const Record& record) {
  Movement movement = record.movement;
  movement.source += record.rival.empty() ? "" : ", " + record.rival;
  return movement;
}

Mover::Begun Mover::begin(Movement movement) {
  Record& record = records_.emplace_back();
  record.id = ++last_id_;
  record.movement = std::move(movement);
  record.end = record.promise.get_future().share();
  return {record.id, record.end, false, ""};
}

Mover::Begun Mover::refuse(Movement movement, const std::string& reason) {
  const EndedMovement refused = endOf(std::move(movement), EndedHow::kRefused, reason);
  if (!isRepeated(refused)) {
    note(refused);
  }
  std::promise<EndedMovement> promise;
  promise.set_value(refused);
  return {++last_id_, promise.get_future().share(), false, ""};
}

bool Mover::isRepeated(const EndedMovement& refused) {
  const SteadyTime now = clock_();
  const auto is_over = [now](const Refused& each) { return now - each.last >= kRepeatedWithin; };
  refused_.erase(std::remove_if(refused_.begin(), refused_.end(), is_over), refused_.end());
  const auto found = std::find_if(refused_.begin(), refused_.end(),
                                  [&](const Refused& each) { return areSame(each.movement, refused); });
  if (found != refused_.end()) {
    found->last = now;
    return true;
  }
  const Kind kind = refused.movement.kind;
  if (kind == Kind::kCommand || kind == Kind::kLookAt || kind == Kind::kWalk) {
    refused_.push_back({refused, now});
  }
  return false;
}

void Mover::note(const EndedMovement& ended) {
  ++ends_;
  ended_.push_back(ended);
  if (ended_.size() > kEndsRemembered) {
    ended_.pop_front();
  }
  news_.ended.push_back(ended);
}

// Trajectories that go on are moved on much more often.
void Mover::endIfHeldUp(SteadyTime now) {
  if (now - std::exchange(went_on_, now) > OrderGate::kLongestWait) {
    plan_.endTrajectories(EndedHow::kRefused, "the driver was held up");
    takeEndsOfPlan();
  }
}

// Does nothing if it has ended.
void Mover::end(MovementId id, EndedHow how, const std::string& reason) {
  plan_.end(id, how, reason);
  takeEndsOfPlan();
  close(id, how, reason);
}

void Mover::endAll(EndedHow how, const std::string& reason) {
  plan_.endAll(how, reason);
  takeEndsOfPlan();
  for (const MovementId id : idsOf([](const Movement&) { return true; })) {
    close(id, how, reason);
  }
}

void Mover::takeEndsOfPlan() {
  for (JointPlan::End& end : plan_.takeEnded()) {
    Record* const record = find(end.id);
    if (record != nullptr && !end.joints.empty()) {
      record->movement.joints = std::move(end.joints);
    }
    std::string reason = end.reason;
    if (record != nullptr && end.how == EndedHow::kNotReached) {
      for (const auto& [joint, trouble] : record->troubles) {
        if (end.reason.find(joint + ' ') != std::string::npos) {
          reason = trouble + " (" + end.reason + ")";
        }
      }
    }
    close(end.id, end.how, reason);
  }
}

void Mover::close(MovementId id, EndedHow how, const std::string& reason) {
  const auto record =
      std::find_if(records_.begin(), records_.end(), [id](const Record& each) { return each.id == id; });
  if (record != records_.end()) {
    const EndedMovement ended = endOf(whole(*record), how, reason);
    record->promise.set_value(ended);
    records_.erase(record);
    note(ended);
  }
}

template <typename Condition>
std::vector<MovementId> Mover::idsOf(const Condition& condition) const {
  std::vector<MovementId> ids;
  for (const Record& record : records_) {
    if (condition(record.movement)) {
      ids.push_back(record.id);
    }
  }
  return ids;
}

// The movements that a refusal to move joints is about.
std::vector<MovementId> Mover::commandersOf(const aibo_client::Refusal& refusal) const {
  std::vector<MovementId> ids;
  for (const Record& record : records_) {
    const std::vector<std::string> joints = plan_.jointsOf(record.id);
    const bool is_named = refusal.order == record.id;
    const bool has_one = std::any_of(refusal.ids.begin(), refusal.ids.end(), [&](int id) {
      const std::optional<std::size_t> joint = table_.findById(id);
      return joint && std::find(joints.begin(), joints.end(), table_[*joint].name) != joints.end();
    });
    if (is_named || (refusal.order == 0 && has_one)) {
      ids.push_back(record.id);
    }
  }
  return ids;
}

Mover::Record* Mover::find(MovementId id) {
  const auto found = std::find_if(records_.begin(), records_.end(), [id](const Record& each) { return each.id == id; });
  return found == records_.end() ? nullptr : &*found;
}

Mover::Record* Mover::findWalk() {
  const auto found = std::find_if(records_.begin(), records_.end(),
                                  [](const Record& each) { return each.movement.kind == Kind::kWalk; });
  return found == records_.end() ? nullptr : &*found;
}

// If a node commands the same joints again, the same movement goes on.
Mover::Record* Mover::findCommand(const Movement& movement) {
  const auto found = std::find_if(records_.begin(), records_.end(), [&](const Record& each) {
    return each.movement.kind == movement.kind && each.movement.source == movement.source &&
           plan_.jointsOf(each.id) == movement.joints;
  });
  return found == records_.end() ? nullptr : &*found;
}

// The robot's joints among these names, in the robot's order.
std::vector<std::string> Mover::known(const std::vector<std::string>& names) const {
  std::vector<std::string> joints;
  for (const JointProperties& joint : table_.joints()) {
    if (std::find(names.begin(), names.end(), joint.name) != names.end()) {
      joints.push_back(joint.name);
    }
  }
  return joints;
}

aibo_client::OrderTerms Mover::termsOf(const Order& order, MovementId id) {
  return {order.received + OrderGate::kLongestWait, id};
}

// After a new connection the robot may have any posture, and it has stopped whatever moved before.
void Mover::checkConnection() {
  const std::uint64_t present = connections();
  if (connection_ != present) {
    connection_ = present;
    filter_.startApproach();
    endAll(EndedHow::kLost, kConnectionLost);
    gate_.overrule(clock_(), "the robot was connected");
    streams_.overrule("the connection is a new one");
  }
}

void Mover::checkTelemetry() const {
  if (!telemetry_wanted_()) {
    throw aibo_client::InvalidArgumentException(
        "telemetry_rate is 0, so it is not known where the joints are. Set it above 0: rosrun dynamic_reconfigure "
        "dynparam set NODE telemetry_rate 31.25");
  }
}

// An order that moves a leg takes the legs from a walk.
void Mover::overruleWalk(const Movement& movement) {
  for (const std::string& joint : table_.namesOfLegs()) {
    if (std::find(movement.joints.begin(), movement.joints.end(), joint) != movement.joints.end()) {
      streams_.overrule(movement.source + " moves " + joint);
      return;
    }
  }
}

// Movements of the head alone go on. A walk needs the full speed of the legs, but the robot would keep lower speed
// limits of earlier commands.
void Mover::freeLegs(const std::string& reason) {
  requireDesign(client_, table_.design());
  plan_.replace(table_.namesOfLegs(), reason);
  takeEndsOfPlan();
  if (client_.status().robot.hasCapability("S")) {
    limitSpeeds(table_.ownSpeedsOfLegs());
  }
}

void Mover::send(const JointTargets& targets, milliseconds duration, const aibo_client::OrderTerms& terms) {
  sendTargets(client_, table_.design(), targets, duration, terms);
}

void Mover::limitSpeeds(const std::vector<aibo_client::JointSpeedLimit>& limits) {
  requireDesign(client_, table_.design());
  client_.setJointSpeedLimits(limits);
}

// If this number has changed, there is a new connection. Then nothing that was sent over the old one may be repeated.
std::uint64_t Mover::connections() const {
  return client_.statistics().connections;
}

void Mover::sendSteps(const std::vector<JointStep>& steps) {
  for (const JointStep& step : steps) {
    try {
      send(step.targets, step.duration, {clock_() + OrderGate::kLongestWait, step.movement});
    } catch (const NetworkException& error) {
      end(step.movement, EndedHow::kLost, reasonOf(error));
    } catch (const Exception& error) {
      end(step.movement, EndedHow::kRefused, reasonOf(error));
    }
  }
}

}  // namespace aibo_driver::movement
