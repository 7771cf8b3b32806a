#include "rcserver/Version2Commands.h"

#include <stdio.h>
#include <string.h>

using namespace protocol::version2;
using robot_model::Joint;
using robot_model::NO_JOINT;

namespace {

const char SERVER_NAME[] = "aibo_rcserver 0.1.0";
const char CAPABILITIES[] = "H F W J V T O";

// Joints report every 4 frames.
const unsigned short SENSOR_PERIOD = 4;
const unsigned short LONGEST_TELEMETRY_PERIOD = 65532;

unsigned short WholeSensorPeriods(unsigned short frames) {
  if (frames > LONGEST_TELEMETRY_PERIOD) {
    return LONGEST_TELEMETRY_PERIOD;
  }
  return static_cast<unsigned short>((frames + SENSOR_PERIOD - 1) / SENSOR_PERIOD * SENSOR_PERIOD);
}

unsigned char JpegQuality(unsigned char id) {
  return id == SERVER_DEFAULT_QUALITY ? protocol::DEFAULT_JPEG_QUALITY : protocol::limitJpegQuality(id);
}

PictureOrder OrderOf(const FrameHeader& request, Layer layer, unsigned short request_number) {
  const PictureOrder order = {JpegQuality(request.id), static_cast<unsigned char>(layer), request_number};
  return order;
}

void CopyText(const char* text, char (&out)[MAX_HELLO_TEXT_SIZE + 1]) {
  strncpy(out, text, MAX_HELLO_TEXT_SIZE);
  out[MAX_HELLO_TEXT_SIZE] = '\0';
}

size_t Encode(unsigned short code, const char* text, unsigned char* out) {
  const ErrorMessage message = {code, text, strlen(text)};
  return encodeErrorMessage(message, out);
}

}  // namespace

Version2Commands::Version2Commands(const char* design, JointControl& joints, Motors& motors, ImageObserver& camera,
                                   Outbox& outbox)
    : design_(design), joints_(joints), motors_(motors), camera_(camera), outbox_(outbox) {
  Begin();
}

void Version2Commands::Begin() {
  telemetry_period_ = 0;
  has_pushed_telemetry_ = false;
  last_telemetry_ = 0;
}

void Version2Commands::Handle(const FrameHeader& request, const unsigned char* payload, unsigned now) {
  if (request.request_number == 0) {
    Refuse(request, CODE_REFUSED, "bad request: its number is 0, which marks what the server pushes; use 1 to 65535");
    return;
  }
  switch (request.kind) {
    case REQUEST_HELLO:
      Greet(request, now);
      break;
    case REQUEST_PICTURE:
      TakePicture(request, payload);
      break;
    case REQUEST_STREAM:
      Stream(request, payload);
      break;
    case REQUEST_JOINTS:
      MoveJoints(request, payload);
      break;
    case REQUEST_SPEED_LIMITS:
      LimitSpeeds(request, payload);
      break;
    case REQUEST_TELEMETRY:
      SetTelemetryPeriod(request, payload);
      break;
    case REQUEST_MOTORS:
      SwitchMotors(request, payload);
      break;
    default:
      RefuseUnknownKind(request);
      break;
  }
}

void Version2Commands::Refuse(const FrameHeader& request, unsigned short code, const char* text) {
  const size_t size = Encode(code, text, Payload());
  const FrameHeader header = {ERROR_MESSAGE, 0, request.request_number, static_cast<unsigned>(size)};
  encodeFrameHeader(header, message_);
  outbox_.Add(message_, FRAME_HEADER_SIZE + size);
}

void Version2Commands::Measured(unsigned frame) {
  PushFaults();
  PushTelemetry(frame);
}

void Version2Commands::Greet(const Request& request, unsigned now) {
  Hello hello;
  CopyText(design_, hello.robot);
  CopyText(SERVER_NAME, hello.server);
  CopyText(CAPABILITIES, hello.capabilities);
  hello.frame_number = now;
  hello.joint_count = static_cast<unsigned char>(joints_.NumberOfJoints());
  for (int i = 0; i < joints_.NumberOfJoints(); ++i) {
    const Joint& joint = joints_.Robot().joints[i];
    const JointLimits limits = {joint.identifier, joint.lowest, joint.highest, joint.highest_speed};
    hello.joints[i] = limits;
  }
  Reply(request, encodeHello(hello, Payload()));
}

void Version2Commands::TakePicture(const Request& request, const unsigned char* payload) {
  Layer layer = LAYER_HIGH;
  if (const char* problem = decodePictureRequest(payload, request.payload_size, &layer)) {
    RefuseBadRequest(request, problem);
    return;
  }
  if (!TakesLayer(request, layer)) {
    return;
  }
  if (!camera_.RequestPicture(OrderOf(request, layer, request.request_number))) {
    Refuse(request, CODE_REFUSED, "too many pictures are owed already; wait for some of them");
  }
}

void Version2Commands::Stream(const Request& request, const unsigned char* payload) {
  StreamSettings settings;
  if (const char* problem = decodeStreamSettings(payload, request.payload_size, &settings)) {
    RefuseBadRequest(request, problem);
    return;
  }
  if (!TakesLayer(request, settings.layer)) {
    return;
  }
  if (settings.on) {
    camera_.StartStream(OrderOf(request, settings.layer, 0), settings.every_nth_image);
  } else {
    camera_.StopStream();
  }
  Request answered = request;
  answered.id = JpegQuality(request.id);
  Reply(answered, encodeStreamSettings(settings, Payload()));
}

void Version2Commands::MoveJoints(const Request& request, const unsigned char* payload) {
  JointTargets wanted;
  if (const char* problem = decodeJointTargets(payload, request.payload_size, &wanted)) {
    RefuseBadRequest(request, problem);
    return;
  }
  if (!motors_.AreOn()) {
    Refuse(request, CODE_REFUSED, "the motors are off; switch them on first");
    return;
  }
  MotionPlanner::JointTarget targets[MAX_JOINTS];
  for (int i = 0; i < wanted.count; ++i) {
    targets[i].joint = joints_.Find(wanted.joints[i].id);
    targets[i].position = wanted.joints[i].value;
    if (targets[i].joint == NO_JOINT) {
      RefuseUnknownJoint(request, wanted.joints[i].id);
      return;
    }
  }
  joints_.Planner().SetTargets(targets, wanted.count, wanted.duration_ms);
  for (int i = 0; i < wanted.count; ++i) {
    wanted.joints[i].value = targets[i].position;
  }
  Reply(request, encodeJointTargets(wanted, Payload()));
}

void Version2Commands::LimitSpeeds(const Request& request, const unsigned char* payload) {
  SpeedLimits limits;
  if (const char* problem = decodeSpeedLimits(payload, request.payload_size, &limits)) {
    RefuseBadRequest(request, problem);
    return;
  }
  for (int i = 0; i < limits.count; ++i) {
    if (joints_.Find(limits.joints[i].id) == NO_JOINT) {
      RefuseUnknownJoint(request, limits.joints[i].id);
      return;
    }
  }
  MotionPlanner& planner = joints_.Planner();
  for (int i = 0; i < limits.count; ++i) {
    limits.joints[i].value = planner.SetSpeedLimit(joints_.Find(limits.joints[i].id), limits.joints[i].value);
  }
  if (limits.count == 0) {
    limits.count = static_cast<unsigned char>(joints_.NumberOfJoints());
    for (int i = 0; i < joints_.NumberOfJoints(); ++i) {
      limits.joints[i].id = joints_.Identifier(i);
      limits.joints[i].value = planner.SpeedLimit(i);
    }
  }
  Reply(request, encodeSpeedLimits(limits, Payload()));
}

void Version2Commands::SetTelemetryPeriod(const Request& request, const unsigned char* payload) {
  unsigned short frames = 0;
  if (const char* problem = decodeTelemetryPeriod(payload, request.payload_size, &frames)) {
    RefuseBadRequest(request, problem);
    return;
  }
  telemetry_period_ = WholeSensorPeriods(frames);
  has_pushed_telemetry_ = false;
  outbox_.DropTelemetry();
  Reply(request, encodeTelemetryPeriod(telemetry_period_, Payload()));
}

void Version2Commands::SwitchMotors(const Request& request, const unsigned char* payload) {
  if (request.payload_size > 0) {
    bool on = false;
    if (const char* problem = decodeMotorState(payload, request.payload_size, &on)) {
      RefuseBadRequest(request, problem);
      return;
    }
    if (!motors_.Switch(on)) {
      Refuse(request, CODE_REFUSED, "the robot does not switch its motors on; its console says why");
      return;
    }
  }
  Reply(request, encodeMotorState(motors_.AreOn(), Payload()));
}

void Version2Commands::RefuseBadRequest(const Request& request, const char* problem) {
  char text[MAX_ERROR_TEXT_SIZE];
  sprintf(text, "bad request: %.200s", problem);
  Refuse(request, CODE_REFUSED, text);
}

void Version2Commands::RefuseUnknownKind(const Request& request) {
  char text[MAX_ERROR_TEXT_SIZE];
  sprintf(text, "not supported: this server knows the requests %s", CAPABILITIES);
  Refuse(request, CODE_NOT_SUPPORTED, text);
}

void Version2Commands::RefuseUnknownJoint(const Request& request, unsigned char identifier) {
  char text[MAX_ERROR_TEXT_SIZE];
  sprintf(text, "there is no joint %d on this robot, so nothing of the request was done", identifier);
  Refuse(request, CODE_REFUSED, text);
}

// Refuses what this server cannot make of the camera's layers.
bool Version2Commands::TakesLayer(const Request& request, Layer layer) {
  if (layer == LAYER_DOUBLE) {
    Refuse(request, CODE_NOT_SUPPORTED, "not supported: pictures of double resolution");
    return false;
  }
  return true;
}

// The payload is in message_ already.
void Version2Commands::Reply(const Request& request, size_t payload_size) {
  const FrameHeader header = {replyKind(request.kind), request.id, request.request_number,
                              static_cast<unsigned>(payload_size)};
  encodeFrameHeader(header, message_);
  outbox_.Add(message_, FRAME_HEADER_SIZE + payload_size);
}

// A fault that finds no room is pushed the next time.
void Version2Commands::PushFaults() {
  for (int i = 0; i < joints_.NumberOfJoints() && outbox_.HasRoom(); ++i) {
    const JointWatch::Verdict fault = joints_.TakeFault(i);
    if (fault != JointWatch::FOLLOWS) {
      char text[MAX_ERROR_TEXT_SIZE];
      sprintf(text, "%s %s. It is held where it is until it is commanded again", joints_.Name(i),
              fault == JointWatch::JAMMED ? "is jammed: its motor pushes and it does not move"
                                          : "does not follow what it is told");
      const FrameHeader pushed = {};
      Refuse(pushed, CODE_JOINT_FAULT, text);
    }
  }
}

void Version2Commands::PushTelemetry(unsigned frame) {
  if (telemetry_period_ == 0 || (has_pushed_telemetry_ && frame - last_telemetry_ < telemetry_period_)) {
    return;
  }
  has_pushed_telemetry_ = true;
  last_telemetry_ = frame;
  Telemetry telemetry;
  telemetry.frame_number = frame;
  telemetry.count = static_cast<unsigned short>(joints_.NumberOfJoints());
  for (int i = 0; i < joints_.NumberOfJoints(); ++i) {
    const TelemetryEntry entry = {GROUP_JOINT, joints_.Identifier(i), joints_.Position(i)};
    telemetry.entries[i] = entry;
  }
  const size_t size = encodeTelemetry(telemetry, Payload());
  const FrameHeader header = {TELEMETRY_PUSH, 0, 0, static_cast<unsigned>(size)};
  encodeFrameHeader(header, message_);
  outbox_.SetTelemetry(message_, FRAME_HEADER_SIZE + size);
}
