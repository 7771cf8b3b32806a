#include "rcserver/requests/Version2.h"

#include <stdio.h>
#include <string.h>

#include "protocol/motion_requests.h"
#include "protocol/picture_datagram.h"
#include "protocol/sound_requests.h"
#include "protocol/stick_pictures.h"
#include "protocol/units.h"

using namespace protocol::version2;
using robot_model::NO_EAR;
using robot_model::NO_JOINT;
using robot_model::NO_LED;

namespace {

const char SERVER_NAME[] = "aibo_rcserver 0.1.0";

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

// This order of operations does not overflow, because a duty has 16 bits.
int MillionthsOfFullDuty(int duty) {
  return duty * (1000000 / 64) / (FULL_DUTY / 64);
}

double WholeThousandths(double value) {
  return static_cast<int>(value * 1000 + (value < 0 ? -1e-6 : 1e-6)) * 1e-3;
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

// Defined in Version2Colors.cc, Version2Motions.cc, Version2Pictures.cc and Version2Sound.cc; all others are below.
template <>
void Version2::CarryOut<REQUEST_COLORS>();
template <>
void Version2::CarryOut<REQUEST_PLAY>();
template <>
void Version2::CarryOut<REQUEST_LIST>();
template <>
void Version2::CarryOut<REQUEST_UPLOAD>();
template <>
void Version2::CarryOut<REQUEST_DELETE>();
template <>
void Version2::CarryOut<REQUEST_SAVE_PICTURE>();
template <>
void Version2::CarryOut<REQUEST_PICTURES>();
template <>
void Version2::CarryOut<REQUEST_SOUND>();

const char Version2::TOO_MANY_OWED[] = "too many pictures are owed already; wait until some have come";

Version2::Version2(const Robot& robot, const Settings& settings, FileOrder& files, MotionCommands& motions,
                   ImageObserver& camera, Outbox& outbox)
    : robot_(robot),
      settings_(settings),
      files_(files),
      motions_(motions),
      camera_(camera),
      outbox_(outbox),
      request_(),
      payload_(NULL),
      now_(0),
      pending_(),
      play_not_after_(0),
      client_() {
  char* end = capabilities_;
  for (const Row* row = ROWS; row->request != NULL; ++row) {
    if (Serves(*row) && (row->is_allowed == NULL || settings.*row->is_allowed)) {
      end += sprintf(end, "%s%c", row == ROWS ? "" : " ", row->request->letter);
    }
  }
}

void Version2::Handle(const FrameHeader& request, const unsigned char* payload, unsigned now) {
  request_ = request;
  payload_ = payload;
  now_ = now;
  if (request.request_number == 0) {
    Refuse(CODE_REFUSED, "bad request: number 0 is reserved for messages that the server pushes; use 1 to 65535");
    return;
  }
  Execute();
}

bool Version2::Serves(const Row& row) const {
  return !row.request->has(MOVES_BODY) || robot_.joints.Walking().CanWalk();
}

void Version2::Execute() {
  for (const Row* row = ROWS; row->request != NULL; ++row) {
    if (row->request->letter == request_.kind && Serves(*row)) {
      if (IsAllowed(row->is_allowed, row->request->setting)) {
        (this->*row->carry_out)();
      }
      return;
    }
  }
  char text[MAX_ERROR_TEXT_SIZE];
  sprintf(text, "not supported: this server knows the requests %s", capabilities_);
  Refuse(CODE_NOT_SUPPORTED, text);
}

// Refuses the request unless RCSERVER.CFG allows it.
bool Version2::IsAllowed(bool Settings::*setting, const char* name) {
  const bool is_allowed = setting == NULL || settings_.*setting;
  if (!is_allowed) {
    char text[MAX_ERROR_TEXT_SIZE];
    sprintf(text, "this is not allowed; %s=yes in RCSERVER.CFG on the memory stick allows it", name);
    Refuse(CODE_REFUSED, text);
  }
  return is_allowed;
}

void Version2::RefuseTooLarge(const FrameHeader& request) {
  request_ = request;
  char text[MAX_ERROR_TEXT_SIZE];
  sprintf(text, "a request of %u bytes is too large; the server closes the connection", request.payload_size);
  Refuse(CODE_REFUSED, text);
}

void Version2::PushPowerOff(const char* reason) {
  if (outbox_.HasRoom()) {
    SendError(0, CODE_POWER, reason);
  }
}

bool Version2::AskForSign() {
  const bool has_room = outbox_.HasRoom();
  if (has_room) {
    Send(replyKind(REQUEST_HELLO), 0, NoPayload());
  }
  return has_room;
}

void Version2::PushReports() {
  PushJointFaults();
  PushRecoveries();
  if (outbox_.HasRoom()) {
    PushEnds();
  }
  PushFall();
  PushSoundEnds();
}

void Version2::Measured(unsigned frame) {
  PushReports();
  PushMotorsAndPosture();
  if (client_.telemetry_period != 0 &&
      (!client_.has_pushed_telemetry || frame - client_.last_telemetry >= client_.telemetry_period)) {
    client_.has_pushed_telemetry = true;
    client_.last_telemetry = frame;
    PushTelemetry(frame);
  }
}

// Completes the message whose payload has been written to Payload().
size_t Version2::Frame(char kind, unsigned char id, unsigned short request_number, size_t payload_size) {
  const FrameHeader header = {kind, id, request_number, static_cast<unsigned>(payload_size)};
  return encode(header, message_) + payload_size;
}

// Sends a small message, but leaves the one in message_ alone.
void Version2::Send(char kind, unsigned short request_number, const unsigned char* payload, size_t size) {
  const FrameHeader header = {kind, 0, request_number, static_cast<unsigned>(size)};
  unsigned char bytes[FRAME_HEADER_SIZE];
  outbox_.Add(bytes, encode(header, bytes));
  outbox_.Add(payload, size);
}

// Answers the request with the payload in Payload(), after what it has ended.
void Version2::FinishReply(size_t payload_size) {
  PushEnds();
  outbox_.Add(message_, Frame(replyKind(request_.kind), request_.id, request_.request_number, payload_size));
}

void Version2::Refuse(unsigned short code, const char* text) {
  PushEnds();
  SendError(request_.request_number, code, text);
}

void Version2::SendError(unsigned short request_number, unsigned short code, const char* text) {
  const ErrorMessage error = {code, text, strlen(text)};
  Send(ERROR_MESSAGE, request_number, error);
}

void Version2::SendEnd(unsigned char what, unsigned char how, unsigned short order, const char* name,
                       const char* reason) {
  const EndMessage end = {what, how, order, name, strlen(name), reason, strlen(reason)};
  Send(END_PUSH, 0, end);
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

bool Version2::HasNoPayload() {
  NoPayload none;
  return Decode(&none);
}

template <>
void Version2::CarryOut<REQUEST_HELLO>() {
  JointControl& joints = robot_.joints;
  Hello hello;
  CopyText(robot_.design, hello.robot);
  CopyText(SERVER_NAME, hello.server);
  CopyText(capabilities_, hello.capabilities);
  hello.frame_number = now_;
  hello.joint_count = static_cast<unsigned char>(joints.NumberOfJoints());
  for (int i = 0; i < joints.NumberOfJoints(); ++i) {
    const robot_model::Joint& joint = joints.Robot().joints[i];
    const JointLimits limits = {joint.identifier, joint.lowest, joint.highest, joint.highest_speed};
    hello.joints[i] = limits;
  }
  const WalkLimits none = {0, 0, 0, 0};
  hello.walk = joints.Walking().CanWalk() ? joints.Walking().Parameters().highest : none;
  hello.walk.forward = joints.Walking().CanWalk() ? joints.Walking().Parameters().fastest : 0;
  FinishReply(encodeHello(hello, Payload()));
}

template <>
void Version2::CarryOut<REQUEST_PICTURE>() {
  PictureRequest wanted;
  if (Decode(&wanted) && MakesLayer(wanted.layer) &&
      !camera_.RequestPicture(OrderOf(JpegQuality(request_.id), wanted.layer, request_.request_number))) {
    Refuse(CODE_REFUSED, TOO_MANY_OWED);
  }
}

unsigned char Version2::JpegQuality(unsigned char id) {
  return id == SERVER_DEFAULT_QUALITY ? protocol::DEFAULT_JPEG_QUALITY : protocol::limitJpegQuality(id);
}

template <>
void Version2::CarryOut<REQUEST_STREAM>() {
  StreamSettings stream;
  if (!Decode(&stream) || !MakesLayer(stream.layer)) {
    return;
  }
  if (stream.on) {
    camera_.StartStream(OrderOf(JpegQuality(request_.id), stream.layer, 0), stream.every_nth_image);
  } else {
    camera_.StopStream();
  }
  request_.id = JpegQuality(request_.id);  // the reply contains the quality in use
  Reply(stream);
}

bool Version2::MakesLayer(Layer layer) {
  const bool makes = layer != LAYER_DOUBLE || camera_.HasDetail();
  if (!makes) {
    Refuse(CODE_NOT_SUPPORTED, "not supported: this robot's camera has no bands for double resolution");
  }
  return makes;
}

template <>
void Version2::CarryOut<REQUEST_CAMERA>() {
  CameraValue wanted = {request_.id, 0};
  const bool is_read = request_.payload_size == 0;
  if (!IsWellFormed(problemOfCameraValue(request_.id, 1)) || (!is_read && !Decode(&wanted))) {
    return;
  }
  const CameraSetting setting = static_cast<CameraSetting>(request_.id);
  if (!is_read && !robot_.camera.Set(setting, wanted.value)) {
    Refuse(CODE_REFUSED, "the robot's camera does not take this setting; the robot's console says why");
    return;
  }
  wanted.value = robot_.camera.Settings().of(setting);
  Reply(wanted);
}

template <>
void Version2::CarryOut<REQUEST_DATAGRAMS>() {
  DatagramOrder order;
  if (!Decode(&order)) {
    return;
  }
  if (order.port == 0) {
    robot_.datagrams.HandOver();
  } else if (!robot_.datagrams.SendTo(order)) {
    Refuse(CODE_REFUSED, "the IPStack has no endpoint for datagrams; pictures go over this connection");
    return;
  }
  Reply(order);
}

template <>
void Version2::CarryOut<REQUEST_JOINTS>() {
  JointOrder order;
  if (!Decode(&order)) {
    return;
  }
  if (!robot_.motors.AreOn()) {
    Refuse(CODE_REFUSED, "the motors are off; switch them on first");
    return;
  }
  JointTargets& targets = order.targets;
  if (IsTooOld(order.not_after) || !HasJoints(targets.joints, targets.count)) {
    return;
  }
  robot_.joints.SetTargets(&targets, request_.request_number);
  Reply(targets);
}

template <>
void Version2::CarryOut<REQUEST_SPEED_LIMITS>() {
  SpeedLimits limits;
  if (!Decode(&limits) || !HasJoints(limits.joints, limits.count) || !ArePositive(limits)) {
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
  Reply(limits);
}

bool Version2::ArePositive(const SpeedLimits& limits) {
  for (int i = 0; i < limits.count; ++i) {
    if (limits.joints[i].value <= 0) {
      Refuse(CODE_REFUSED, "a speed limit must be above 0, so nothing of the request was done");
      return false;
    }
  }
  return true;
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
  sprintf(text, "this robot has no %s %d, so the whole request was refused", part, identifier);
  Refuse(CODE_REFUSED, text);
}

template <>
void Version2::CarryOut<REQUEST_MOTORS>() {
  MotorSwitch& motors = robot_.motors;
  if (request_.payload_size > 0) {
    MotorOrder order;
    if (!Decode(&order) || (order.on && IsTooOld(order.not_after))) {
      return;
    }
    if (!motors.Switch(order.on)) {
      Refuse(CODE_REFUSED, CANNOT_SWITCH_ON);
      return;
    }
    if (!order.on) {
      EndWaitingMotion(ALL_MOTIONS, "is not played: the motors were switched off before its file had been read");
    }
  }
  const MotorState state = {motors.AreOn()};
  Reply(state);
}

template <>
void Version2::CarryOut<REQUEST_HOLD>() {
  switch (request_.id) {
    case HOLD_EVERYTHING:
      if (HasNoPayload()) {
        robot_.joints.StopAll();
        EndWaitingMotion(ALL_MOTIONS, "is not played: everything was told to hold before its file had been read");
        Reply(NoPayload());
      }
      break;
    case HOLD_JOINTS:
      HoldJoints();
      break;
    default:
      Refuse(CODE_REFUSED, "bad request: the id is neither 0 (hold everything) nor 1 (the joints named)");
  }
}

// A motion whose file has not been read yet is refused if it moves one of them: see JointControl::Ordered().
void Version2::HoldJoints() {
  JointIds named;
  if (!Decode(&named)) {
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
  Reply(NoPayload());
}

// Velocities are whole mm/s and mrad/s on the wire. The velocities in force are rounded down, so that a client can send
// them back unchanged.
template <>
void Version2::CarryOut<REQUEST_STEER>() {
  SteeringOrder order;
  if (!Decode(&order)) {
    return;
  }
  const protocol::version2::Velocity& wanted = order.velocity;
  Walker& walker = robot_.joints.Walking();
  const bool is_guarded = (request_.id & STEER_GUARDED) != 0;
  if (!wanted.isZero()) {
    if (IsTooOld(order.not_after)) {
      return;
    }
    if (const char* const problem = walker.ProblemOfWalk(robot_.motors.AreOn(), is_guarded ? &wanted : NULL)) {
      return Refuse(CODE_REFUSED, problem);
    }
  }
  const protocol::version2::Velocity accepted = robot_.joints.Steer(wanted, is_guarded, request_.request_number);
  const Steered steered = {
      {WholeThousandths(accepted.forward), WholeThousandths(accepted.left), WholeThousandths(accepted.turn)},
      walker.WalkNumber()};
  Reply(steered);
}

template <>
void Version2::CarryOut<REQUEST_POSTURE>() {
  PostureOrder order;
  if (!Decode(&order)) {
    return;
  }
  if (!canTake(request_.id)) {
    Refuse(CODE_REFUSED, "bad request: the id is not one of the postures 1 (stand), 2 (sit) and 3 (rest)");
    return;
  }
  const Posture posture = static_cast<Posture>(request_.id);
  if (!IsTooOld(order.not_after) && MayTake(posture)) {
    robot_.joints.Take(posture, request_.request_number);
    Reply(NoPayload());
  }
}

// Switches the motors on if they are off after a rest. Refuses the request if the robot cannot take the posture now.
bool Version2::MayTake(Posture posture) {
  const char* problem = robot_.joints.Walking().Problem(posture);
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

// Refuses an order that has expired.
bool Version2::IsTooOld(unsigned not_after) {
  const bool is_too_old = protocol::version2::isTooOld(not_after, now_);
  if (is_too_old) {
    Refuse(CODE_TOO_OLD, "too old: the order came after its time; send it again");
  }
  return is_too_old;
}

template <>
void Version2::CarryOut<REQUEST_TELEMETRY>() {
  TelemetryPeriod period;
  if (Decode(&period)) {
    client_.telemetry_period = period.frames = WholeSensorPeriods(period.frames);
    client_.content = static_cast<unsigned char>(request_.id & TELEMETRY_WITH_DUTY);
    request_.id = client_.content;
    client_.has_pushed_telemetry = false;
    outbox_.Telemetry().Drop();
    Reply(period);
  }
}

template <>
void Version2::CarryOut<REQUEST_LEDS>() {
  LedValues values;
  if (!Decode(&values)) {
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
  Reply(values);
}

template <>
void Version2::CarryOut<REQUEST_EARS>() {
  EarPositions ears;
  if (Decode(&ears)) {
    ears.left = SetEar(LEFT, ears.left);
    ears.right = SetEar(RIGHT, ears.right);
    Reply(ears);
  }
}

bool Version2::SetEar(int identifier, bool draw) {
  const int ear = robot_.lights.FindEar(identifier);
  return ear != NO_EAR && robot_.lights.SetEar(ear, draw);
}

void Version2::GoOff(PowerOrder order) {
  if (HasNoPayload()) {
    robot_.power_order = order;
    Reply(NoPayload());
  }
}

template <>
void Version2::CarryOut<REQUEST_SHUT_DOWN>() {
  GoOff(POWER_SHUT_DOWN);
}

template <>
void Version2::CarryOut<REQUEST_REBOOT>() {
  GoOff(POWER_REBOOT);
}

// The hello lists the letters in this order.
const Version2::Row Version2::ROWS[] = {
    {&SAY_HELLO, &Version2::CarryOut<REQUEST_HELLO>, NULL},
    {&TAKE_PICTURE, &Version2::CarryOut<REQUEST_PICTURE>, NULL},
    {&STREAM_PICTURES, &Version2::CarryOut<REQUEST_STREAM>, NULL},
    {&MOVE_JOINTS, &Version2::CarryOut<REQUEST_JOINTS>, NULL},
    {&LIMIT_SPEEDS, &Version2::CarryOut<REQUEST_SPEED_LIMITS>, NULL},
    {&SEND_TELEMETRY, &Version2::CarryOut<REQUEST_TELEMETRY>, NULL},
    {&TELL_OF_MOTORS, &Version2::CarryOut<REQUEST_MOTORS>, NULL},
    {&HOLD, &Version2::CarryOut<REQUEST_HOLD>, NULL},
    {&SET_LEDS, &Version2::CarryOut<REQUEST_LEDS>, NULL},
    {&MOVE_EARS, &Version2::CarryOut<REQUEST_EARS>, NULL},
    {&SET_CAMERA, &Version2::CarryOut<REQUEST_CAMERA>, NULL},
    {&DETECT_COLORS, &Version2::CarryOut<REQUEST_COLORS>, NULL},
    {&SEND_DATAGRAMS, &Version2::CarryOut<REQUEST_DATAGRAMS>, NULL},
    {&PLAY_MOTION, &Version2::CarryOut<REQUEST_PLAY>, NULL},
    {&LIST_MOTIONS, &Version2::CarryOut<REQUEST_LIST>, NULL},
    {&PLAY_SOUND, &Version2::CarryOut<REQUEST_SOUND>, NULL},
    {&STEER, &Version2::CarryOut<REQUEST_STEER>, NULL},
    {&TAKE_POSTURE, &Version2::CarryOut<REQUEST_POSTURE>, NULL},
    {&STORE_MOTION, &Version2::CarryOut<REQUEST_UPLOAD>, &Settings::allow_upload},
    {&DELETE_MOTION, &Version2::CarryOut<REQUEST_DELETE>, &Settings::allow_delete},
    {&SAVE_PICTURE, &Version2::CarryOut<REQUEST_SAVE_PICTURE>, &Settings::allow_pictures},
    {&LIST_STICK_PICTURES, &Version2::CarryOut<REQUEST_PICTURES>, &Settings::allow_pictures},
    {&SHUT_DOWN, &Version2::CarryOut<REQUEST_SHUT_DOWN>, &Settings::allow_shut_down},
    {&REBOOT, &Version2::CarryOut<REQUEST_REBOOT>, &Settings::allow_reboot},
    {NULL, NULL, NULL},
};

// A fault that does not fit in the outbox is pushed the next time.
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
      SendEnd(ENDED_JAM, END_DONE, 0, robot_.joints.Name(i), "it follows its commands again");
    }
  }
}

// Call it only if there is room.
void Version2::PushEnds() {
  OrderBook::Ended end;
  while (robot_.joints.Orders().Take(OrderBook::CLIENT, &end)) {
    SendEnd(end.what, end.how, end.number, end.name, end.reason);
  }
}

void Version2::PushFall() {
  if (outbox_.HasRoom() && robot_.joints.Walking().TakeSoftened()) {
    SendError(0, CODE_REFUSED, "the robot has fallen: its motors are off, so that its legs are limp");
  }
}

void Version2::PushMotorsAndPosture() {
  const MotorsAndPosture now = {robot_.motors.AreOn(), static_cast<unsigned char>(robot_.joints.Posture())};
  const bool is_told =
      client_.has_told_motors && now.motors_on == client_.told.motors_on && now.posture == client_.told.posture;
  if (is_told || !outbox_.HasRoom()) {
    return;
  }
  client_.has_told_motors = true;
  client_.told = now;
  Send(MOTORS_AND_POSTURE_PUSH, 0, now);
}

// Replaces telemetry that still waits.
void Version2::PushTelemetry(unsigned frame) {
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
  const bool with_duty = (client_.content & TELEMETRY_WITH_DUTY) != 0;
  for (int i = 0; with_duty && i < joints.NumberOfJoints(); ++i) {
    Add(GROUP_DUTY, joints.Identifier(i), MillionthsOfFullDuty(joints.Duty(i)), &telemetry);
  }
  if (robot_.joints.Walking().CanWalk()) {
    AddWalk(robot_.joints.Walking(), &telemetry);
  }
  outbox_.Telemetry().Set(message_, Frame(TELEMETRY_PUSH, 0, 0, encode(telemetry, Payload())));
}
