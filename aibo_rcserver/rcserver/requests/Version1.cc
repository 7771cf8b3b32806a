#include "rcserver/requests/Version1.h"

#include <ctype.h>
#include <string.h>

#include <algorithm>

#include "protocol/units.h"

using namespace protocol;
using robot_model::NO_JOINT;

const int Version1::IDENTIFIERS;

Version1::Version1(const Robot& robot, const Settings& settings, FileOrder& files, ImageObserver& pictures,
                   Outbox& outbox, unsigned char* upload_buffer)
    : robot_(robot),
      settings_(settings),
      files_(files),
      pictures_(pictures),
      outbox_(outbox),
      request_(),
      upload_buffer_(upload_buffer) {
  Begin();
}

void Version1::Begin() {
  is_uploading_ = false;
  std::fill(is_left_out_, is_left_out_ + IDENTIFIERS, false);
}

void Version1::Handle(const Request& request) {
  request_ = request;
  if (request.valid && IsForMotions()) {
    HandleMotion();
  } else if (!request.valid || !Execute()) {
    Refuse(ERROR_REFUSED);
  }
}

// Sends the request's letter in lower case, its identifier and a value.
void Version1::Reply(short value) {
  Send(static_cast<char>(tolower(request_.basic.command)), request_.basic.identifier, value);
}

void Version1::Refuse(ErrorCode code) {
  Send(REPLY_ERROR, 0, static_cast<short>(code));
}

void Version1::Send(char letter, unsigned char identifier, short value) {
  const ValueReply reply = {letter, identifier, value};
  unsigned char message[VALUE_REPLY_SIZE];
  encodeValueReply(reply, message);
  outbox_.Add(message, sizeof(message));
}

bool Version1::Execute() {
  PictureOrder order = {limitJpegQuality(request_.basic.identifier), 0, 0, PictureOrder::FOR_REQUEST};
  switch (request_.basic.command) {
    case REQUEST_PICTURE:
      return pictures_.RequestPicture(order);
    case REQUEST_STREAM_TOGGLE:
      order.purpose = PictureOrder::FOR_STREAM;
      pictures_.IsStreaming() ? pictures_.StopStream() : pictures_.StartStream(order, 1);
      return true;
    case REQUEST_JOINT:
      return MoveOrReadJoints();
    case REQUEST_MAX_VELOCITY:
    case REQUEST_MAX_ACCELERATION:
      return LimitJoint();
    case REQUEST_SENSOR:
      return ReadOrSelectValue();
    case REQUEST_LED:
    case REQUEST_FACE_LEDS:
      return SetLeds();
    case REQUEST_EARS:
      return SetEars();
    case REQUEST_SHUT_DOWN:
      return GoOff(POWER_SHUT_DOWN, settings_.allow_shut_down);
    case REQUEST_REBOOT:
      return GoOff(POWER_REBOOT, settings_.allow_reboot);
    default:
      return false;
  }
}

// Moves or reads a joint. All joints at once can only be moved.
bool Version1::MoveOrReadJoints() {
  const JointControl& joints = robot_.joints;
  const bool is_for_all = Identifier() == ALL_IDENTIFIERS;
  if (is_for_all && !IsWrite()) {
    return false;
  }
  version2::JointTargets targets = {0, 0, {}};
  bool has_fault = false;
  for (int i = 0; i < joints.NumberOfJoints(); ++i) {
    if (is_for_all || joints.Identifier(i) == Identifier()) {
      const version2::JointValue target = {joints.Identifier(i),
                                           IsWrite() ? microradiansFromCentidegrees(Value()) : joints.Position(i)};
      targets.joints[targets.count++] = target;
      has_fault = HasFault(i) || has_fault;
    }
  }
  if (targets.count == 0 || has_fault || (IsWrite() && !MayMove())) {
    return false;
  }
  if (IsWrite()) {
    robot_.joints.SetTargets(&targets);
  }
  Reply(is_for_all ? Value() : centidegreesFromMicroradians(targets.joints[0].value));
  return true;
}

// Returns false if the motors are off, or if the order may have been delayed.
bool Version1::MayMove() const {
  return robot_.motors.AreOn() && !robot_.clock.MayHaveWaited();
}

// A version 1 server only replies, so it reports a fault by refusing the next request about the joint, once.
bool Version1::HasFault(int joint) {
  return robot_.joints.TakeFault(joint) != JointWatch::FOLLOWS;
}

bool Version1::LimitJoint() {
  const int joint = Identifier() == ALL_IDENTIFIERS ? NO_JOINT : robot_.joints.Find(Identifier());
  if (joint == NO_JOINT) {
    return false;
  }
  JointPlanner& planner = robot_.joints.Planner();
  const bool is_speed = request_.basic.command == REQUEST_MAX_VELOCITY;
  if (IsWrite()) {
    const int limit = microradiansFromCentidegrees(Value());
    if (limit <= 0) {
      return false;  // with this limit, the joint would not move any more
    }
    is_speed ? planner.SetSpeedLimit(joint, limit) : planner.SetAccelerationLimit(joint, limit);
  }
  Reply(centidegreesFromMicroradians(is_speed ? planner.SpeedLimit(joint) : planner.AccelerationLimit(joint)));
  return true;
}

// Reads a value, adds it to the block, or removes it from the block.
bool Version1::ReadOrSelectValue() {
  if (Identifier() == ALL_IDENTIFIERS) {
    if (!IsWrite()) {
      ReadBlock();
    }
    return !IsWrite();
  }
  short value = 0;
  if (!Measure(Identifier(), &value) || (IsWrite() && Value() != 0 && Value() != 1)) {
    return false;
  }
  if (IsWrite()) {
    is_left_out_[Identifier()] = Value() == 0;
    value = Value();
  }
  Reply(value);
  return true;
}

// Sends values without a header, in ascending order of their identifiers.
void Version1::ReadBlock() {
  unsigned char block[IDENTIFIERS * VALUE_SIZE];
  size_t size = 0;
  for (int identifier = 1; identifier < IDENTIFIERS; ++identifier) {
    short value = 0;
    if (!is_left_out_[identifier] && Measure(identifier, &value)) {
      encodeValue(value, block + size);
      size += VALUE_SIZE;
    }
  }
  outbox_.Add(block, size);
  Reply(0);
}

// The angle of the joint with this identifier, or the value of the sensor. A sensor that has not measured yet reads as
// 0, so that each value keeps its place in the block. The result is false if there is no such part.
bool Version1::Measure(int identifier, short* value) const {
  const int joint = robot_.joints.Find(identifier);
  const int sensor = robot_.sensors.Find(identifier);
  if (joint != NO_JOINT) {
    *value = centidegreesFromMicroradians(robot_.joints.Position(joint));
  } else if (sensor != robot_model::NO_SENSOR) {
    *value = version1SensorValue(robot_.sensors.Sensor(sensor).kind, robot_.sensors.Value(sensor));
  }
  return joint != NO_JOINT || sensor != robot_model::NO_SENSOR;
}

// `L` keeps the mode of each LED. The reply for one LED has the intensity that it can show.
bool Version1::SetLeds() {
  const robot_model::RobotModel& robot = robot_.lights.Robot();
  const bool is_face = request_.basic.command == REQUEST_FACE_LEDS;
  const bool is_for_all = is_face || Identifier() == ALL_IDENTIFIERS;
  bool is_any = false;
  unsigned char intensity = ledIntensity(Value());
  for (int i = 0; i < robot.number_of_leds; ++i) {
    if (is_for_all || robot.leds[i].identifier == Identifier()) {
      const LightDriver::LedState wanted = {ledIntensity(Value()),
                                            is_face ? Identifier() != FACE_MODE_A : robot_.lights.Led(i).is_mode_b};
      const LightDriver::LedState accepted = robot_.lights.SetLed(i, wanted);
      intensity = is_for_all ? intensity : accepted.intensity;
      is_any = true;
    }
  }
  if (is_any) {
    Reply(intensity);
  }
  return is_any;
}

// If the request is for both ears, the reply says whether both are drawn.
bool Version1::SetEars() {
  if (Value() != 0 && Value() != 1) {
    return false;
  }
  const robot_model::RobotModel& robot = robot_.lights.Robot();
  bool is_any = false;
  bool are_drawn = true;
  for (int i = 0; i < robot.number_of_ears; ++i) {
    if (Identifier() == ALL_IDENTIFIERS || robot.ears[i].identifier == Identifier()) {
      is_any = true;
      are_drawn = robot_.lights.SetEar(i, Value() == 1) && are_drawn;
    }
  }
  if (is_any) {
    Reply(are_drawn ? 1 : 0);
  }
  return is_any;
}

bool Version1::GoOff(PowerOrder order, bool is_allowed) {
  if (is_allowed) {
    robot_.power_order = order;
    Reply(0);
  }
  return is_allowed;
}

bool Version1::IsForMotions() const {
  return request_.basic.command == REQUEST_UPLOAD_MOTION || request_.basic.command == REQUEST_DELETE_MOTION ||
         request_.basic.command == REQUEST_PLAY_MOTION;
}

void Version1::HandleMotion() {
  const FileRequest file = decodeFileRequest(request_.payload);
  const bool stops = request_.basic.command == REQUEST_PLAY_MOTION && file.a == 0;
  const bool is_for_all = stops && file.name[0] == '\0';
  MotionName name = "";
  if (!is_for_all && readMotionName(file.name, strlen(file.name), name) != NULL) {
    Refuse(ERROR_NOT_A_MOTION);
    return;
  }
  if (stops) {
    robot_.joints.Motions().Stop(name);
    Answer(FileOrder::DONE);
    return;
  }
  switch (request_.basic.command) {
    case REQUEST_UPLOAD_MOTION:
      BeginUpload(name, contentSize(file));
      break;
    case REQUEST_DELETE_MOTION:
      Answer(settings_.allow_delete ? files_.Post(FileJob::DELETE, MOTION_FILE, name) : FileOrder::REFUSED);
      break;
    default:
      Answer(robot_.clock.MayHaveWaited() ? FileOrder::REFUSED : files_.PlayMotion(name, file.a, false));
      break;
  }
}

// Begins an upload. If it is refused here, the reader skips its content.
void Version1::BeginUpload(const MotionName& name, size_t size) {
  if (!settings_.allow_upload || size > mtn::MAX_FILE_SIZE) {
    Refuse(ERROR_REFUSED);
    return;
  }
  is_uploading_ = true;
  strcpy(upload_name_, name);
  uploaded_ = 0;
}

bool Version1::TakeContent(RequestReader& reader) {
  if (!is_uploading_) {
    return true;
  }
  uploaded_ += reader.takeContent(upload_buffer_ + uploaded_, mtn::MAX_FILE_SIZE - uploaded_);
  if (reader.contentLeft() > 0) {
    return false;
  }
  is_uploading_ = false;
  Answer(files_.StoreMotion(upload_name_, upload_buffer_, uploaded_, false));
  return true;
}

void Version1::Answer(FileOrder::Outcome outcome) {
  switch (outcome) {
    case FileOrder::DONE:
      Reply(0);
      break;
    case FileOrder::PENDING:
      break;
    case FileOrder::REFUSED:
      Refuse(ERROR_REFUSED);
      break;
    case FileOrder::FILE_MISSING:
      Refuse(ERROR_FILE_MISSING);
      break;
  }
}
