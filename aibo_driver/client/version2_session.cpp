#include "client/version2_session.h"

#include <algorithm>
#include <sstream>
#include <utility>

#include "aibo_driver/exceptions.h"
#include "client/fault.h"
#include "client/sensor_readings.h"
#include "client/units.h"
#include "protocol/hello.h"
#include "protocol/motion_requests.h"

namespace aibo_driver {

namespace version2 = protocol::version2;

namespace {

/// @throw ProtocolException if a decoder has found a problem
void expectGood(const char* problem, const char* what) {
  if (problem != nullptr) {
    throw ProtocolException(std::string("bad ") + what + ": " + problem);
  }
}

RobotInfo makeRobotInfo(const version2::Hello& hello) {
  RobotInfo robot;
  robot.design = hello.robot;
  robot.server = hello.server;
  std::istringstream words(hello.capabilities);
  for (std::string word; words >> word;) {
    robot.capabilities.push_back(word);
  }
  for (std::size_t i = 0; i < hello.joint_count; ++i) {
    const version2::JointLimits& joint = hello.joints[i];
    robot.joint_limits.push_back({joint.id, fromMicro(joint.lower), fromMicro(joint.upper), fromMicro(joint.speed)});
  }
  return robot;
}

}  // namespace

Version2Session::Version2Session(const SessionContext& context, TimePoint connected)
    : Session(context, connected),
      buffer_(version2::MAX_PAYLOAD_TOWARDS_CLIENT),
      reader_(buffer_.data(), buffer_.size()),
      next_hello_(connected) {}

void Version2Session::add(PictureRequest request, TimePoint now) {
  request.since = now;
  pictures_.add(std::move(request));
}

void Version2Session::failRequests(CallOutcome outcome, const std::string& problem) {
  pictures_.failAll(outcome, problem);
  calls_.failAll(outcome, problem);
}

Session::Bytes Version2Session::nextRequest(const Wish& wish, TimePoint now) {
  if (now >= next_hello_) {
    return requestHello(now);
  }
  if (!ready_) {
    return {};
  }
  if (wish.streaming != stream().on() || (wish.streaming && wish.jpeg_quality != stream().quality())) {
    return requestStream(wish, now);
  }
  if (const PictureRequest* call = pictures_.firstUnsent()) {
    return requestPicture(*call, wish);
  }
  if (const RobotRequest* call = calls_.firstUnsent()) {
    return mustWaitForSpeedLimits(*call) ? requestSpeedLimits(now) : requestCall(*call, now);
  }
  if (wish.telemetry_period != telemetry_period_) {
    return requestTelemetry(wish, now);
  }
  return nextCommand(now);
}

Session::Bytes Version2Session::requestHello(TimePoint now) {
  next_hello_ = now + kHeartbeatPeriod;
  return request(version2::REQUEST_HELLO, 0, nullptr, 0, now);
}

Session::Bytes Version2Session::requestStream(const Wish& wish, TimePoint now) {
  if (wish.streaming != stream().on()) {
    toggleStream(wish.jpeg_quality, now);
  }
  stream().setQuality(wish.jpeg_quality);
  unsigned char payload[version2::STREAM_SETTINGS_SIZE];
  const std::size_t size = version2::encodeStreamSettings({wish.streaming, version2::LAYER_HIGH, 1}, payload);
  return request(version2::REQUEST_STREAM, wish.jpeg_quality, payload, size, now);
}

Session::Bytes Version2Session::requestPicture(const PictureRequest& call, const Wish& wish) {
  unsigned char payload[version2::PICTURE_REQUEST_SIZE];
  const std::size_t size = version2::encodePictureRequest(version2::LAYER_HIGH, payload);
  const int quality = call.quality == 0 ? wish.jpeg_quality : call.quality;
  Bytes frame = makeFrame(version2::REQUEST_PICTURE, quality, payload, size);
  pictures_.sent(last_number_);
  return frame;
}

Session::Bytes Version2Session::requestTelemetry(const Wish& wish, TimePoint now) {
  telemetry_period_ = wish.telemetry_period;
  unsigned char payload[version2::TELEMETRY_PERIOD_SIZE];
  const auto frames = static_cast<unsigned short>(wish.telemetry_period);
  return request(version2::REQUEST_TELEMETRY, 0, payload, version2::encodeTelemetryPeriod(frames, payload), now);
}

Session::Bytes Version2Session::requestCall(const RobotRequest& call, TimePoint now) {
  const Bytes payload = encodeForVersion2(call);
  dropSupersededJointCommands(call);
  Bytes frame = makeFrame(call.letter, 0, payload.data(), payload.size());
  calls_.sent(last_number_);
  transferBegins(frame.size(), now);
  return frame;
}

long Version2Session::outstanding(char kind) const {
  return std::count_if(exchanges_.begin(), exchanges_.end(),
                       [kind](const auto& each) { return each.second.kind == kind; });
}

bool Version2Session::mayCommandJoints() const {
  return outstanding(version2::REQUEST_JOINTS) + outstanding(version2::REQUEST_SPEED_LIMITS) <
         kMostJointCommandsOutstanding;
}

Session::Bytes Version2Session::nextCommand(TimePoint now) {
  if (!commands_.speed_limits.empty() && mayCommandJoints()) {
    return requestSpeedLimits(now);
  }
  if (mayCommandJoints()) {
    dropStaleJointCommands(now);
    if (!commands_.joints.empty()) {
      return requestTargets(now);
    }
  }
  if (!commands_.leds.empty() && outstanding(version2::REQUEST_LEDS) == 0) {
    return requestLeds(now);
  }
  if (!commands_.ears.empty() && outstanding(version2::REQUEST_EARS) == 0) {
    return requestEars(now);
  }
  return {};
}

Session::Bytes Version2Session::requestSpeedLimits(TimePoint now) {
  version2::SpeedLimits limits = {};
  for (const JointSpeedLimit& limit : commands_.speed_limits.take(version2::MAX_JOINTS)) {
    limits.joints[limits.count++] = {static_cast<unsigned char>(limit.id), toMicro(limit.speed)};
  }
  unsigned char payload[version2::MAX_SPEED_LIMITS_SIZE];
  return request(version2::REQUEST_SPEED_LIMITS, 0, payload, version2::encodeSpeedLimits(limits, payload), now);
}

Session::Bytes Version2Session::requestTargets(TimePoint now) {
  const JointCommand command = commands_.joints.takeCommand();
  version2::JointTargets targets = {};
  targets.duration_ms = static_cast<unsigned short>(command.duration.count());
  for (const JointTarget& target : command.targets) {
    targets.joints[targets.count++] = {static_cast<unsigned char>(target.id), toMicro(target.position)};
  }
  unsigned char payload[version2::MAX_JOINT_TARGETS_SIZE];
  return request(version2::REQUEST_JOINTS, 0, payload, version2::encodeJointTargets(targets, payload), now);
}

Session::Bytes Version2Session::requestLeds(TimePoint now) {
  version2::LedValues values = {};
  for (const LedCommand& led : commands_.leds.take(version2::MAX_LEDS)) {
    values.leds[values.count++] = {static_cast<unsigned char>(led.id), static_cast<unsigned char>(led.intensity),
                                   led.mode == LedMode::kA ? version2::LED_MODE_A : version2::LED_MODE_B};
  }
  unsigned char payload[version2::MAX_LED_VALUES_SIZE];
  return request(version2::REQUEST_LEDS, 0, payload, version2::encodeLedValues(values, payload), now);
}

// They are always told together.
Session::Bytes Version2Session::requestEars(TimePoint now) {
  version2::EarPositions positions = {};
  for (const EarCommand& ear : commands_.ears.take(2)) {
    (ear.id == EarCommand::kLeft ? positions.left : positions.right) = ear.drawn;
  }
  unsigned char payload[version2::EAR_POSITIONS_SIZE];
  return request(version2::REQUEST_EARS, 0, payload, version2::encodeEarPositions(positions, payload), now);
}

Session::Bytes Version2Session::request(char kind, int id, const unsigned char* payload, std::size_t size,
                                        TimePoint now) {
  Bytes frame = makeFrame(kind, id, payload, size);
  exchanges_[last_number_] = {kind, now, answerLimit(now)};
  return frame;
}

Session::Bytes Version2Session::makeFrame(char kind, int id, const unsigned char* payload, std::size_t size) {
  last_number_ = nextNumber();
  version2::FrameHeader header = {};
  header.kind = kind;
  header.id = static_cast<unsigned char>(id);
  header.request_number = static_cast<unsigned short>(last_number_);
  header.payload_size = static_cast<unsigned>(size);
  Bytes frame(version2::FRAME_HEADER_SIZE);
  version2::encodeFrameHeader(header, frame.data());
  frame.insert(frame.end(), payload, payload + size);
  return frame;
}

int Version2Session::nextNumber() {
  int number = last_number_;
  do {
    number = number % 65535 + 1;
  } while (kindOf(number));
  return number;
}

/// @return the kind of the request with this number, if an answer to it is awaited
std::optional<char> Version2Session::kindOf(int number) const {
  const auto exchange = exchanges_.find(number);
  if (exchange != exchanges_.end()) {
    return exchange->second.kind;
  }
  if (const RobotRequest* call = calls_.get(number)) {
    return call->letter;
  }
  return pictures_.has(number) ? std::optional<char>(version2::REQUEST_PICTURE) : std::nullopt;
}

void Version2Session::parse(const std::uint8_t* data, std::size_t size) {
  while (size > 0) {
    if (reader_.isBetweenFrames()) {
      frame_began_ = now();
    }
    std::size_t taken = 0;
    const version2::FrameReader::Result result = reader_.append(data, size, &taken);
    data += taken;
    size -= taken;
    if (result == version2::FrameReader::FRAME_TOO_LARGE) {
      throw ProtocolException("a frame of " + std::to_string(reader_.header().payload_size) + " bytes; at most " +
                              std::to_string(version2::MAX_PAYLOAD_TOWARDS_CLIENT) + " are possible");
    }
    if (result == version2::FrameReader::FRAME_COMPLETE) {
      onFrame();
    }
  }
  if (!reader_.isBetweenFrames()) {
    signOfPicture(now());  // nothing else is so large that it comes in parts
  }
  if (telemetry_) {
    publish(*std::exchange(telemetry_, std::nullopt));
  }
}

void Version2Session::onFrame() {
  const version2::FrameHeader& header = reader_.header();
  const Payload payload = {reader_.payload(), header.payload_size};
  if (header.kind < 'a' || header.kind > 'z') {
    throw ProtocolException("a frame that begins with byte " + std::to_string(static_cast<unsigned char>(header.kind)));
  }
  if (header.request_number == 0) {
    onPush(header.kind, payload);
  } else {
    onReply(header.kind, header.request_number, payload);
  }
}

// Pushes of unknown kinds are for newer clients.
void Version2Session::onPush(char kind, const Payload& payload) {
  switch (kind) {
    case version2::PICTURE:
      return onStreamPicture(payload);
    case version2::TELEMETRY_PUSH:
      return onTelemetry(payload);
    case version2::ERROR_MESSAGE:
      return onReport(payload);
    default:
      return;
  }
}

void Version2Session::onReply(char kind, int number, const Payload& payload) {
  const std::optional<char> request_kind = kindOf(number);
  if (!request_kind) {
    return;  // whoever asked has stopped waiting
  }
  if (kind == version2::ERROR_MESSAGE) {
    onRefusal(*request_kind, number, payload);
  } else if (kind == version2::replyKind(*request_kind)) {
    onAnswer(*request_kind, number, payload);
  } else {
    throw ProtocolException(std::string("a reply '") + kind + "' to the request '" + *request_kind + "'");
  }
  exchanges_.erase(number);
}

void Version2Session::onAnswer(char request_kind, int number, const Payload& payload) {
  noteAcceptance(request_kind);
  switch (request_kind) {
    case version2::REQUEST_HELLO:
      return onHello(payload);
    case version2::REQUEST_PICTURE:
      return onRequestedPicture(number, payload);
    case version2::REQUEST_JOINTS:
      return onJointsAccepted(payload);
    default:
      // Stream, speed limits, telemetry, LEDs and ears are from now on as the server says.
      return calls_.has(number) ? onCallAnswered(number, payload) : void();
  }
}

void Version2Session::onHello(const Payload& payload) {
  version2::Hello hello;
  expectGood(version2::decodeHello(payload.data, payload.size, &hello), "hello");
  robot_ = makeRobotInfo(hello);
  ready_ = true;
}

Session::MutablePicturePtr Version2Session::takePictureFrom(const Payload& payload) {
  signOfPicture(now());
  version2::ImageHeader header;
  std::size_t size = 0;
  expectGood(version2::decodePicture(payload.data, payload.size, &header, &size), "picture");
  const unsigned char* jpeg = payload.data + version2::IMAGE_HEADER_SIZE;
  MutablePicturePtr picture = inspect(Bytes(jpeg, jpeg + size), frame_began_);
  if (picture) {
    picture->frame_number = header.frame_number;
    picture->image_count = header.image_count;
  }
  return picture;
}

void Version2Session::onStreamPicture(const Payload& payload) {
  const PicturePtr picture = takePictureFrom(payload);
  if (!picture) {
    return;
  }
  if (stream().on()) {
    publishFromStream(picture);
  } else {
    dropUnexpected();
  }
}

void Version2Session::onRequestedPicture(int number, const Payload& payload) {
  const PicturePtr picture = takePictureFrom(payload);
  if (!picture) {
    pictures_.sendAgain(number);  // as long as the time of the call allows
    return;
  }
  publish(picture);
  pictures_.take(number)->answer(picture, 0);
}

void Version2Session::onTelemetry(const Payload& payload) {
  version2::Telemetry measured;
  expectGood(version2::decodeTelemetry(payload.data, payload.size, &measured), "telemetry");
  telemetry_ = Telemetry();
  telemetry_->frame_number = measured.frame_number;
  telemetry_->arrival = frame_began_;
  for (std::size_t i = 0; i < measured.count; ++i) {
    const version2::TelemetryEntry& entry = measured.entries[i];
    if (entry.group == version2::GROUP_JOINT) {
      telemetry_->joints.push_back({entry.id, fromMicro(entry.value)});
    } else {
      telemetry_->sensors.push_back(makeVersion2Reading(robot().design, entry.id, entry.value));
    }
  }
}

void Version2Session::onJointsAccepted(const Payload& payload) {
  version2::JointTargets accepted;
  expectGood(version2::decodeJointTargets(payload.data, payload.size, &accepted), "reply to joint targets");
  std::vector<JointTarget> targets;
  for (std::size_t i = 0; i < accepted.count; ++i) {
    targets.push_back({accepted.joints[i].id, fromMicro(accepted.joints[i].value)});
  }
  publishAccepted(targets);
}

void Version2Session::onCallAnswered(int number, const Payload& payload) {
  RobotAnswer answer;
  const char letter = calls_.get(number)->letter;
  if (letter == version2::REQUEST_MOTORS) {
    expectGood(version2::decodeMotorState(payload.data, payload.size, &answer.motors_on), "motor state");
  } else if (letter == version2::REQUEST_LIST) {
    version2::MotionList list;
    expectGood(version2::decodeMotionList(payload.data, payload.size, &list), "list of motions");
    answer.names.assign(list.names, list.names + list.count);
  }
  transferEnds(now());
  calls_.take(number)->answer(answer);
}

std::string Version2Session::decodeError(const Payload& payload) {
  version2::ErrorMessage message;
  expectGood(version2::decodeErrorMessage(payload.data, payload.size, &message), "error message");
  const std::string code = "error code " + std::to_string(message.code);
  return message.text_size == 0 ? code : std::string(message.text, message.text_size) + " (" + code + ")";
}

void Version2Session::onRefusal(char request_kind, int number, const Payload& payload) {
  const std::string problem = decodeError(payload);
  if (calls_.has(number) || pictures_.has(number)) {
    onRefusedCall(number, problem);
  } else {
    onRefusedExchange(request_kind, problem);
  }
}

void Version2Session::onRefusedCall(int number, const std::string& problem) {
  ++counters().refusals;
  if (auto picture = pictures_.take(number)) {
    picture->fail(CallOutcome::kRefused, address() + " refused to take a picture: " + problem + ".");
  }
  if (auto call = calls_.take(number)) {
    transferEnds(now());
    call->fail(CallOutcome::kRefused, address() + " refused to " + describe(*call) + ": " + problem + ".");
  }
}

void Version2Session::onRefusedExchange(char request_kind, const std::string& problem) {
  switch (request_kind) {
    case version2::REQUEST_HELLO:
      throw ProtocolException("it refused to say hello: " + problem);
    case version2::REQUEST_STREAM:
      throw ProtocolException("it refused to stream pictures: " + problem);
    case version2::REQUEST_JOINTS:
      return noteRefusal(request_kind, "to move joints: " + problem);
    case version2::REQUEST_SPEED_LIMITS:
      return noteRefusal(request_kind, "to limit the speed of joints: " + problem);
    case version2::REQUEST_TELEMETRY:
      return noteRefusal(request_kind, "to send telemetry: " + problem);
    case version2::REQUEST_LEDS:
      return noteRefusal(request_kind, "to set LEDs: " + problem);
    default:
      return noteRefusal(request_kind, "to move the ears: " + problem);
  }
}

void Version2Session::onReport(const Payload& payload) {
  robot_message_ = decodeError(payload);
  notifier().log(LogLevel::kWarn, address() + " reports: " + robot_message_ + ".");
}

Session::TimePoint Version2Session::answerDeadline() const {
  TimePoint oldest = TimePoint::max();
  for (const auto& exchange : exchanges_) {
    oldest = std::min(oldest, exchange.second.deadline);
  }
  return oldest;
}

void Version2Session::checkDeadlines(TimePoint now) {
  if (stream().on() && now >= pictureSilenceLimit()) {
    failSilent();
  }
  for (const auto& exchange : exchanges_) {
    const Exchange& request = exchange.second;
    if (now >= request.deadline) {
      throw Fault::unanswered(address(), std::string("the request '") + request.kind + "'",
                              std::chrono::round<std::chrono::milliseconds>(request.deadline - request.sent));
    }
  }
  pictures_.expire(now, "picture", damageRemark());
  calls_.expire(now, "answer", ".");
}

Session::TimePoint Version2Session::nextDeadline() const {
  const TimePoint silence = stream().on() ? pictureSilenceLimit() : TimePoint::max();
  return std::min(
      {silence, answerDeadline(), pictures_.nextDeadline(), calls_.nextDeadline(), next_hello_, nextLook()});
}

}  // namespace aibo_driver
