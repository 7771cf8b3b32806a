#include "rcserver/version2/Version2Telemetry.h"

#include "protocol/units.h"

using namespace protocol::version2;

namespace {

// Joints and sensors report every 4 frames.
const unsigned short SENSOR_PERIOD = 4;
const unsigned short LONGEST_PERIOD = 65532;

unsigned short WholeSensorPeriods(unsigned short frames) {
  if (frames > LONGEST_PERIOD) {
    return LONGEST_PERIOD;
  }
  return static_cast<unsigned short>((frames + SENSOR_PERIOD - 1) / SENSOR_PERIOD * SENSOR_PERIOD);
}

}  // namespace

Version2Telemetry::Version2Telemetry(const JointControl& joints, const Sensors& sensors, Version2Replies& replies)
    : joints_(joints), sensors_(sensors), replies_(replies) {
  Begin();
}

void Version2Telemetry::Begin() {
  period_ = 0;
  has_pushed_ = false;
  last_ = 0;
}

void Version2Telemetry::SetPeriod(const Request& request, const unsigned char* payload) {
  unsigned short frames = 0;
  if (const char* problem = decodeTelemetryPeriod(payload, request.payload_size, &frames)) {
    replies_.RefuseBadRequest(request, problem);
    return;
  }
  period_ = WholeSensorPeriods(frames);
  has_pushed_ = false;
  replies_.DropTelemetry();
  replies_.Reply(request, encodeTelemetryPeriod(period_, replies_.Payload()));
}

void Version2Telemetry::Measured(unsigned frame) {
  if (period_ == 0 || (has_pushed_ && frame - last_ < period_)) {
    return;
  }
  has_pushed_ = true;
  last_ = frame;
  Push(frame);
}

void Version2Telemetry::Push(unsigned frame) {
  Telemetry telemetry;
  telemetry.frame_number = frame;
  telemetry.count = static_cast<unsigned short>(joints_.NumberOfJoints());
  for (int i = 0; i < joints_.NumberOfJoints(); ++i) {
    const TelemetryEntry entry = {GROUP_JOINT, joints_.Identifier(i), joints_.Position(i)};
    telemetry.entries[i] = entry;
  }
  for (int i = 0; i < sensors_.NumberOfSensors(); ++i) {
    if (sensors_.HasValue(i)) {
      const robot_model::Sensor& sensor = sensors_.Sensor(i);
      const TelemetryEntry entry = {GROUP_SENSOR, sensor.identifier,
                                    protocol::version2SensorValue(sensor.kind, sensors_.Value(i))};
      telemetry.entries[telemetry.count] = entry;
      ++telemetry.count;
    }
  }
  replies_.PushTelemetry(encodeTelemetry(telemetry, replies_.Payload()));
}
