#include "client/telemetry_intake.h"

#include <algorithm>
#include <cstdio>
#include <vector>

#include "aibo_client/names.h"
#include "client/picture_intake.h"
#include "robot_model/robot_model.h"

namespace aibo_client {
namespace {

constexpr int kShortestPeriod = 4;  // frames; a server rounds shorter periods up (docs/protocol.md)

std::string inShort(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.6g", value);
  return text;
}

std::string describe(const std::string& name, double value, const ValueRange& possible) {
  return name + " is " + inShort(value) + "; it can be " + inShort(possible.lowest) + " to " +
         inShort(possible.highest);
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
  if (!std::exchange(thinning_is_logged_, true)) {
    context_.warn("sends measurements more than twice as often as it was asked to; the rest is dropped and counted");
  }
  return true;
}

void TelemetryIntake::dropImpossible(Telemetry* telemetry, const std::string& design) {
  std::vector<JointReading> joints;
  for (JointReading& joint : telemetry->joints) {
    if (isPossible(joint, joints, design)) {
      checkDuty(&joint, design);
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

bool TelemetryIntake::isPossible(const JointReading& joint, const std::vector<JointReading>& before,
                                 const std::string& design) {
  const ValueRange range = possiblePositions(design, joint.id);
  if (!range.contains(joint.position)) {
    return complain(Part::kJoint, joint.id,
                    describe("the position of " + nameOfJoint(joint.id, design), joint.position, range));
  }
  const bool is_there =
      std::any_of(before.begin(), before.end(), [&joint](const JointReading& each) { return each.id == joint.id; });
  return !is_there || complain(Part::kJoint, joint.id, nameOfJoint(joint.id, design) + " appears twice");
}

bool TelemetryIntake::isPossible(const SensorReading& sensor, const std::string& design) {
  const ValueRange range = possibleReadings(design, sensor.id);
  return range.contains(sensor.value) ||
         complain(Part::kSensor, sensor.id, describe(nameOfSensor(sensor.id, design), sensor.value, range));
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
             describe("the duty of " + nameOfJoint(joint->id, design), *joint->duty, kPossibleDuties));
    joint->duty.reset();
  }
}

/// @return always false
bool TelemetryIntake::complain(Part part, int id, const std::string& problem) {
  ++context_.counters.impossible_values;
  if (logged_.insert({part, id}).second) {
    context_.warn("sent an impossible value, which is dropped: " + problem);
  }
  return false;
}

}  // namespace aibo_client
