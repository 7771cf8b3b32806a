#include "client/telemetry_intake.h"

#include <algorithm>
#include <cstdio>
#include <utility>
#include <vector>

#include "aibo_client/names.h"
#include "robot_model/robot_model.h"

namespace aibo_client {
namespace {

constexpr int kShortestPeriod = 4;  // frames; a server rounds shorter periods up (docs/protocol.md)

std::string inShort(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.6g", value);
  return text;
}

}  // namespace

void TelemetryIntake::askedFor(int period) {
  shortest_period_ =
      period == 0 ? aibo_system::RateLimit::Duration::zero()
                  : std::max(period, kShortestPeriod) * std::chrono::milliseconds(robot_model::FRAME_MILLISECONDS) / 2;
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
  context_.notifier.tell(&Callbacks::on_telemetry, "on_telemetry", telemetry);
}

bool TelemetryIntake::comesTooOften(const Telemetry& telemetry) {
  if (!shortest_period_ || limit_.admit(telemetry.arrival, *shortest_period_).is_admitted) {
    return false;
  }
  ++context_.counters.thinned_telemetry;
  context_.warnOnce("measurements",
                    "sends measurements more than twice as often as it was asked to; the rest is dropped and counted");
  return true;
}

void TelemetryIntake::dropImpossible(Telemetry* telemetry, const std::string& design) {
  std::vector<JointReading> joints;
  for (JointReading joint : telemetry->joints) {
    const auto name = [&](const char* of) { return of + nameOfJoint(joint.id, design); };
    const bool is_there =
        std::any_of(joints.begin(), joints.end(), [&joint](const JointReading& each) { return each.id == joint.id; });
    if (is_there) {
      complain(name(""), "appears twice");
    } else if (isPossible(joint.position, possiblePositions(design, joint.id),
                          [&] { return name("the position of "); })) {
      if (joint.duty && !isPossible(*joint.duty, kPossibleDuties, [&] { return name("the duty of "); })) {
        joint.duty.reset();
      }
      joints.push_back(joint);
    }
  }
  telemetry->joints = std::move(joints);
  const auto is_impossible = [&](const SensorReading& sensor) {
    return !isPossible(sensor.value, possibleReadings(design, sensor.id),
                       [&] { return nameOfSensor(sensor.id, design); });
  };
  std::vector<SensorReading>& sensors = telemetry->sensors;
  sensors.erase(std::remove_if(sensors.begin(), sensors.end(), is_impossible), sensors.end());
  if (telemetry->walk && !isPossible(telemetry->walk->velocity)) {
    telemetry->walk.reset();
  }
}

bool TelemetryIntake::isPossible(const WalkVelocity& velocity) {
  return isPossible(velocity.forward, kPossibleWalks, [] { return "the velocity of the walk forward"; }) &&
         isPossible(velocity.left, kPossibleWalks, [] { return "the velocity of the walk to the left"; }) &&
         isPossible(velocity.turn, kPossibleTurns, [] { return "the velocity of the walk around itself"; });
}

/// @param name gives the name of what has this value
template <typename Name>
bool TelemetryIntake::isPossible(double value, const ValueRange& range, const Name& name) {
  const bool is_possible = range.contains(value);
  if (!is_possible) {
    complain(name(), "is " + inShort(value) + "; it can be " + inShort(range.lowest) + " to " + inShort(range.highest));
  }
  return is_possible;
}

void TelemetryIntake::complain(const std::string& name, const std::string& problem) {
  ++context_.counters.impossible_values;
  context_.warnOnce(name, "sent an impossible value, which is dropped: " + name + " " + problem);
}

}  // namespace aibo_client
