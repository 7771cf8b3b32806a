#include "order_audit.h"

#include <aibo_driver/EndedMovement.h>
#include <aibo_driver/Movement.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <sstream>

namespace soak {
namespace {

using aibo_driver::EndedMovement;
using aibo_driver::Movement;

// The contract.
constexpr double kStopsWithin = 0.3;     // s
constexpr double kArrivedWithin = 0.05;  // rad

constexpr double kStill = 0.02;         // rad; for the steps of encoders and rounding
constexpr double kMeasuredOften = 0.2;  // s; a longer gap hides what happened in it
constexpr double kAbout = 0.25;         // s, from an end to a measurement
constexpr double kSameTarget = 2e-6;    // rad; the wire has whole microradians

std::string text(double number) {
  std::ostringstream text;
  text.precision(3);
  text << std::fixed << number;
  return text.str();
}

std::string clock(double time) {
  return "at " + text(std::fmod(time, 3600.0)) + " s of the hour: ";
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
  const std::map<int, std::string> names = {{Movement::COMMAND, "command"}, {Movement::TRAJECTORY, "trajectory"},
                                            {Movement::MOTION, "motion"},   {Movement::WALK, "walk"},
                                            {Movement::POSTURE, "posture"}, {Movement::LOOK_AT, "look at"}};
  const auto found = names.find(kind);
  return found == names.end() ? "kind " + std::to_string(kind) : found->second;
}

/// Whether this may be the end of that order. Some of its joints may have been replaced before.
bool canBeTheEndOf(const Order& order, const Ended& end) {
  constexpr double kLongest = 30;  // s; of any way
  const int kind = order.kind == "command" ? Movement::COMMAND : Movement::TRAJECTORY;
  const auto& joints = end.movement.joints;
  const auto is_sent = [&order](const std::string& joint) { return order.targets.count(joint) > 0; };
  return end.movement.user == order.user && end.movement.kind == kind && end.time >= order.time &&
         end.time <= order.time + order.duration + kLongest && std::all_of(joints.begin(), joints.end(), is_sent);
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
  return std::any_of(round.faults.begin(), round.faults.end(), [&](const Fault& fault) {
    const auto is_in_it = [&fault](const Order& each) {
      return fault.kind == Fault::Kind::kDriverFrozen && each.kind == "command" && each.time > fault.begin &&
             each.time < fault.end;
    };
    return is_in_it(order) && std::count_if(round.orders.begin(), round.orders.end(), is_in_it) > kQueue;
  });
}

/// If a node commands the same joints again, or those that are left, the same movement goes on; and of orders that are
/// refused again and again, only the first one is told.
bool isOneWithAnother(const Order& order, const Round& round) {
  constexpr double kGoesOn = 10;
  constexpr double kRepeated = 3;
  return std::any_of(round.orders.begin(), round.orders.end(), [&](const Order& other) {
    const double later = other.time - order.time;
    return &other != &order && other.user == order.user && other.kind == order.kind && isPartOfTheOther(order, other) &&
           later > -kRepeated && later < kGoesOn;
  });
}

}  // namespace

void OrderAudit::judge(const Round& round) {
  ++rounds_;
  orders_ += round.orders.size();
  ends_ += round.ended.size();
  faults_ += round.faults.size();
  calls_ += round.calls.size();
  for (const Call& call : round.calls) {
    if (call.message == kNoAnswer) {
      complain_(clock(call.begin) + call.service + " of " + call.user + " got no answer");
    }
  }
  for (const Moving& movement : round.moving) {
    complain_(movement.user + "'s " + kindOf(movement.kind) + " " + movement.name + " does not end");
  }
  judgeStops(round);
  judgeEnds(round);
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
    return;  // the robot was told to rest meanwhile, or nothing was measured
  }
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
    for (const Sent& sent : round.sent) {
      const auto target = order.targets.find(sent.joint);
      if (target != order.targets.end() && std::abs(clamp(sent.joint, target->second) - sent.target) < kSameTarget) {
        complain_(clock(sent.time) + "a target of " + sent.joint + " by " + order.user +
                  " went to the robot during the " + "stop of " + stop.user);
      }
    }
  }
}

void OrderAudit::judgeEnds(const Round& round) {
  const Matching matching(
      round, [&round](const Order& order) { return !isOneWithAnother(order, round) && !mayBeUnread(order, round); });
  for (std::size_t i = 0; i < round.orders.size(); ++i) {
    const Order& order = round.orders[i];
    if (matching.hasEnd(i)) {
      continue;
    }
    if (!isOneWithAnother(order, round) && !mayBeUnread(order, round)) {
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
      complain_(clock(end.time) + "a " + kindOf(end.movement.kind) + " of " + end.movement.user + " has ended (" +
                end.reason + "), but nobody gave it");
    }
    if (end.how == EndedMovement::DONE) {
      judgeDone(round, end);
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
      if (std::abs(each.time - end.time) < kAbout) {
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

double OrderAudit::clamp(const std::string& joint, double target) const {
  const auto found = limits_.find(joint);
  return found == limits_.end() ? target : std::clamp(target, found->second.first, found->second.second);
}

void OrderAudit::report() const {
  const auto print = [](const char* title, const std::vector<double>& values) {
    std::printf("%-44s %8zu  median %.3f  99%% %.3f  most %.3f\n", title, values.size(), quantile(values, 0.5),
                quantile(values, 0.99), quantile(values, 1));
  };
  std::printf("\n%zu rounds, %zu faults, %zu commands and trajectories, %zu ends, %zu calls and goals\n", rounds_,
              faults_, orders_, ends_, calls_);
  print("way of the joints after a stop, rad", moved_in_stops_);
  print("way of a joint that is done to its target, rad", missed_);
}

}  // namespace soak
