#include "rcserver/requests/Version2.h"

#include <stdio.h>
#include <string.h>

#include "protocol/picture_datagram.h"
#include "protocol/stick_pictures.h"

using namespace protocol::version2;
using robot_model::NO_EAR;
using robot_model::NO_LED;

namespace {

const char SERVER_NAME[] = "aibo_rcserver 0.1.0";

// Identifiers of the two ears.
const int LEFT = 1;
const int RIGHT = 2;

void CopyText(const char* text, char (&out)[MAX_HELLO_TEXT_SIZE + 1]) {
  strncpy(out, text, MAX_HELLO_TEXT_SIZE);
  out[MAX_HELLO_TEXT_SIZE] = '\0';
}

}  // namespace

Version2::Version2(const Robot& robot, const Settings& settings, FileOrder& files, ImageObserver& pictures,
                   Outbox& outbox)
    : robot_(robot),
      exchange_(settings, robot.joints.Orders(), outbox),
      stick_(robot.joints.Motions(), files, pictures, exchange_),
      moves_(robot, stick_, exchange_),
      telemetry_(robot, exchange_),
      camera_(robot, pictures, exchange_),
      sound_(robot.microphone, robot.speaker, exchange_) {
  char* end = capabilities_;
  for (const Row* row = ROWS; row->request != NULL; ++row) {
    if (Serves(*row->request) && settings.Allows(row->request->setting)) {
      end += sprintf(end, "%s%c", row == ROWS ? "" : " ", row->request->letter);
    }
  }
}

void Version2::Begin() {
  stick_.Begin();
  moves_.Begin();
  telemetry_.Begin();
  camera_.Begin();
}

void Version2::Handle(const FrameHeader& request, const unsigned char* payload, unsigned now) {
  exchange_.Begin(request, payload, now);
  if (request.request_number == 0) {
    exchange_.Refuse(CODE_REFUSED,
                     "bad request: number 0 is reserved for messages that the server pushes; use 1 to 65535");
    return;
  }
  for (const Row* row = ROWS; row->request != NULL; ++row) {
    if (row->request->letter == request.kind && Serves(*row->request)) {
      if (exchange_.IsAllowed(row->request->setting)) {
        (this->*row->carry_out)();
      }
      return;
    }
  }
  char text[MAX_ERROR_TEXT_SIZE];
  sprintf(text, "not supported: this server knows the requests %s", capabilities_);
  exchange_.Refuse(CODE_NOT_SUPPORTED, text);
}

void Version2::RefuseTooLarge(const FrameHeader& request) {
  exchange_.Begin(request, NULL, exchange_.Now());
  char text[MAX_ERROR_TEXT_SIZE];
  sprintf(text, "a request of %u bytes is too large; the server closes the connection", request.payload_size);
  exchange_.Refuse(CODE_REFUSED, text);
}

void Version2::PushPowerOff(const char* reason) {
  if (exchange_.HasRoom()) {
    exchange_.PushError(CODE_POWER, reason);
  }
}

bool Version2::AskForSign() {
  const bool has_room = exchange_.HasRoom();
  if (has_room) {
    exchange_.Push(replyKind(REQUEST_HELLO), NoPayload());
  }
  return has_room;
}

void Version2::PushReports() {
  moves_.PushReports();
  sound_.PushEnds();
}

void Version2::Measured(unsigned frame) {
  PushReports();
  moves_.PushMotorsAndPosture();
  telemetry_.Measured(frame);
}

bool Version2::Serves(const Request& request) const {
  return !request.has(MOVES_BODY) || robot_.joints.Walking().CanWalk();
}

void Version2::SayHello() {
  JointControl& joints = robot_.joints;
  Hello hello;
  CopyText(robot_.design, hello.robot);
  CopyText(SERVER_NAME, hello.server);
  CopyText(capabilities_, hello.capabilities);
  hello.frame_number = exchange_.Now();
  hello.joint_count = static_cast<unsigned char>(joints.NumberOfJoints());
  for (int i = 0; i < joints.NumberOfJoints(); ++i) {
    const robot_model::Joint& joint = joints.Robot().joints[i];
    const JointLimits limits = {joint.identifier, joint.lowest, joint.highest, joint.highest_speed};
    hello.joints[i] = limits;
  }
  const WalkLimits none = {0, 0, 0, 0};
  hello.walk = joints.Walking().CanWalk() ? joints.Walking().Parameters().highest : none;
  hello.walk.forward = joints.Walking().CanWalk() ? joints.Walking().Parameters().fastest : 0;
  exchange_.FinishReply(encodeHello(hello, exchange_.Payload()));
}

void Version2::SetLeds() {
  LedValues values;
  if (!exchange_.Decode(&values)) {
    return;
  }
  for (int i = 0; i < values.count; ++i) {
    if (robot_.lights.FindLed(values.leds[i].id) == NO_LED) {
      exchange_.RefuseMissing("LED", values.leds[i].id);
      return;
    }
  }
  for (int i = 0; i < values.count; ++i) {
    LedValue& value = values.leds[i];
    const LightDriver::LedState wanted = {value.intensity, value.mode == LED_MODE_B};
    const LightDriver::LedState accepted = robot_.lights.SetLed(robot_.lights.FindLed(value.id), wanted);
    value.intensity = accepted.intensity;
    value.mode = accepted.is_mode_b ? LED_MODE_B : LED_MODE_A;
  }
  exchange_.Reply(values);
}

void Version2::MoveEars() {
  EarPositions ears;
  if (exchange_.Decode(&ears)) {
    ears.left = SetEar(LEFT, ears.left);
    ears.right = SetEar(RIGHT, ears.right);
    exchange_.Reply(ears);
  }
}

bool Version2::SetEar(int identifier, bool draw) {
  const int ear = robot_.lights.FindEar(identifier);
  return ear != NO_EAR && robot_.lights.SetEar(ear, draw);
}

void Version2::GoOff() {
  if (exchange_.HasNoPayload()) {
    robot_.power_order = exchange_.Request().kind == REQUEST_REBOOT ? POWER_REBOOT : POWER_SHUT_DOWN;
    exchange_.ReplyWithoutPayload();
  }
}

// The rows are in the order in which the hello lists the letters.
const Version2::Row Version2::ROWS[] = {
    {&SAY_HELLO, &Version2::SayHello},
    {&TAKE_PICTURE, &Version2::TakePicture},
    {&STREAM_PICTURES, &Version2::StreamPictures},
    {&MOVE_JOINTS, &Version2::MoveJoints},
    {&LIMIT_SPEEDS, &Version2::LimitSpeeds},
    {&SEND_TELEMETRY, &Version2::SetTelemetry},
    {&TELL_OF_MOTORS, &Version2::SwitchMotors},
    {&HOLD, &Version2::Hold},
    {&SET_LEDS, &Version2::SetLeds},
    {&MOVE_EARS, &Version2::MoveEars},
    {&SET_CAMERA, &Version2::SetCamera},
    {&DETECT_COLORS, &Version2::DetectColors},
    {&SEND_DATAGRAMS, &Version2::SendDatagrams},
    {&PLAY_MOTION, &Version2::PlayMotion},
    {&LIST_MOTIONS, &Version2::ListMotions},
    {&TELL_VOLUME, &Version2::HandleSound},
    {&STEER, &Version2::Steer},
    {&TAKE_POSTURE, &Version2::TakePosture},
    {&STORE_MOTION, &Version2::StoreMotion},
    {&DELETE_MOTION, &Version2::DeleteMotion},
    {&SAVE_PICTURE, &Version2::SavePicture},
    {&LIST_STICK_PICTURES, &Version2::HandlePicture},
    {&SHUT_DOWN, &Version2::GoOff},
    {&REBOOT, &Version2::GoOff},
    {NULL, NULL},
};
