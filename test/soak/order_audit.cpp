#include "order_audit.h"

#include <aibo_driver/Movement.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <sstream>

namespace soak {
namespace {

using aibo_driver::Movement;

// The contract.
constexpr double kStopsWithin = 0.3;  // s
constexpr double kTooOld = 0.5;       // s

constexpr double kOnTheWay = 0.3;       // s; from a user to the driver, also when this computer is busy
constexpr double kStill = 0.02;         // rad; for the steps of encoders and rounding
constexpr double kMeasuredOften = 0.2;  // s; a longer gap hides what happened in it
constexpr double kSameTarget = 2e-6;    // rad; the wire has whole microradians

std::string text(double number) {
  std::ostringstream text;
  text.precision(3);
  text << std::fixed << number;
  return text.str();
}

std::string clock(double time) {
  return "at " + hourClock(time) + ": ";
}

std::string kindOf(int kind) {
  const std::map<int, std::string> names = {{Movement::COMMAND, "command"}, {Movement::TRAJECTORY, "trajectory"},
                                            {Movement::MOTION, "motion"},   {Movement::WALK, "walk"},
                                            {Movement::POSTURE, "posture"}, {Movement::LOOK_AT, "look at"}};
  const auto found = names.find(kind);
  return found == names.end() ? "kind " + std::to_string(kind) : found->second;
}

std::string wordsOf(const Moving& movement) {
  return movement.user + "'s " + kindOf(movement.kind) + " " + std::to_string(movement.order) +
         (movement.name.empty() ? "" : " (" + movement.name + ")");
}

}  // namespace

std::string hourClock(double time) {
  return text(std::fmod(time, 3600.0)) + " s of the hour";
}

void OrderAudit::judge(const Round& round) {
  for (const Call& call : round.calls) {
    if (call.message == kNoAnswer) {
      complain_(clock(call.begin) + call.service + " of " + call.user + " got no answer");
    } else if (call.service == "stop" && call.success) {
      judgeStop(round, call);
    }
  }
  judgeEnds(round);
  judgeAge(round);
}

void OrderAudit::judgeEnds(const Round& round) {
  std::set<std::uint64_t> ended;
  for (const Moving& movement : round.ended) {
    if (!ended.insert(movement.order).second) {
      complain_(wordsOf(movement) + " has ended twice");
    }
  }
  for (const Moving& movement : round.moving) {
    complain_(wordsOf(movement) + " does not end");
    ended.insert(movement.order);
  }
  for (const auto& [order, movement] : round.begun) {
    if (ended.count(order) == 0) {
      complain_(wordsOf(movement) + " has gone without an end");
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
  ++stops_;
  for (const auto& [joint, way] : moved) {
    if (way > kStill) {
      complain_(clock(begin) + joint + " moved by " + text(way) + " rad after the stop of " + stop.user);
    }
  }
  for (const Accepted& accepted : round.accepted) {
    if (accepted.time > begin && accepted.time < end) {
      complain_(clock(accepted.time) + "the robot accepted a target of " + accepted.joint + " during the stop of " +
                stop.user);
    }
  }
}

// No two commands send a joint to the same target. A trajectory may pass through one target of a command, but not
// through all of them at once.
void OrderAudit::judgeAge(const Round& round) {
  for (const Order& order : round.orders) {
    std::map<double, std::size_t> found;  // how many of the targets, by time
    for (const Accepted& accepted : round.accepted) {
      const auto target = order.targets.find(accepted.joint);
      if (target != order.targets.end() && std::abs(target->second - accepted.target) < kSameTarget) {
        ++found[accepted.time];
      }
    }
    for (const auto& [time, targets] : found) {
      const double age = time - order.time;
      commands_ += targets == order.targets.size() ? 1 : 0;
      if (targets == order.targets.size() && age > kTooOld + kOnTheWay) {
        complain_(clock(time) + "the robot accepted a command of " + order.user + " that was " + text(age) + " s old");
      }
    }
  }
}

}  // namespace soak
