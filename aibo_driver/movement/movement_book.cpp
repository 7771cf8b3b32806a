#include "movement/movement_book.h"

#include <iterator>

#include "text/plain_text.h"

namespace aibo_driver::movement {

using aibo_client::EndedHow;

namespace {

using Kind = Movement::Kind;

// To its user, an order that is repeated after a shorter break than this is one order.
constexpr std::chrono::milliseconds kRepeatedWithin{500};

// Limits the reason: the sender of an order chooses a part of it, and it is published, remembered, and sent to nodes.
EndedMovement endOf(Movement movement, EndedHow how, const std::string& reason) {
  constexpr std::size_t kLongestReason = 1000;
  return {std::move(movement), how, text::plainLine(reason, kLongestReason)};
}

// Puts what went wrong with earlier orders of the movement before the reason.
std::string withTrouble(const MovementBook::Record& record, EndedHow how, const std::string& reason) {
  if (how == EndedHow::kDone || record.trouble.empty() || record.trouble == reason) {
    return reason;
  }
  return record.trouble + (reason.empty() ? "" : " (" + reason + ")");
}

}  // namespace

MovementBook::Record& MovementBook::begin(Movement movement, std::optional<OrderNumber> order) {
  Record& record = records_.emplace_back();
  record.movement = std::move(movement);
  if (record.movement.order == 0) {
    record.movement.order = nextNumber();
  }
  record.end = record.promise.get_future().share();
  if (order) {
    record.orders.insert(*order);
  }
  return record;
}

EndedMovement MovementBook::refuse(Movement movement, const std::string& reason, SteadyTime now) {
  movement.order = nextNumber();
  EndedMovement refused = endOf(std::move(movement), EndedHow::kRefused, reason);
  if (!isRepeated(refused, now)) {
    note(refused);
  }
  return refused;
}

void MovementBook::halt(Record* record, const Halt& halt) {
  if (record->is(Kind::kTrajectory)) {
    plan_.forget(record->id());
  }
  record->halt = halt;
  if (record->orders.empty()) {
    close(record->id(), halt.how, halt.reason);
  }
}

void MovementBook::endOrder(Record* record, OrderNumber order, EndedHow how, std::string reason) {
  record->orders.erase(order);
  const bool has_failed = how == EndedHow::kRefused || how == EndedHow::kNotReached || how == EndedHow::kFell;
  const bool is_trajectory = record->is(Kind::kTrajectory);
  if (!record->orders.empty() || (is_trajectory && !record->halt && plan_.goesOnAfter(record->id(), how))) {
    record->trouble = has_failed ? reason : record->trouble;
    return;
  }
  const bool has_more_to_do = is_trajectory || record->is(Kind::kWalk);
  if (record->halt) {
    if (!record->halt->reason.empty() && (how == EndedHow::kStopped || (has_more_to_do && !has_failed))) {
      how = record->halt->how;
      reason = record->halt->reason;
      record->trouble.clear();
    }
  } else if (record->steered && how == EndedHow::kDone) {
    how = EndedHow::kStopped;
    reason = "no velocity came to the robot for 0.5 s";
  }
  close(record->id(), how, withTrouble(*record, how, reason));
}

void MovementBook::close(MovementId id, EndedHow how, const std::string& reason) {
  Record* const record = find(id);
  if (record == nullptr) {
    return;
  }
  EndedMovement ended = endOf(whole(*record), how, reason);
  ended.movement.end.reset();
  const bool may_be_on_its_way = how == EndedHow::kDone || how == EndedHow::kUnknown;
  if (record->is(Kind::kTrajectory) || !may_be_on_its_way) {
    plan_.forget(id);
  }
  record->promise.set_value(ended);
  records_.remove_if([id](const Record& each) { return each.id() == id; });
  note(ended);
}

void MovementBook::closeAll(EndedHow how, const std::string& reason) {
  for (const MovementId id : idsOf([](const Record&) { return true; })) {
    close(id, how, reason);
  }
}

void MovementBook::takeEndsOfPlan() {
  for (const JointPlan::End& end : plan_.takeEnded()) {
    Record* const record = find(end.id);
    if (record == nullptr) {
      continue;
    }
    if (end.how == EndedHow::kReplaced) {
      halt(record, {end.how, end.reason});
    } else {
      close(end.id, end.how, withTrouble(*record, end.how, end.reason));
    }
  }
}

MovementBook::Record* MovementBook::find(MovementId id) {
  return findIf([id](const Record& each) { return each.id() == id; });
}

MovementBook::Record* MovementBook::ownerOf(OrderNumber order) {
  return findIf([order](const Record& each) { return each.orders.count(order) > 0; });
}

MovementBook::Record* MovementBook::findWalk() {
  return findIf([](const Record& each) { return each.is(Kind::kWalk) && !each.halt; });
}

MovementBook::Record* MovementBook::findCommand(const Movement& movement) {
  return findIf([&](const Record& each) {
    return each.movement.kind == movement.kind && each.movement.source == movement.source && !each.halt &&
           each.movement.joints == movement.joints;
  });
}

std::vector<Movement> MovementBook::movements() const {
  std::vector<Movement> movements;
  for (const Record& record : records_) {
    movements.push_back(whole(record));
  }
  return movements;
}

Movement MovementBook::whole(const Record& record) const {
  Movement movement = record.movement;
  std::vector<std::string> joints = plan_.jointsOf(record.id());
  if (!joints.empty()) {
    movement.joints = std::move(joints);
  }
  movement.end = plan_.endOf(record.id());
  return movement;
}

bool MovementBook::isRepeated(const EndedMovement& refused, SteadyTime now) {
  const Movement& movement = refused.movement;
  if (movement.kind != Kind::kCommand && movement.kind != Kind::kLookAt && movement.kind != Kind::kWalk) {
    return false;
  }
  for (auto each = refused_.begin(); each != refused_.end();) {
    each = now - each->second >= kRepeatedWithin ? refused_.erase(each) : std::next(each);
  }
  return !refused_.insert_or_assign({movement.kind, movement.source, movement.joints, refused.reason}, now).second;
}

void MovementBook::note(const EndedMovement& ended) {
  ++ends_;
  ended_.push_back(ended);
  if (ended_.size() > kEndsRemembered) {
    ended_.pop_front();
  }
  news_.push_back(ended);
}

}  // namespace aibo_driver::movement
