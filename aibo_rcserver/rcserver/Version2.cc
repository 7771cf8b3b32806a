#include "rcserver/Version2.h"

#include <stdio.h>
#include <string.h>

#include "protocol/picture_datagram.h"
#include "protocol/units.h"

using namespace protocol::version2;
using robot_model::NO_EAR;
using robot_model::NO_JOINT;
using robot_model::NO_LED;

namespace {

const char SERVER_NAME[] = "aibo_rcserver 0.1.0";
const char CAPABILITIES[] = "H F W J V T O I L K G Z B P N";  // whatever the settings are

const char CANNOT_SWITCH_ON[] = "the robot cannot switch its motors on; its console says why";

// Joints and sensors report every 4 frames.
const unsigned short SENSOR_PERIOD = 4;
const unsigned short LONGEST_PERIOD = 65532;

// Identifiers of the two ears.
const int LEFT = 1;
const int RIGHT = 2;

void CopyText(const char* text, char (&out)[MAX_HELLO_TEXT_SIZE + 1]) {
  strncpy(out, text, MAX_HELLO_TEXT_SIZE);
  out[MAX_HELLO_TEXT_SIZE] = '\0';
}

PictureOrder OrderOf(unsigned char quality, Layer layer, unsigned short request_number) {
  const PictureOrder order = {quality, static_cast<unsigned char>(layer), request_number, false, false};
  return order;
}

unsigned short WholeSensorPeriods(unsigned short frames) {
  if (frames > LONGEST_PERIOD) {
    return LONGEST_PERIOD;
  }
  return static_cast<unsigned short>((frames + SENSOR_PERIOD - 1) / SENSOR_PERIOD * SENSOR_PERIOD);
}

// In an order of operations that does not overflow: a reported duty has 16 bits.
int MillionthsOfFullDuty(int duty) {
  return duty * (1000000 / 64) / (FULL_DUTY / 64);
}

short Thousandths(double value) {
  return static_cast<short>(value * 1000 + (value < 0 ? -1e-6 : 1e-6));
}

int Millionths(double value) {
  return static_cast<int>(value * 1e6 + (value < 0 ? -0.5 : 0.5));
}

WalkLimits WalkLimitsOf(const Walker& walker) {
  const GaitParameters& gait = walker.Parameters();
  const WalkLimits none = {0, 0, 0, 0};
  const WalkLimits limits = {Thousandths(gait.highest_forward), Thousandths(gait.highest_back),
                             Thousandths(gait.highest_left), Thousandths(gait.highest_turn)};
  return walker.CanWalk() ? limits : none;
}

void AddWalk(Walker& walker, Telemetry* telemetry) {
  const WalkVelocity velocity = walker.TakeVelocity();
  const TelemetryEntry entries[] = {
      {GROUP_WALK, WALK_FORWARD, Millionths(velocity.forward)},
      {GROUP_WALK, WALK_LEFT, Millionths(velocity.left)},
      {GROUP_WALK, WALK_TURN, Millionths(velocity.turn)},
      {GROUP_WALK, WALK_PHASE, static_cast<int>(walker.Phase() * 1e6)},
      {GROUP_WALK, WALK_STATE, walker.State()},
  };
  for (size_t i = 0; i < sizeof(entries) / sizeof(entries[0]); ++i) {
    telemetry->entries[telemetry->count] = entries[i];
    ++telemetry->count;
  }
}

unsigned char HowEnded(Walker::Cause cause) {
  switch (cause) {
    case Walker::DONE:
      return END_DONE;
    case Walker::JOINT_COMMANDED:
    case Walker::MOTION_BEGAN:
    case Walker::POSTURE_BEGAN:
    case Walker::WALK_BEGAN:
      return END_REPLACED;
    case Walker::JOINT_FAILED:
    case Walker::JOINT_SLOW:
      return END_REFUSED;
    case Walker::FELL:
      return END_FELL;
    default:
      return END_STOPPED;
  }
}

const char* WordsFor(JointWatch::Verdict fault) {
  switch (fault) {
    case JointWatch::JAMMED:
      return "is jammed: its motor pushes and it does not move. It is held where it is until it is commanded again";
    case JointWatch::LIMP:
      return "is limp: its motor got no gain. Switch the motors off and on again; the robot's console has the reason";
    default:
      return "does not follow its commands. It is held where it is until it is commanded again";
  }
}

}  // namespace

Version2::Version2(const Robot& robot, const Settings& settings, FileOrder& files, MotionCommands& motions,
                   StickPictures& pictures, ImageObserver& camera, Outbox& outbox)
    : robot_(robot),
      settings_(settings),
      files_(files),
      motions_(motions),
      pictures_(pictures),
      camera_(camera),
      outbox_(outbox),
      request_(),
      payload_(NULL),
      commands_(0),
      pending_(),
      owes_file_(false),
      has_waiting_(false),
      waiting_(),
      commands_before_waiting_(0),
      told_(),
      colors_(),
      has_pushed_colors_(false),
      last_colors_(0) {
  sprintf(capabilities_, "%s%s%s%s%s%s%s", CAPABILITIES, robot.joints.Walking().CanWalk() ? " S E" : "",
          settings.allow_upload ? " U" : "", settings.allow_delete ? " D" : "", settings.allow_pictures ? " M Y" : "",
          settings.allow_shut_down ? " Q" : "", settings.allow_reboot ? " R" : "");
  Begin();
}

void Version2::Begin() {
  owes_file_ = false;
  has_waiting_ = false;
  tells_camera_settings_ = false;
  tells_motors_ = false;
  has_told_motors_ = false;
  telemetry_period_ = 0;
  content_ = TELEMETRY_PLAIN;
  has_pushed_telemetry_ = false;
  last_telemetry_ = 0;
  detects_colors_ = false;
}

void Version2::Handle(const FrameHeader& request, const unsigned char* payload, unsigned now) {
  request_ = request;
  payload_ = payload;
  commands_ = robot_.joints.NumberOfCommands();
  if (request.request_number == 0) {
    Refuse(CODE_REFUSED, "bad request: number 0 is kept for messages that the server pushes; use 1 to 65535");
    return;
  }
  switch (request.kind) {
    case REQUEST_UPLOAD:
    case REQUEST_DELETE:
    case REQUEST_PLAY:
    case REQUEST_LIST:
    case REQUEST_SAVE_PICTURE:
    case REQUEST_PICTURES:
      if (!HandleFileRequest()) {
        Wait();
      }
      break;
    default:
      Execute(now);
  }
}

void Version2::Execute(unsigned now) {
  switch (request_.kind) {
    case REQUEST_HELLO:
      return Greet(now);
    case REQUEST_PICTURE:
      return TakePicture();
    case REQUEST_STREAM:
      return SetStream();
    case REQUEST_CAMERA:
      return SetCamera();
    case REQUEST_DATAGRAMS:
      return SetDatagrams();
    case REQUEST_COLORS:
      return SetColors();
    case REQUEST_JOINTS:
      return MoveJoints();
    case REQUEST_SPEED_LIMITS:
      return LimitSpeeds();
    case REQUEST_MOTORS:
      return SwitchMotors();
    case REQUEST_HOLD:
      return Hold();
    case REQUEST_TELEMETRY:
      return SetTelemetry();
    case REQUEST_STEER:
    case REQUEST_POSTURE:
      if (robot_.joints.Walking().CanWalk()) {
        return request_.kind == REQUEST_STEER ? Steer() : TakePosture();
      }
      break;
    case REQUEST_LEDS:
      return SetLeds();
    case REQUEST_EARS:
      return SetEars();
    case REQUEST_SHUT_DOWN:
      return GoOff(POWER_SHUT_DOWN, settings_.allow_shut_down, "shutting down", "ALLOW_SHUT_DOWN");
    case REQUEST_REBOOT:
      return GoOff(POWER_REBOOT, settings_.allow_reboot, "rebooting", "ALLOW_REBOOT");
    default:
      break;
  }
  char text[MAX_ERROR_TEXT_SIZE];
  sprintf(text, "not supported: this server knows the requests %s", capabilities_);
  Refuse(CODE_NOT_SUPPORTED, text);
}

void Version2::RefuseTooLarge(const FrameHeader& request) {
  request_ = request;
  char text[MAX_ERROR_TEXT_SIZE];
  sprintf(text, "a request of %u bytes is too large; the server hangs up", request.payload_size);
  Refuse(CODE_REFUSED, text);
}

void Version2::PushPowerOff(const char* reason) {
  if (outbox_.HasRoom()) {
    SendError(0, CODE_POWER, reason);
  }
}

void Version2::PushReports() {
  PushJointFaults();
  PushRecoveries();
  PushMotionEnds();
  PushWalkEnds();
}

void Version2::Measured(unsigned frame) {
  PushReports();
  PushMotorsAndPosture();
  if (telemetry_period_ != 0 && (!has_pushed_telemetry_ || frame - last_telemetry_ >= telemetry_period_)) {
    has_pushed_telemetry_ = true;
    last_telemetry_ = frame;
    PushTelemetry(frame);
  }
}

// Answers the request with what has been written to Payload().
void Version2::Reply(size_t payload_size) {
  const FrameHeader header = {replyKind(request_.kind), request_.id, request_.request_number,
                              static_cast<unsigned>(payload_size)};
  encodeFrameHeader(header, message_);
  outbox_.Add(message_, FRAME_HEADER_SIZE + payload_size);
}

void Version2::Refuse(unsigned short code, const char* text) {
  SendError(request_.request_number, code, text);
}

void Version2::SendError(unsigned short request_number, unsigned short code, const char* text) {
  const ErrorMessage error = {code, text, strlen(text)};
  const size_t size = encodeErrorMessage(error, Payload());
  const FrameHeader header = {ERROR_MESSAGE, 0, request_number, static_cast<unsigned>(size)};
  encodeFrameHeader(header, message_);
  outbox_.Add(message_, FRAME_HEADER_SIZE + size);
}

void Version2::SendEnd(unsigned char what, unsigned char how, const char* name, const char* reason) {
  const EndMessage end = {what, how, name, strlen(name), reason, strlen(reason)};
  const size_t size = encodeEndMessage(end, Payload());
  const FrameHeader header = {END_PUSH, 0, 0, static_cast<unsigned>(size)};
  encodeFrameHeader(header, message_);
  outbox_.Add(message_, FRAME_HEADER_SIZE + size);
}

// Refuses the request if its decoder has found a problem.
bool Version2::IsWellFormed(const char* problem) {
  if (problem != NULL) {
    char text[MAX_ERROR_TEXT_SIZE];
    sprintf(text, "bad request: %.200s", problem);
    Refuse(CODE_REFUSED, text);
  }
  return problem == NULL;
}

void Version2::Greet(unsigned now) {
  JointControl& joints = robot_.joints;
  Hello hello;
  CopyText(robot_.design, hello.robot);
  CopyText(SERVER_NAME, hello.server);
  CopyText(capabilities_, hello.capabilities);
  hello.frame_number = now;
  hello.joint_count = static_cast<unsigned char>(joints.NumberOfJoints());
  for (int i = 0; i < joints.NumberOfJoints(); ++i) {
    const robot_model::Joint& joint = joints.Robot().joints[i];
    const JointLimits limits = {joint.identifier, joint.lowest, joint.highest, joint.highest_speed};
    hello.joints[i] = limits;
  }
  hello.walk = WalkLimitsOf(joints.Walking());
  Reply(encodeHello(hello, Payload()));
}

void Version2::TakePicture() {
  Layer layer = LAYER_HIGH;
  if (IsWellFormed(decodePictureRequest(payload_, request_.payload_size, &layer)) && MakesLayer(layer) &&
      !camera_.RequestPicture(OrderOf(JpegQuality(request_.id), layer, request_.request_number))) {
    Refuse(CODE_REFUSED, "too many pictures are owed already; wait until some have come");
  }
}

unsigned char Version2::JpegQuality(unsigned char id) {
  return id == SERVER_DEFAULT_QUALITY ? protocol::DEFAULT_JPEG_QUALITY : protocol::limitJpegQuality(id);
}

void Version2::SetStream() {
  StreamSettings stream;
  if (!IsWellFormed(decodeStreamSettings(payload_, request_.payload_size, &stream)) || !MakesLayer(stream.layer)) {
    return;
  }
  if (stream.on) {
    camera_.StartStream(OrderOf(JpegQuality(request_.id), stream.layer, 0), stream.every_nth_image);
  } else {
    camera_.StopStream();
  }
  request_.id = JpegQuality(request_.id);  // the reply has the quality in use
  Reply(encodeStreamSettings(stream, Payload()));
}

bool Version2::MakesLayer(Layer layer) {
  const bool makes = layer != LAYER_DOUBLE || camera_.HasDetail();
  if (!makes) {
    Refuse(CODE_NOT_SUPPORTED, "not supported: this robot's camera has no bands for double resolution");
  }
  return makes;
}

void Version2::SetCamera() {
  const bool is_read = request_.payload_size == 0 && hasCameraValue(request_.id, 1);
  unsigned char value = 0;
  if (!is_read && !IsWellFormed(decodeCameraValue(request_.id, payload_, request_.payload_size, &value))) {
    return;
  }
  tells_camera_settings_ = true;
  const CameraSetting setting = static_cast<CameraSetting>(request_.id);
  if (!is_read && !robot_.camera.Set(setting, value)) {
    Refuse(CODE_REFUSED, "the robot's camera does not take this setting; the robot's console says why");
    return;
  }
  Reply(encodeCameraValue(robot_.camera.Settings().of(setting), Payload()));
}

void Version2::SetDatagrams() {
  unsigned short port = 0;
  if (!IsWellFormed(decodeDatagramPort(payload_, request_.payload_size, &port))) {
    return;
  }
  if (!robot_.datagrams.SendTo(port)) {
    return Refuse(CODE_REFUSED, "the IPStack has no endpoint for datagrams; pictures go over this connection");
  }
  Reply(encodeDatagramPort(port, Payload()));
}

void Version2::MoveJoints() {
  JointTargets wanted;
  if (!IsWellFormed(decodeJointTargets(payload_, request_.payload_size, &wanted))) {
    return;
  }
  if (!robot_.motors.AreOn()) {
    Refuse(CODE_REFUSED, "the motors are off; switch them on first");
    return;
  }
  if (IsTooOld() || !HasJoints(wanted.joints, wanted.count)) {
    return;
  }
  MotionPlanner::JointTarget targets[MAX_JOINTS];
  for (int i = 0; i < wanted.count; ++i) {
    targets[i].joint = robot_.joints.Find(wanted.joints[i].id);
    targets[i].position = wanted.joints[i].value;
  }
  robot_.joints.SetTargets(targets, wanted.count, wanted.duration_ms);
  for (int i = 0; i < wanted.count; ++i) {
    wanted.joints[i].value = targets[i].position;
  }
  Reply(encodeJointTargets(wanted, Payload()));
}

void Version2::LimitSpeeds() {
  SpeedLimits limits;
  if (!IsWellFormed(decodeSpeedLimits(payload_, request_.payload_size, &limits)) ||
      !HasJoints(limits.joints, limits.count)) {
    return;
  }
  JointControl& joints = robot_.joints;
  for (int i = 0; i < limits.count; ++i) {
    limits.joints[i].value = joints.Planner().SetSpeedLimit(joints.Find(limits.joints[i].id), limits.joints[i].value);
  }
  if (limits.count == 0) {
    limits.count = static_cast<unsigned char>(joints.NumberOfJoints());
    for (int i = 0; i < joints.NumberOfJoints(); ++i) {
      limits.joints[i].id = joints.Identifier(i);
      limits.joints[i].value = joints.Planner().SpeedLimit(i);
    }
  }
  Reply(encodeSpeedLimits(limits, Payload()));
}

// Refuses the request if the robot does not have one of these joints.
bool Version2::HasJoints(const JointValue* joints, int count) {
  for (int i = 0; i < count; ++i) {
    if (!HasJoint(joints[i].id)) {
      return false;
    }
  }
  return true;
}

bool Version2::HasJoint(int identifier) {
  if (robot_.joints.Find(identifier) == NO_JOINT) {
    RefuseMissing("joint", identifier);
    return false;
  }
  return true;
}

void Version2::RefuseMissing(const char* part, int identifier) {
  char text[MAX_ERROR_TEXT_SIZE];
  sprintf(text, "this robot has no %s %d, so nothing of the request was done", part, identifier);
  Refuse(CODE_REFUSED, text);
}

void Version2::SwitchMotors() {
  MotorSwitch& motors = robot_.motors;
  if (request_.payload_size > 0) {
    bool on = false;
    if (!IsWellFormed(decodeMotorState(payload_, request_.payload_size, &on))) {
      return;
    }
    if (on && IsTooOld()) {
      return;
    }
    if (!motors.Switch(on)) {
      Refuse(CODE_REFUSED, CANNOT_SWITCH_ON);
      return;
    }
  }
  tells_motors_ = true;
  Reply(encodeMotorState(motors.AreOn(), Payload()));
  if (!motors.AreOn()) {
    CancelPlay(ALL_MOTIONS, "is not played: the motors were switched off before its file had been read");
  }
}

void Version2::Hold() {
  switch (request_.id) {
    case HOLD_EVERYTHING:
      if (IsWellFormed(checkNoPayload(request_.payload_size))) {
        robot_.joints.StopAll();
        Reply(0);
        CancelPlay(ALL_MOTIONS, "is not played: everything was told to hold before its file had been read");
      }
      break;
    case HOLD_JOINTS:
      HoldJoints();
      break;
    default:
      Refuse(CODE_REFUSED, "bad request: the id is neither 0 (hold everything) nor 1 (the joints named)");
  }
}

// A motion whose file has not been read yet is refused if it moves one of them: see JointControl::FindCommandedSince().
void Version2::HoldJoints() {
  JointIds named;
  if (!IsWellFormed(decodeJointIds(payload_, request_.payload_size, &named))) {
    return;
  }
  for (int i = 0; i < named.count; ++i) {
    if (!HasJoint(named.ids[i])) {
      return;
    }
  }
  for (int i = 0; i < named.count; ++i) {
    robot_.joints.Stop(robot_.joints.Find(named.ids[i]));
  }
  Reply(0);
}

// Velocities are whole mm/s and mrad/s on the wire. Those in force are rounded down, so that a client that sends them
// back gets the same.
void Version2::Steer() {
  protocol::version2::Velocity wire;
  if (!IsWellFormed(decodeVelocity(payload_, request_.payload_size, &wire))) {
    return;
  }
  const WalkVelocity wanted = {wire.forward * 1e-3, wire.left * 1e-3, wire.turn * 1e-3};
  if (!IsZero(wanted)) {
    if (IsTooOld()) {
      return;
    }
    if (const char* const problem = robot_.joints.Walking().ProblemOfWalk(robot_.motors.AreOn())) {
      return Refuse(CODE_REFUSED, problem);
    }
  }
  const WalkVelocity accepted = robot_.joints.Steer(wanted);
  wire.forward = Thousandths(accepted.forward);
  wire.left = Thousandths(accepted.left);
  wire.turn = Thousandths(accepted.turn);
  Reply(encodeVelocity(wire, Payload()));
}

void Version2::TakePosture() {
  if (!IsWellFormed(checkNoPayload(request_.payload_size))) {
    return;
  }
  if (!isPosture(request_.id)) {
    Refuse(CODE_REFUSED, "bad request: the id is not one of the postures 1 (stand), 2 (sit) and 3 (rest)");
    return;
  }
  const Posture posture = static_cast<Posture>(request_.id);
  if (!IsTooOld() && MayTake(posture)) {
    robot_.joints.Take(posture);
    Reply(0);
  }
}

// Switches the motors on for a robot that has rested. Refuses the request if the robot cannot take the posture now.
bool Version2::MayTake(Posture posture) {
  const char* problem = robot_.joints.Walking().Problem();
  if (problem == NULL && !robot_.motors.AreOn()) {
    if (posture == POSTURE_REST) {
      problem = "the motors are off already; to lie down, switch them on first";
    } else if (!robot_.motors.Switch(true)) {
      problem = CANNOT_SWITCH_ON;
    }
  }
  if (problem != NULL) {
    Refuse(CODE_REFUSED, problem);
  }
  return problem == NULL;
}

// Refuses an order to move that may have waited.
bool Version2::IsTooOld() {
  if (robot_.held_up.MayHaveWaited()) {
    Refuse(CODE_REFUSED, HoldUpWatch::TOO_OLD);
    return true;
  }
  return false;
}

void Version2::SetTelemetry() {
  unsigned short frames = 0;
  if (IsWellFormed(decodeTelemetryPeriod(payload_, request_.payload_size, &frames))) {
    telemetry_period_ = WholeSensorPeriods(frames);
    const bool can_walk = robot_.joints.Walking().CanWalk();
    content_ = static_cast<unsigned char>(request_.id & (TELEMETRY_WITH_DUTY | (can_walk ? TELEMETRY_WITH_WALK : 0)));
    request_.id = content_;
    has_pushed_telemetry_ = false;
    outbox_.Telemetry().Drop();
    Reply(encodeTelemetryPeriod(telemetry_period_, Payload()));
  }
}

void Version2::SetLeds() {
  LedValues values;
  if (!IsWellFormed(decodeLedValues(payload_, request_.payload_size, &values))) {
    return;
  }
  for (int i = 0; i < values.count; ++i) {
    if (robot_.lights.FindLed(values.leds[i].id) == NO_LED) {
      RefuseMissing("LED", values.leds[i].id);
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
  Reply(encodeLedValues(values, Payload()));
}

void Version2::SetEars() {
  EarPositions ears;
  if (IsWellFormed(decodeEarPositions(payload_, request_.payload_size, &ears))) {
    ears.left = SetEar(LEFT, ears.left);
    ears.right = SetEar(RIGHT, ears.right);
    Reply(encodeEarPositions(ears, Payload()));
  }
}

bool Version2::SetEar(int identifier, bool draw) {
  const int ear = robot_.lights.FindEar(identifier);
  return ear != NO_EAR && robot_.lights.SetEar(ear, draw);
}

void Version2::GoOff(PowerOrder order, bool is_allowed, const char* activity, const char* setting) {
  if (!IsWellFormed(checkNoPayload(request_.payload_size))) {
    return;
  }
  if (!is_allowed) {
    char text[MAX_ERROR_TEXT_SIZE];
    sprintf(text, "%s is not allowed; %s=yes in RCSERVER.CFG on the memory stick allows it", activity, setting);
    Refuse(CODE_REFUSED, text);
    return;
  }
  robot_.power_order = order;
  Reply(0);
}

// A fault for which there is no room is pushed the next time.
void Version2::PushJointFaults() {
  for (int i = 0; i < robot_.joints.NumberOfJoints() && outbox_.HasRoom(); ++i) {
    const JointWatch::Verdict fault = robot_.joints.TakeFault(i);
    if (fault != JointWatch::FOLLOWS) {
      char text[MAX_ERROR_TEXT_SIZE];
      sprintf(text, "%s %s", robot_.joints.Name(i), WordsFor(fault));
      SendError(0, CODE_JOINT_FAULT, text);
    }
  }
}

void Version2::PushRecoveries() {
  for (int i = 0; i < robot_.joints.NumberOfJoints() && outbox_.HasRoom(); ++i) {
    if (robot_.joints.TakeRecovery(i)) {
      SendEnd(ENDED_JAM, END_DONE, robot_.joints.Name(i), "it follows its commands again");
    }
  }
}

void Version2::PushWalkEnds() {
  Walker& walker = robot_.joints.Walking();
  Walker::End end;
  while (outbox_.HasRoom() && walker.TakeEnd(&end)) {
    char reason[Walker::MAX_TEXT_SIZE];
    walker.Describe(end, reason);
    SendEnd(end.is_walk ? ENDED_WALK : ENDED_POSTURE, HowEnded(end.cause),
            end.is_walk ? WALK_NAME : postureName(end.posture), reason);
  }
  if (outbox_.HasRoom() && walker.TakeSoftened()) {
    SendError(0, CODE_REFUSED, "the robot has fallen: its motors are off, so that its legs are soft");
  }
}

void Version2::PushMotorsAndPosture() {
  const MotorsAndPosture now = {robot_.motors.AreOn(), static_cast<unsigned char>(robot_.joints.Posture())};
  const bool is_told = has_told_motors_ && now.motors_on == told_.motors_on && now.posture == told_.posture;
  if (!tells_motors_ || is_told || !outbox_.HasRoom()) {
    return;
  }
  has_told_motors_ = true;
  told_ = now;
  const size_t size = encodeMotorsAndPosture(now, Payload());
  const FrameHeader header = {MOTORS_AND_POSTURE_PUSH, 0, 0, static_cast<unsigned>(size)};
  encodeFrameHeader(header, message_);
  outbox_.Add(message_, FRAME_HEADER_SIZE + size);
}

// Takes the place of telemetry that still waits.
void Version2::PushTelemetry(unsigned frame) {
  const JointControl& joints = robot_.joints;
  const SensorDriver& sensors = robot_.sensors;
  Telemetry telemetry;
  telemetry.frame_number = frame;
  telemetry.count = static_cast<unsigned short>(joints.NumberOfJoints());
  for (int i = 0; i < joints.NumberOfJoints(); ++i) {
    const TelemetryEntry entry = {GROUP_JOINT, joints.Identifier(i), joints.Position(i)};
    telemetry.entries[i] = entry;
  }
  for (int i = 0; i < sensors.NumberOfSensors(); ++i) {
    if (sensors.HasValue(i)) {
      const robot_model::Sensor& sensor = sensors.Sensor(i);
      const TelemetryEntry entry = {GROUP_SENSOR, sensor.identifier,
                                    protocol::version2SensorValue(sensor.kind, sensors.Value(i))};
      telemetry.entries[telemetry.count] = entry;
      ++telemetry.count;
    }
  }
  const bool with_duty = (content_ & TELEMETRY_WITH_DUTY) != 0;
  for (int i = 0; with_duty && i < joints.NumberOfJoints(); ++i) {
    const TelemetryEntry entry = {GROUP_DUTY, joints.Identifier(i), MillionthsOfFullDuty(joints.Duty(i))};
    telemetry.entries[telemetry.count] = entry;
    ++telemetry.count;
  }
  if ((content_ & TELEMETRY_WITH_WALK) != 0) {
    AddWalk(robot_.joints.Walking(), &telemetry);
  }
  const size_t size = encodeTelemetry(telemetry, Payload());
  const FrameHeader header = {TELEMETRY_PUSH, 0, 0, static_cast<unsigned>(size)};
  encodeFrameHeader(header, message_);
  outbox_.Telemetry().Set(message_, FRAME_HEADER_SIZE + size);
}
