#include "client/telemetry_intake.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <utility>
#include <vector>

#include "aibo_client/names.h"
#include "client/units.h"
#include "robot_model/robot_model.h"

namespace aibo_client {
namespace {

constexpr int kShortestPeriod = 4;  // frames; a server rounds shorter periods up (docs/protocol.md)

/// The range of values that a robot's joint or sensor can have, both ends included, with room for noise. No working
/// robot sends any other value. How much further than the tables of robot_model.h a measurement can be and still be
/// right is our choice.
struct ValueRange {
  double lowest;
  double highest;
};

constexpr double kPositionMargin = 0.2;          // rad, 11 degrees: potentiometers may be a bit off
constexpr double kTwoTurns = 4 * 3.1416;         // rad: for a joint that is not in the tables
constexpr ValueRange kPossibleDuties = {-1, 1};  // shares of full power

// A foot moves at 0.7 m/s at most, because a leg is 0.14 m long and turns at the highest speed of its joints. When the
// robot turns, a foot moves around a circle of 0.1 m.
constexpr ValueRange kPossibleWalks = {-1, 1};    // m/s
constexpr ValueRange kPossibleTurns = {-10, 10};  // rad/s

/// The range in which a joint can be moved by hand, and a margin, in rad.
ValueRange possiblePositions(const std::string& design, int id) {
  const robot_model::RobotModel* const model = robot_model::findRobotModel(design.c_str());
  const int index = model == nullptr ? robot_model::NO_JOINT : robot_model::findJointByIdentifier(*model, id);
  if (index == robot_model::NO_JOINT) {
    return {-kTwoTurns, kTwoTurns};
  }
  const robot_model::Joint& joint = model->joints[index];
  return {fromMicro(joint.mechanical_lowest) - kPositionMargin, fromMicro(joint.mechanical_highest) + kPositionMargin};
}

/// In the units of SensorReading. If the sensor is not in the tables, every value is possible.
ValueRange possibleReadings(const std::string& design, int id) {
  const robot_model::RobotModel* const model = robot_model::findRobotModel(design.c_str());
  const int index = model == nullptr ? robot_model::NO_SENSOR : robot_model::findSensorByIdentifier(*model, id);
  if (index == robot_model::NO_SENSOR) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    return {-kInfinity, kInfinity};
  }
  const robot_model::Sensor& sensor = model->sensors[index];
  switch (sensor.kind) {
    case robot_model::SENSOR_TEMPERATURE:
      return {-40, 125};
    case robot_model::SENSOR_CHARGE:
      return {0, 1.05};
    case robot_model::SENSOR_TOUCH:
      return {0, 10.0 * sensor.highest};
    case robot_model::SENSOR_SWITCH:
      return {0, 1};
    default:  // in millionths of an SI unit
      return {std::min(0.0, 2 * fromMicro(sensor.lowest)), 2 * fromMicro(sensor.highest)};
  }
}

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
  std::vector<SensorReading>& sensors = telemetry->sensors;
  const auto is_impossible = [&](const SensorReading& sensor) {
    return !isPossible(sensor.value, possibleReadings(design, sensor.id),
                       [&] { return nameOfSensor(sensor.id, design); });
  };
  sensors.erase(std::remove_if(sensors.begin(), sensors.end(), is_impossible), sensors.end());
  if (telemetry->walk) {
    const WalkVelocity& walk = telemetry->walk->velocity;
    if (!isPossible(walk.forward, kPossibleWalks, [] { return "the velocity of the walk forward"; }) ||
        !isPossible(walk.left, kPossibleWalks, [] { return "the velocity of the walk to the left"; }) ||
        !isPossible(walk.turn, kPossibleTurns, [] { return "the turning velocity of the walk"; })) {
      telemetry->walk.reset();
    }
  }
}

/// @param name gives the name of what has this value
template <typename Range, typename Name>
bool TelemetryIntake::isPossible(double value, const Range& range, const Name& name) {
  const bool is_possible = range.lowest <= value && value <= range.highest;
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
