#include "client/telemetry_intake.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "client/picture_intake.h"

namespace aibo_driver {
namespace {

constexpr std::chrono::milliseconds kFrame{8};  // of OPEN-R
constexpr int kShortestPeriod = 4;              // frames; a server rounds shorter ones up (docs/protocol.md)

std::string inShort(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.6g", value);
  return text;
}

std::string describe(const std::string& name, double value, const ValueRange& possible) {
  return name + " is " + inShort(value) + "; possible is " + inShort(possible.lowest) + " to " +
         inShort(possible.highest);
}

}  // namespace

void TelemetryIntake::askedFor(int period) {
  shortest_period_ = period == 0 ? RateLimit::Duration::zero() : std::max(period, kShortestPeriod) * kFrame / 2;
}

void TelemetryIntake::deliver(Telemetry telemetry, const std::string& design) {
  if (comesTooOften(telemetry)) {
    return;
  }
  const std::uint64_t impossible_before = context_.counters.impossible_values;
  dropImpossible(&telemetry, design);
  const bool dropped = context_.counters.impossible_values != impossible_before;
  if (dropped && telemetry.joints.empty() && telemetry.sensors.empty()) {
    return;
  }
  telemetry.connection_number = context_.number;
  ++context_.counters.telemetry;
  context_.notifier.telemetry(telemetry);
}

bool TelemetryIntake::comesTooOften(const Telemetry& telemetry) {
  if (!shortest_period_ || limit_.admit(telemetry.arrival, *shortest_period_).is_admitted) {
    return false;
  }
  ++context_.counters.thinned_telemetry;
  if (!std::exchange(thinning_is_logged_, true)) {
    context_.warn("sends measurements more than twice as often as it was asked to; the rest is dropped and counted");
  }
  return true;
}

void TelemetryIntake::dropImpossible(Telemetry* telemetry, const std::string& design) {
  std::vector<JointReading> joints;
  for (JointReading& joint : telemetry->joints) {
    if (isPossible(joint, *telemetry, design)) {
      checkDuty(&joint, design);
      places_[joint.id] = {joint.position, telemetry->frame_number, telemetry->arrival};
      joints.push_back(joint);
    }
  }
  telemetry->joints = std::move(joints);
  std::vector<SensorReading>& sensors = telemetry->sensors;
  sensors.erase(std::remove_if(sensors.begin(), sensors.end(),
                               [&](const SensorReading& sensor) { return !isPossible(sensor, design); }),
                sensors.end());
  if (telemetry->walk && !isPossible(*telemetry->walk)) {
    telemetry->walk.reset();
  }
}

bool TelemetryIntake::isPossible(const JointReading& joint, const Telemetry& telemetry, const std::string& design) {
  const ValueRange range = possiblePositions(design, joint.id);
  if (!range.contains(joint.position)) {
    return complain(Part::kJoint, joint.id,
                    describe("the position of " + nameOfJoint(design, joint.id), joint.position, range));
  }
  const auto last = places_.find(joint.id);
  if (last == places_.end()) {
    return true;
  }
  const Place& place = last->second;
  if (place.arrival == telemetry.arrival && place.frame_number == telemetry.frame_number) {
    return complain(Part::kJoint, joint.id, nameOfJoint(design, joint.id) + " is there twice");
  }
  double seconds = secondsBetween(place.frame_number, place.arrival, telemetry);
  if (seconds == 0) {  // a frame number that stands still must not hold up the joint for ever
    seconds = secondsBetween(std::nullopt, place.arrival, telemetry);
  }
  const double move = std::abs(joint.position - place.position);
  return move <= longestMove(design, joint.id, seconds) ||
         complain(Part::kJoint, joint.id,
                  nameOfJoint(design, joint.id) + " moved by " + inShort(move) + " rad within " + inShort(seconds) +
                      " s, faster than it can");
}

bool TelemetryIntake::isPossible(const SensorReading& sensor, const std::string& design) {
  const ValueRange range = possibleReadings(design, sensor.id);
  return range.contains(sensor.value) ||
         complain(Part::kSensor, sensor.id, describe(nameOfSensor(design, sensor.id), sensor.value, range));
}

bool TelemetryIntake::isPossible(const WalkReading& walk) {
  const auto is_possible = [this](const char* name, double value, const ValueRange& range) {
    return range.contains(value) ||
           complain(Part::kWalk, 0, describe(std::string("the velocity of the walk ") + name, value, range));
  };
  return is_possible("forward", walk.velocity.forward, kPossibleWalks) &&
         is_possible("to the left", walk.velocity.left, kPossibleWalks) &&
         is_possible("around itself", walk.velocity.turn, kPossibleTurns);
}

void TelemetryIntake::checkDuty(JointReading* joint, const std::string& design) {
  if (joint->duty && !kPossibleDuties.contains(*joint->duty)) {
    complain(Part::kDuty, joint->id,
             describe("the duty of " + nameOfJoint(design, joint->id), *joint->duty, kPossibleDuties));
    joint->duty.reset();
  }
}

/// @return false
bool TelemetryIntake::complain(Part part, int id, const std::string& problem) {
  ++context_.counters.impossible_values;
  if (logged_.insert({part, id}).second) {
    context_.warn("sent an impossible value, which is dropped: " + problem);
  }
  return false;
}

}  // namespace aibo_driver
