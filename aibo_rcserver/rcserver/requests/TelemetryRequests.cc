#include "rcserver/requests/TelemetryRequests.h"

#include "protocol/units.h"

using namespace protocol::version2;

namespace {

// The period in frames of the reports of joints and sensors.
const unsigned short SENSOR_PERIOD = 4;
const unsigned short LONGEST_PERIOD = 65532;

unsigned short WholeSensorPeriods(unsigned short frames) {
  if (frames > LONGEST_PERIOD) {
    return LONGEST_PERIOD;
  }
  return static_cast<unsigned short>((frames + SENSOR_PERIOD - 1) / SENSOR_PERIOD * SENSOR_PERIOD);
}

// In this order, the operations do not overflow, because a duty has 16 bits.
int MillionthsOfFullDuty(int duty) {
  return duty * (1000000 / 64) / (FULL_DUTY / 64);
}

int Millionths(double value) {
  return static_cast<int>(value * 1e6 + (value < 0 ? -0.5 : 0.5));
}

void Add(char group, unsigned char id, int value, Telemetry* telemetry) {
  const TelemetryEntry entry = {group, id, value};
  telemetry->entries[telemetry->count] = entry;
  ++telemetry->count;
}

void AddWalk(Walker& walker, Telemetry* telemetry) {
  const protocol::version2::Velocity velocity = walker.TakeVelocity();
  Add(GROUP_WALK, WALK_FORWARD, Millionths(velocity.forward), telemetry);
  Add(GROUP_WALK, WALK_LEFT, Millionths(velocity.left), telemetry);
  Add(GROUP_WALK, WALK_TURN, Millionths(velocity.turn), telemetry);
  Add(GROUP_WALK, WALK_PHASE, static_cast<int>(walker.Phase() * 1e6), telemetry);
  Add(GROUP_WALK, WALK_STATE, walker.State(), telemetry);
}

}  // namespace

TelemetryRequests::TelemetryRequests(const Robot& robot, Exchange& exchange)
    : robot_(robot), exchange_(exchange), content_(TELEMETRY_PLAIN) {}

void TelemetryRequests::SetPeriod() {
  TelemetryPeriod period;
  if (exchange_.Decode(&period)) {
    period.frames = WholeSensorPeriods(period.frames);
    interval_ = Interval(period.frames);
    content_ = static_cast<unsigned char>(exchange_.Id() & TELEMETRY_WITH_DUTY);
    exchange_.AnswerWithId(content_);
    exchange_.Out().Telemetry().Drop();
    exchange_.Reply(period);
  }
}

void TelemetryRequests::Measured(unsigned frame) {
  if (!interval_.Chooses(frame)) {
    return;
  }
  const JointControl& joints = robot_.joints;
  const SensorDriver& sensors = robot_.sensors;
  Telemetry telemetry;
  telemetry.frame_number = frame;
  telemetry.count = 0;
  for (int i = 0; i < joints.NumberOfJoints(); ++i) {
    Add(GROUP_JOINT, joints.Identifier(i), joints.Position(i), &telemetry);
  }
  for (int i = 0; i < sensors.NumberOfSensors(); ++i) {
    if (sensors.HasValue(i)) {
      const robot_model::Sensor& sensor = sensors.Sensor(i);
      Add(GROUP_SENSOR, sensor.identifier, protocol::version2SensorValue(sensor.kind, sensors.Value(i)), &telemetry);
    }
  }
  const bool with_duty = (content_ & TELEMETRY_WITH_DUTY) != 0;
  for (int i = 0; with_duty && i < joints.NumberOfJoints(); ++i) {
    Add(GROUP_DUTY, joints.Identifier(i), MillionthsOfFullDuty(joints.Duty(i)), &telemetry);
  }
  if (robot_.joints.Walking().CanWalk()) {
    AddWalk(robot_.joints.Walking(), &telemetry);
  }
  const size_t size = exchange_.Complete(TELEMETRY_PUSH, 0, 0, encode(telemetry, exchange_.Payload()));
  exchange_.Out().Telemetry().Set(exchange_.Message(), size);
}
