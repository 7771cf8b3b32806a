#include "rcserver/Version2.h"

#include <stdio.h>
#include <string.h>

using namespace protocol::version2;
using robot_model::Joint;

namespace {

const char SERVER_NAME[] = "aibo_rcserver 0.1.0";
const char CAPABILITIES[] = "H F W J V T O L K P N";  // whatever the settings are

void CopyText(const char* text, char (&out)[MAX_HELLO_TEXT_SIZE + 1]) {
  strncpy(out, text, MAX_HELLO_TEXT_SIZE);
  out[MAX_HELLO_TEXT_SIZE] = '\0';
}

}  // namespace

Version2::Version2(const Robot& robot, const Settings& settings, MotionCommands& motions, ImageObserver& camera,
                   Outbox& outbox)
    : robot_(robot),
      replies_(outbox),
      camera_(camera, replies_),
      joints_(robot.joints, robot.motors, replies_),
      lights_(robot.lights, replies_),
      motions_(motions, robot.joints, replies_),
      power_(robot.power_order, settings, replies_),
      telemetry_(robot.joints, robot.sensors, replies_) {
  sprintf(capabilities_, "%s%s%s%s%s", CAPABILITIES, settings.allow_upload ? " U" : "",
          settings.allow_delete ? " D" : "", settings.allow_shut_down ? " Q" : "", settings.allow_reboot ? " R" : "");
}

void Version2::Begin() {
  telemetry_.Begin();
}

bool Version2::Handle(const FrameHeader& request, const unsigned char* payload, unsigned now) {
  if (request.request_number == 0) {
    Refuse(request, CODE_REFUSED, "bad request: its number is 0, which marks what the server pushes; use 1 to 65535");
    return true;
  }
  switch (request.kind) {
    case REQUEST_HELLO:
      Greet(request, now);
      break;
    case REQUEST_PICTURE:
      camera_.TakePicture(request, payload);
      break;
    case REQUEST_STREAM:
      camera_.Stream(request, payload);
      break;
    case REQUEST_JOINTS:
      joints_.Move(request, payload);
      break;
    case REQUEST_SPEED_LIMITS:
      joints_.LimitSpeeds(request, payload);
      break;
    case REQUEST_MOTORS:
      joints_.SwitchMotors(request, payload);
      break;
    case REQUEST_TELEMETRY:
      telemetry_.SetPeriod(request, payload);
      break;
    case REQUEST_UPLOAD:
      return motions_.Upload(request, payload);
    case REQUEST_DELETE:
      return motions_.Delete(request, payload);
    case REQUEST_PLAY:
      return motions_.Play(request, payload);
    case REQUEST_LIST:
      return motions_.List(request);
    case REQUEST_LEDS:
      lights_.SetLeds(request, payload);
      break;
    case REQUEST_EARS:
      lights_.SetEars(request, payload);
      break;
    case REQUEST_SHUT_DOWN:
      power_.ShutDown(request);
      break;
    case REQUEST_REBOOT:
      power_.Reboot(request);
      break;
    default:
      RefuseUnknownKind(request);
      break;
  }
  return true;
}

void Version2::Refuse(const FrameHeader& request, unsigned short code, const char* text) {
  replies_.Refuse(request, code, text);
}

void Version2::Measured(unsigned frame) {
  joints_.PushFaults();
  motions_.PushFailures();
  telemetry_.Measured(frame);
}

void Version2::Greet(const Request& request, unsigned now) {
  Hello hello;
  CopyText(robot_.design, hello.robot);
  CopyText(SERVER_NAME, hello.server);
  CopyText(capabilities_, hello.capabilities);
  hello.frame_number = now;
  hello.joint_count = static_cast<unsigned char>(robot_.joints.NumberOfJoints());
  for (int i = 0; i < robot_.joints.NumberOfJoints(); ++i) {
    const Joint& joint = robot_.joints.Robot().joints[i];
    const JointLimits limits = {joint.identifier, joint.lowest, joint.highest, joint.highest_speed};
    hello.joints[i] = limits;
  }
  replies_.Reply(request, encodeHello(hello, replies_.Payload()));
}

void Version2::RefuseUnknownKind(const Request& request) {
  char text[MAX_ERROR_TEXT_SIZE];
  sprintf(text, "not supported: this server knows the requests %s", capabilities_);
  replies_.Refuse(request, CODE_NOT_SUPPORTED, text);
}
