#include "order_audit.h"

#include <aibo_driver/EndedMovement.h>
#include <aibo_driver/Movement.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <set>
#include <sstream>

namespace soak {
namespace {

using aibo_driver::EndedMovement;
using aibo_driver::Movement;

// The contract.
constexpr double kStopsWithin = 0.3;     // s
constexpr double kOldest = 0.5;          // s
constexpr double kArrivedWithin = 0.05;  // rad

constexpr double kStill = 0.02;         // rad; for the steps of encoders and rounding
constexpr double kMeasuredOften = 0.2;  // s; a longer gap hides what happened in it
constexpr double kBusy = 0.25;          // s, by which this computer may hold up a process
constexpr double kSameTarget = 2e-6;    // rad; the wire has whole microradians

// Two joints never have the same target by accident; users draw anew.
std::string place(const std::string& joint, double target) {
  return joint + " at " + std::to_string(std::lround(1e6 * target));
}

std::string text(double number) {
  std::ostringstream text;
  text.precision(3);
  text << std::fixed << number;
  return text.str();
}

std::string clock(double time) {
  return "at " + text(std::fmod(time, 3600.0)) + " s of the hour: ";
}

/// The length of time in which this kind of fault overlaps.
double overlap(const Round& round, Fault::Kind kind, double begin, double end) {
  double sum = 0;
  for (const Fault& fault : round.faults) {
    if (fault.kind == kind) {
      sum += std::max(0.0, std::min(end, fault.end) - std::max(begin, fault.begin));
    }
  }
  return sum;
}

double quantile(std::vector<double> values, double part) {
  if (values.empty()) {
    return 0;
  }
  std::sort(values.begin(), values.end());
  const auto index = static_cast<std::size_t>(part * static_cast<double>(values.size()));
  return values[std::min(index, values.size() - 1)];
}

std::string kindOf(int kind) {
  switch (kind) {
    case Movement::COMMAND:
      return "command";
    case Movement::TRAJECTORY:
      return "trajectory";
    case Movement::MOTION:
      return "motion";
    case Movement::WALK:
      return "walk";
    case Movement::POSTURE:
      return "posture";
    case Movement::LOOK_AT:
      return "look at";
    default:
      return "kind " + std::to_string(kind);
  }
}

const char* howIt(int how) {
  switch (how) {
    case EndedMovement::DONE:
      return "done";
    case EndedMovement::REPLACED:
      return "replaced";
    case EndedMovement::STOPPED:
      return "stopped";
    case EndedMovement::REFUSED:
      return "refused";
    case EndedMovement::FELL:
      return "fell";
    case EndedMovement::UNKNOWN:
      return "unknown";
    case EndedMovement::NOT_REACHED:
      return "not reached";
    case EndedMovement::LOST:
      return "lost";
    default:
      return "in no known way";
  }
}

bool isLeg(const std::string& joint) {
  return joint.rfind("left_", 0) == 0 || joint.rfind("right_", 0) == 0;
}

/// Whether this may be the end of that order. Some of its joints may have been replaced before. Commands to one joint
/// each may have become one movement of several.
bool canBeTheEndOf(const Order& order, const Ended& end) {
  constexpr double kLongest = 30;  // s; of any way
  const int kind = order.kind == "command" ? Movement::COMMAND : Movement::TRAJECTORY;
  const auto& joints = end.movement.joints;
  const auto is_sent = [&order](const std::string& joint) { return order.targets.count(joint) > 0; };
  const bool is_of_one_joint = order.kind == "command" && order.targets.size() == 1;
  return end.movement.user == order.user && end.movement.kind == kind && end.time >= order.time &&
         end.time <= order.time + order.duration + kLongest &&
         (is_of_one_joint ? std::any_of(joints.begin(), joints.end(), is_sent)
                          : std::all_of(joints.begin(), joints.end(), is_sent));
}

/// Finds an end for each order, and an order for each end, as far as that is possible: a maximum matching, by paths
/// that augment it. Messages do not say which end belongs to which order. The orders that need one come first, because
/// an order that has an end once keeps one.
class Matching {
 public:
  /// @param needs_end whether an order must have an end of its own
  Matching(const Round& round, const std::function<bool(const Order&)>& needs_end)
      : ends_of_(round.orders.size()), order_of_(round.ended.size(), kNone), has_end_(round.orders.size(), false) {
    for (std::size_t order = 0; order < round.orders.size(); ++order) {
      for (std::size_t end = 0; end < round.ended.size(); ++end) {
        if (canBeTheEndOf(round.orders[order], round.ended[end])) {
          ends_of_[order].push_back(end);
        }
      }
    }
    for (const bool needs : {true, false}) {
      for (std::size_t order = 0; order < round.orders.size(); ++order) {
        if (needs_end(round.orders[order]) == needs) {
          std::vector<bool> is_seen(round.ended.size(), false);
          has_end_[order] = findEnd(order, &is_seen);
        }
      }
    }
  }

  bool hasEnd(std::size_t order) const { return has_end_[order]; }
  bool hasOrder(std::size_t end) const { return order_of_[end] != kNone; }

 private:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();

  // Another order gives up its end if it finds a different one.
  bool findEnd(std::size_t order, std::vector<bool>* is_seen) {
    for (const std::size_t end : ends_of_[order]) {
      if ((*is_seen)[end]) {
        continue;
      }
      (*is_seen)[end] = true;
      if (order_of_[end] == kNone || findEnd(order_of_[end], is_seen)) {
        order_of_[end] = order;
        return true;
      }
    }
    return false;
  }

  std::vector<std::vector<std::size_t>> ends_of_;
  std::vector<std::size_t> order_of_;
  std::vector<bool> has_end_;
};

/// Whether one of them commands all joints of the other.
bool isPartOfTheOther(const Order& a, const Order& b) {
  const auto has_joints_of = [](const Order& all, const Order& part) {
    return std::all_of(part.targets.begin(), part.targets.end(),
                       [&all](const auto& target) { return all.targets.count(target.first) > 0; });
  };
  return has_joints_of(a, b) || has_joints_of(b, a);
}

/// roscpp keeps the newest ten messages of joint_command for a process that is held up; the driver never gets the
/// others.
bool mayBeUnread(const Order& order, const Round& round) {
  constexpr auto kQueue = 10;
  constexpr auto kPointsToLookAt = 2;  // are commands, too, but not in the log
  return std::any_of(round.faults.begin(), round.faults.end(), [&](const Fault& fault) {
    const auto is_in_it = [&fault](const Order& each) {
      return fault.kind == Fault::Kind::kDriverFrozen && each.kind == "command" && each.time > fault.begin &&
             each.time < fault.end;
    };
    return is_in_it(order) &&
           std::count_if(round.orders.begin(), round.orders.end(), is_in_it) + kPointsToLookAt > kQueue;
  });
}

/// Whether it plays a motion or takes a posture.
bool isMovedByTheRobotItself(const Round& round, double begin, double end) {
  for (std::size_t i = 0; i < round.movements.size(); ++i) {
    const double until = i + 1 < round.movements.size() ? round.movements[i + 1].time : end;
    const auto& now = round.movements[i].now;
    if (until > begin && round.movements[i].time < end && std::any_of(now.begin(), now.end(), [](const Moving& each) {
          return each.kind == Movement::MOTION || each.kind == Movement::POSTURE;
        })) {
      return true;
    }
  }
  return false;
}

/// The driver sends commands to one joint each together, if they come together, as after it was held up.
bool areSentTogether(const Order& a, const Order& b, const Round& round) {
  return a.targets.size() == 1 && b.targets.size() == 1 &&
         std::any_of(round.faults.begin(), round.faults.end(), [&](const Fault& fault) {
           const auto is_in_it = [&fault](double time) { return time > fault.begin && time < fault.end; };
           return fault.kind == Fault::Kind::kDriverFrozen && is_in_it(a.time) && is_in_it(b.time);
         });
}

/// If a node commands the same joints again, or those that are left, the same movement goes on; and of orders that are
/// refused again and again, only the first one is told.
bool isOneWithAnother(const Order& order, const Round& round) {
  constexpr double kGoesOn = 10;
  constexpr double kRepeated = 3;
  return std::any_of(round.orders.begin(), round.orders.end(), [&](const Order& other) {
    const double later = other.time - order.time;
    return &other != &order && other.user == order.user && other.kind == order.kind &&
           (isPartOfTheOther(order, other) || areSentTogether(order, other, round)) && later > -kRepeated &&
           later < kGoesOn;
  });
}

}  // namespace

void OrderAudit::judge(const Round& round) {
  ++rounds_;
  for (const Order& order : round.orders) {
    ++orders_[order.kind];
  }
  for (const Call& call : round.calls) {
    ++calls_[call.service];
    done_calls_[call.service] += call.success ? 1 : 0;
    call_times_.push_back(call.end - call.begin);
    if (call.message == kNoAnswer) {
      complain_(clock(call.begin) + call.service + " of " + call.user + " got no answer");
    }
  }
  for (const Fault& fault : round.faults) {
    ++faults_[fault.kind];
  }
  judgeStops(round);
  judgeAges(round);
  judgeEnds(round);
  judgeMoves(round);
  judgeThaws(round);
}

void OrderAudit::judgeStops(const Round& round) {
  for (const Call& call : round.calls) {
    if (call.service == "stop" && call.success) {
      judgeStop(round, call);
    }
  }
}

// From 0.3 s after its answer until somebody calls release, or something that is allowed meanwhile.
void OrderAudit::judgeStop(const Round& round, const Call& stop) {
  const double begin = stop.end + kStopsWithin;
  double end = round.measured.empty() ? begin : round.measured.back().time;
  bool is_clear = true;
  for (const Call& call : round.calls) {
    const bool lets_move = call.service == "release" || call.service == "rest" || call.service == "motors";
    if (lets_move && call.end > stop.begin) {
      is_clear = is_clear && call.begin > stop.end;
      end = std::min(end, std::max(call.begin, stop.end));
    }
  }
  std::map<std::string, double> still;
  std::map<std::string, double> moved;
  double last = -1;
  std::size_t measurements = 0;
  for (const Measured& each : round.measured) {
    if (each.time < begin || each.time > end) {
      continue;
    }
    ++measurements;
    for (const auto& [joint, position] : each.positions) {
      if (each.time - last > kMeasuredOften || still.count(joint) == 0) {
        still[joint] = position;
      }
      moved[joint] = std::max(moved[joint], std::abs(position - still[joint]));
    }
    last = each.time;
  }
  if (!is_clear || measurements < 2) {
    ++unjudged_stops_;
    return;
  }
  ++judged_stops_;
  double most = 0;
  for (const auto& [joint, way] : moved) {
    most = std::max(most, way);
    if (way > kStill) {
      complain_(clock(begin) + joint + " moved by " + text(way) + " rad after the stop of " + stop.user);
    }
  }
  moved_in_stops_.push_back(most);
  for (const Order& order : round.orders) {
    if (order.time < stop.end || order.time > end) {
      continue;
    }
    ++given_in_stops_;
    for (const Sent& sent : round.sent) {
      const auto target = order.targets.find(sent.joint);
      if (target != order.targets.end() && std::abs(clamp(sent.joint, target->second) - sent.target) < kSameTarget) {
        complain_(clock(sent.time) + "a target of " + sent.joint + " by " + order.user +
                  " went to the robot during the " + "stop of " + stop.user);
      }
    }
  }
}

// An order's age counts from its receipt. What is published while the driver's process is held up reaches it later, but
// then it drops what has waited for longer than half a second.
void OrderAudit::judgeAges(const Round& round) {
  std::map<std::string, double> sent;  // when each target went to the robot first
  for (const Sent& each : round.sent) {
    sent.emplace(place(each.joint, each.target), each.time);
  }
  for (const Order& order : round.orders) {
    for (const auto& [joint, target] : order.targets) {
      const auto found = sent.find(place(joint, clamp(joint, target)));
      if (found == sent.end()) {
        continue;
      }
      const double age = found->second - order.time - order.duration;
      const double frozen = overlap(round, Fault::Kind::kDriverFrozen, order.time, found->second);
      ages_.push_back(std::max(0.0, age));
      if (age > kOldest + std::min(frozen, kOldest) + kBusy) {
        complain_(clock(order.time) + "a target of " + joint + " by " + order.user + " went to the robot " + text(age) +
                  " s late");
      }
    }
  }
}

void OrderAudit::judgeEnds(const Round& round) {
  for (const Ended& end : round.ended) {
    ++ends_[kindOf(end.movement.kind) + " " + howIt(end.how)];
  }
  const Matching matching(
      round, [&round](const Order& order) { return !isOneWithAnother(order, round) && !mayBeUnread(order, round); });
  for (std::size_t i = 0; i < round.orders.size(); ++i) {
    const Order& order = round.orders[i];
    if (matching.hasEnd(i)) {
      continue;
    }
    if (isOneWithAnother(order, round)) {
      ++merged_;
    } else if (mayBeUnread(order, round)) {
      ++unread_;
    } else {
      complain_(clock(order.time) + "a " + order.kind + " of " + order.user + " to " + order.targets.begin()->first +
                (order.targets.size() > 1 ? " and others" : "") + " has no end");
    }
  }
  for (std::size_t i = 0; i < round.ended.size(); ++i) {
    const Ended& end = round.ended[i];
    const bool is_order = end.movement.kind == Movement::COMMAND || end.movement.kind == Movement::TRAJECTORY;
    const bool is_a_users = std::any_of(round.orders.begin(), round.orders.end(),
                                        [&end](const Order& order) { return order.user == end.movement.user; });
    if (!is_order || !is_a_users) {
      continue;
    }
    if (!matching.hasOrder(i)) {
      complain_(clock(end.time) + "a " + kindOf(end.movement.kind) + " of " + end.movement.user + " has ended as " +
                howIt(end.how) + " (" + end.reason + "), but nobody gave it");
    }
    if (end.how == EndedMovement::DONE) {
      judgeDone(round, end);
    }
  }
  judgeEndsOfTheRest(round);
}

// Motions, postures and walks, of which a user can have one at a time: what begins ends, and is done once at most.
void OrderAudit::judgeEndsOfTheRest(const Round& round) {
  const auto nameOf = [](const Moving& movement) {
    return movement.user + "'s " + kindOf(movement.kind) + " " + movement.name;
  };
  std::map<std::string, int> begun;
  std::vector<Moving> before;
  for (const Movements& each : round.movements) {
    for (const Moving& movement : each.now) {
      const bool is_new = std::find(before.begin(), before.end(), movement) == before.end();
      begun[nameOf(movement)] += is_new && movement.joints.empty() ? 1 : 0;
    }
    before = each.now;
  }
  for (const Moving& movement : before) {
    complain_(clock(round.movements.back().time) + nameOf(movement) + " does not end");
  }
  std::map<std::string, int> ended;
  std::map<std::string, int> done;
  for (const Ended& end : round.ended) {
    ++ended[nameOf(end.movement)];
    done[nameOf(end.movement)] += end.how == EndedMovement::DONE && end.movement.joints.empty() ? 1 : 0;
  }
  for (const auto& [name, count] : begun) {
    if (ended[name] < count || done[name] > count) {
      complain_(name + " has begun " + std::to_string(count) + " times, ended " + std::to_string(ended[name]) +
                " times, and was done " + std::to_string(done[name]) + " times");
    }
  }
}

// About then, its joints are measured where one of the orders has sent them that this may be the end of.
void OrderAudit::judgeDone(const Round& round, const Ended& end) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Order& order : round.orders) {
    if (!canBeTheEndOf(order, end)) {
      continue;
    }
    for (const Measured& each : round.measured) {
      if (std::abs(each.time - end.time) < kBusy) {
        nearest = std::min(nearest, farthest(each, order, end.movement.joints));
      }
    }
  }
  if (std::isinf(nearest)) {
    return;  // nothing was measured then
  }
  missed_.push_back(nearest);
  if (nearest > kArrivedWithin) {
    complain_(clock(end.time) + "a " + kindOf(end.movement.kind) + " of " + end.movement.user +
              " is done, but one of its joints is " + text(nearest) + " rad from its target");
  }
}

double OrderAudit::farthest(const Measured& measured, const Order& order,
                            const std::vector<std::string>& joints) const {
  double farthest = 0;
  for (const std::string& joint : joints) {
    const auto found = measured.positions.find(joint);
    if (order.targets.count(joint) == 0) {
      continue;  // another order's
    }
    farthest = std::max(farthest, found == measured.positions.end()
                                      ? std::numeric_limits<double>::infinity()
                                      : std::abs(found->second - clamp(joint, order.targets.at(joint))));
  }
  return farthest;
}

bool OrderAudit::isClaimed(const Round& round, const std::string& joint, double begin, double end) const {
  const auto claims = [&joint](const Moving& movement) {
    return movement.kind == Movement::MOTION || movement.kind == Movement::POSTURE ||
           (movement.kind == Movement::WALK && isLeg(joint)) ||
           std::find(movement.joints.begin(), movement.joints.end(), joint) != movement.joints.end();
  };
  for (std::size_t i = 0; i < round.movements.size(); ++i) {
    const double until = i + 1 < round.movements.size() ? round.movements[i + 1].time : end + 1;
    const auto& now = round.movements[i].now;
    if (until > begin && round.movements[i].time < end && std::any_of(now.begin(), now.end(), claims)) {
      return true;
    }
  }
  return false;
}

// Whatever moves is named in motion_state, except for the time in which it brakes.
void OrderAudit::judgeMoves(const Round& round) {
  constexpr double kBrakes = 0.5;
  constexpr double kWay = 2 * kStill;
  std::set<std::string> told;
  for (std::size_t i = 1; i < round.measured.size(); ++i) {
    const Measured& before = round.measured[i - 1];
    const Measured& after = round.measured[i];
    const bool is_known = overlap(round, Fault::Kind::kDriverFrozen, before.time - 1, after.time + 1) == 0 &&
                          overlap(round, Fault::Kind::kLinkCut, before.time - 1, after.time + 2) == 0 &&
                          overlap(round, Fault::Kind::kLinkSlow, before.time - 1, after.time + 1) == 0 &&
                          overlap(round, Fault::Kind::kRobotFrozen, before.time - 1, after.time + 1) == 0;
    if (!is_known || after.time - before.time > kMeasuredOften) {
      continue;
    }
    for (const auto& [joint, position] : after.positions) {
      const auto was = before.positions.find(joint);
      if (was != before.positions.end() && std::abs(position - was->second) > kWay && told.count(joint) == 0 &&
          !isClaimed(round, joint, before.time - kBrakes, after.time + kBrakes)) {
        told.insert(joint);
        complain_(clock(after.time) + joint + " moves, and motion_state does not say why");
      }
    }
  }
}

// What waited for more than half a second in a robot's process that was held up does not move it any more.
void OrderAudit::judgeThaws(const Round& round) {
  constexpr double kSoon = 3;  // s; long enough for most ways
  for (const Fault& fault : round.faults) {
    if (fault.kind != Fault::Kind::kRobotFrozen) {
      continue;
    }
    for (const Sent& old : round.sent) {
      const bool waited = old.time > fault.begin && old.time < fault.end - kOldest - kBusy;
      const bool was_renewed = std::any_of(round.sent.begin(), round.sent.end(), [&](const Sent& other) {
        return other.joint == old.joint && other.time > old.time && other.time < fault.end + kSoon;
      });
      // Only what nothing else moves through that place by chance.
      const bool is_clear = !isLeg(old.joint) && !isMovedByTheRobotItself(round, fault.begin - 1, fault.end + kSoon);
      if (!waited || was_renewed || !is_clear) {
        continue;
      }
      ++thawed_;
      double at_first = std::numeric_limits<double>::quiet_NaN();
      for (const Measured& each : round.measured) {
        const auto found = each.positions.find(old.joint);
        if (found == each.positions.end() || each.time < fault.begin - 1 || each.time > fault.end + kSoon) {
          continue;
        }
        at_first = std::isnan(at_first) ? found->second : at_first;
        if (std::abs(at_first - old.target) > 3 * kArrivedWithin &&
            std::abs(found->second - old.target) < kArrivedWithin) {
          complain_(clock(each.time) + old.joint + " went where it was sent " + text(each.time - old.time) +
                    " s before, while the robot's process was held up");
          break;
        }
      }
    }
  }
}

double OrderAudit::clamp(const std::string& joint, double target) const {
  const auto found = limits_.find(joint);
  return found == limits_.end() ? target : std::clamp(target, found->second.first, found->second.second);
}

void OrderAudit::report() const {
  const auto printAll = [](const char* title, const std::map<std::string, std::size_t>& counts) {
    std::printf("%s:", title);
    for (const auto& [name, count] : counts) {
      std::printf(" %s %zu,", name.c_str(), count);
    }
    std::printf("\n");
  };
  const auto printValues = [](const char* title, const std::vector<double>& values) {
    std::printf("%-44s %8zu  median %.3f  99%% %.3f  most %.3f\n", title, values.size(), quantile(values, 0.5),
                quantile(values, 0.99), quantile(values, 1));
  };
  std::printf("\n%zu rounds\n", rounds_);
  printAll("orders", orders_);
  printAll("calls", calls_);
  printAll("calls that succeeded", done_calls_);
  printAll("ends", ends_);
  const char* const names[] = {"driver frozen", "robot frozen", "link cut", "link slow", "memory stick slow"};
  std::printf("faults:");
  for (const auto& [kind, count] : faults_) {
    std::printf(" %s %zu,", names[static_cast<std::size_t>(kind)], count);
  }
  std::printf(
      "\nstops judged %zu, not judged (rest, motors or no measurement meanwhile) %zu; orders given in them %zu\n",
      judged_stops_, unjudged_stops_, given_in_stops_);
  std::printf("orders that went on with another one of the same node to the same joints: %zu\n", merged_);
  std::printf("commands that roscpp may have dropped while the driver was held up: %zu\n", unread_);
  std::printf("commands that waited for a robot that was held up, and whose effect could be seen: %zu\n", thawed_);
  printValues("way of the joints after a stop, rad", moved_in_stops_);
  printValues("age of a target when it leaves, s", ages_);
  printValues("way of a joint that is done to its target, rad", missed_);
  printValues("time of a service call, s", call_times_);
  std::fflush(stdout);
}

}  // namespace soak
