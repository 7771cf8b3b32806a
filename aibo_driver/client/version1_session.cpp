#include "client/version1_session.h"

#include <algorithm>
#include <utility>

#include "client/fault.h"
#include "client/units.h"
#include "protocol/units.h"
#include "protocol/version2.h"
#include "robot_model/robot_model.h"

namespace aibo_client {
namespace {

const char* partOf(char letter) {
  switch (letter) {
    case protocol::REQUEST_SENSOR:
      return "sensor";
    case protocol::REQUEST_LED:
      return "LED";
    case protocol::REQUEST_EARS:
      return "ear";
    default:
      return "joint";
  }
}

std::string describe(char letter, int id) {
  return std::string("the request '") + letter + "' for " + partOf(letter) + " " + std::to_string(id);
}

std::string describeError(int code) {
  return "error code " + std::to_string(code);
}

// The reasons why this project's server refuses to move a joint (docs/protocol.md).
constexpr char kWhyJointsAreRefused[] = "; are its motors on, and can the joint move freely?";

// The server reports a joint's fault by refusing the next request of any kind about this joint.
constexpr char kJointFault[] = "the joint does not follow its commands";

/// True if the user wants something for which version 1 has no request.
bool areUnknown(const Settings& wanted) {
  return wanted.format != StreamFormat() || wanted.transport == PictureTransport::kUdp ||
         wanted.camera != CameraSettings() || wanted.colors.on || wanted.microphone.on;
}

// The reason to give when something has ended, because version 1 does not report how.
constexpr char kUnknownEnd[] = "version 1 of the protocol does not say how it ends";

short toCentidegrees(double radian) {
  return protocol::centidegreesFromMicroradians(toMicro(radian));
}

}  // namespace

Version1Session::Version1Session(Connection& connection, VersionAnswer answer, TimePoint connected)
    : connection_(connection),
      is_version_answer_pending_(answer == VersionAnswer::kNone),
      poll_due_(connected),
      ready_(answer == VersionAnswer::kVersion1) {
  // The joints and sensors of an ERS-7, in turn. The joints of the ERS-210 have the same identifiers.
  const robot_model::RobotModel& model = *robot_model::findRobotModel("ERS-7");
  for (int i = 0; i < std::max(model.number_of_joints, model.number_of_sensors); ++i) {
    if (i < model.number_of_joints) {
      polled_.push_back({protocol::REQUEST_JOINT, model.joints[i].identifier});
    }
    if (i < model.number_of_sensors) {
      polled_.push_back({protocol::REQUEST_SENSOR, model.sensors[i].identifier});
    }
  }
}

// While a picture is pending, a toggle would have to wait for the picture anyway. A second `F` would make it unclear
// which picture has which quality. `F` is never sent while the stream runs.
Session::Bytes Version1Session::nextRequest(const Settings& wanted, TimePoint now) {
  poll_wanted_ = wanted.telemetry_period > 0;
  if (areUnknown(wanted)) {
    connection_.context.warnOnce(
        "settings",
        "speaks version 1 of the protocol: it sends every image at 208x160 by TCP, its camera keeps its settings, and "
        "it neither detects colours nor listens");
  }
  endJointOrders();
  if (isAnswerPending()) {
    return {};
  }
  connection_.dropTooOld(now);
  if (wanted.streaming != connection_.pictures.streaming()) {
    connection_.pictures.streamRequested(wanted.streaming, wanted.jpeg_quality, now);
    return version1Command(protocol::REQUEST_STREAM_TOGGLE, wanted.jpeg_quality);
  }
  if (!ready_) {
    return connection_.pictures.streaming() ? Bytes() : requestTrial(wanted, now);
  }
  Call* const picture = connection_.calls.nextForPicture();
  if (picture != nullptr && mayRequestPicture(now)) {
    return requestPicture(wanted, picture, now);
  }
  Call* const call = connection_.calls.nextForRobot(true);
  return call != nullptr && !connection_.mustWaitForSpeedLimits(*call) ? requestCall(call, now) : nextValueRequest(now);
}

// The connection may be to a server that is frozen, or whose robot has just gone out of reach. So the client asks for a
// picture: this is the only request that every version 1 server answers.
Session::Bytes Version1Session::requestTrial(const Settings& wanted, TimePoint now) {
  is_trial_pending_ = true;
  connection_.pictures.signOfPicture(now);
  return version1Command(protocol::REQUEST_PICTURE, wanted.jpeg_quality);
}

bool Version1Session::mayRequestPicture(TimePoint now) const {
  return !connection_.pictures.streaming() && parser_.betweenReplies() && now >= connection_.pictures.drainedAt();
}

Session::Bytes Version1Session::requestPicture(const Settings& wanted, Call* call, TimePoint now) {
  call->request_number = kPendingNumber;
  call->quality = call->quality == 0 ? wanted.jpeg_quality : call->quality;
  connection_.pictures.signOfPicture(now);
  return version1Command(protocol::REQUEST_PICTURE, call->quality);
}

Session::Bytes Version1Session::requestCall(Call* call, TimePoint now) {
  call->request_number = kPendingNumber;
  Bytes bytes = version1Request(*call);
  connection_.callSent(*call, bytes.size(), now);
  return bytes;
}

Session::Bytes Version1Session::nextValueRequest(TimePoint now) {
  const bool has_commands = !connection_.commands.isEmptyForVersion1();
  if (mayPoll() && now >= poll_due_ + (has_commands ? kLongestPollWait : std::chrono::milliseconds(0))) {
    poll_due_ = now + kPollPeriod;
    const PolledValue value = polled_.front();
    std::rotate(polled_.begin(), polled_.begin() + 1, polled_.end());
    pending_value_ = ValueRequest{value.letter, value.id, false, now};
    return version1Command(value.letter, value.id);
  }
  return has_commands ? nextCommand(now) : Bytes();
}

Session::Bytes Version1Session::nextCommand(TimePoint now) {
  CommandOutbox& commands = connection_.commands;
  if (!commands.speed_limits.empty()) {
    const JointSpeedLimit limit = commands.speed_limits.take(1).front();
    return setValue(protocol::REQUEST_MAX_VELOCITY, limit.id, toCentidegrees(limit.speed), now);
  }
  const bool others_wait = !commands.leds.empty() || !commands.ears.empty();
  const bool joints_next = !commands.joints.empty() && (joints_turn_ || !others_wait);
  joints_turn_ = !joints_next;
  return joints_next ? nextJointCommand(now) : nextLedOrEarCommand(now);
}

Session::Bytes Version1Session::nextJointCommand(TimePoint now) {
  const JointCommand command = connection_.commands.joints.takeTargetAfter(last_target_, now);
  last_target_ = command.targets.front().id;
  Bytes bytes = setValue(protocol::REQUEST_JOINT, last_target_, toCentidegrees(command.targets.front().position), now);
  pending_value_->order = command.terms.number;
  if (command.terms.number != 0) {
    joint_orders_.try_emplace(command.terms.number);
  }
  return bytes;
}

/// Reports the end of each command that was answered. This version does not say when joints arrive.
void Version1Session::endJointOrders() {
  for (auto each = joint_orders_.begin(); each != joint_orders_.end();) {
    const auto& [number, trouble] = *each;
    if (connection_.commands.joints.has(number) || (pending_value_ && pending_value_->order == number)) {
      ++each;
      continue;
    }
    const ActivityEnd end = {EndedKind::kJoints, trouble.empty() ? EndedHow::kUnknown : EndedHow::kRefused, "",
                             trouble.empty() ? kUnknownEnd : trouble, number};
    each = joint_orders_.erase(each);
    connection_.context.notifier.tell(&Callbacks::on_ended, "on_ended", end);
  }
}

Session::Bytes Version1Session::nextLedOrEarCommand(TimePoint now) {
  CommandOutbox& commands = connection_.commands;
  if (!commands.ears.empty()) {
    const EarCommand ear = commands.ears.take(1).front();
    return setValue(protocol::REQUEST_EARS, ear.id, ear.drawn ? 1 : 0, now);
  }
  const LedCommand led = commands.leds.take(1).front();
  return setValue(protocol::REQUEST_LED, led.id, static_cast<short>(led.intensity), now);
}

Session::Bytes Version1Session::setValue(char letter, int id, short value, TimePoint now) {
  pending_value_ = ValueRequest{letter, id, true, now};
  return version1SetCommand(letter, id, value);
}

void Version1Session::bytesArrived(const std::uint8_t* data, std::size_t size, TimePoint now) {
  now_ = now;
  for (std::size_t taken = 0; size > 0; data += taken, size -= taken) {
    switch (parser_.append(data, size, now, &taken)) {
      case ReplyParser::Result::kNothing:
        break;
      case ReplyParser::Result::kPicture:
        onPicture();
        break;
      case ReplyParser::Result::kValue:
        onValueReply();
        break;
    }
  }
  if (!parser_.betweenReplies()) {
    connection_.pictures.signOfPicture(now);
  }
}

void Version1Session::onPicture() {
  PictureIntake& pictures = connection_.pictures;
  pictures.signOfPicture(now_);
  is_version_answer_pending_ = false;
  ready_ = true;
  if (std::exchange(is_trial_pending_, false)) {
    parser_.takeJpeg();
    return;
  }
  Call* const pending = pendingPicture();
  const std::shared_ptr<Picture> picture = pictures.inspect(parser_.takeJpeg(), parser_.firstByteTime());
  if (!picture) {
    if (pending != nullptr) {
      pending->request_number = 0;  // the request is sent again if the call's time allows
    }
    return;
  }
  picture->quality = pending != nullptr ? pending->quality : pictures.streamQuality();
  if (pending != nullptr) {
    pictures.deliver(picture);
    connection_.calls.answer(kPendingNumber, picture);
  } else if (pictures.deliverFromStream(picture, now_)) {
    connection_.calls.answerFromStream(picture);
  }
}

void Version1Session::onValueReply() {
  const protocol::ValueReply reply = parser_.value();
  const bool is_version_answer = std::exchange(is_version_answer_pending_, false);
  if (is_version_answer && protocol::version2::agreesToVersion2(reply)) {
    throw Fault::unanswered(connection_.context.address, "the request for version 2 of the protocol", kVersionPatience);
  }
  ready_ = true;
  const bool error = reply.letter == protocol::REPLY_ERROR;
  if (error && is_version_answer) {
    return;  // the server has refused version 2, as was assumed
  }
  error ? onError(reply.value) : onAnswer(reply);
}

void Version1Session::onError(int code) {
  if (is_trial_pending_) {
    is_trial_pending_ = false;
  } else if (const Call* const call = pendingCall()) {
    connection_.refuse(*call, RefusalCause::kRobot, explainRefusal(*call, code), now_);
  } else if (pending_value_) {
    onValueRefused(code);
  } else if (connection_.pictures.streaming()) {
    throw ProtocolException("it refused to stream pictures: " + describeError(code));
  } else {
    connection_.context.warn("sent an error that answers no request: " + describeError(code));
  }
}

void Version1Session::onValueRefused(int code) {
  const ValueRequest request = *std::exchange(pending_value_, std::nullopt);
  if (!request.set) {
    if (request.letter == protocol::REQUEST_JOINT && measured_joints_.erase(request.id) > 0) {
      connection_.refused("to move joint " + std::to_string(request.id) + ": " + kJointFault);
      return;
    }
    const auto is_lacking = [&](const PolledValue& each) {
      return each.letter == request.letter && each.id == request.id;
    };
    polled_.erase(std::remove_if(polled_.begin(), polled_.end(), is_lacking), polled_.end());
  }
  const std::optional<RefusedRequest> kind = refusedRequest(request.letter);
  if (!request.set || !kind) {
    connection_.refused(describe(request.letter, request.id) + ": " + describeError(code));
    return;
  }
  if (*kind == RefusedRequest::kSpeedLimits) {
    connection_.forgetSpeedLimits({request.id});
  }
  const std::string reason =
      *kind == RefusedRequest::kJoints ? describeError(code) + kWhyJointsAreRefused : describeError(code);
  if (request.order != 0) {
    joint_orders_[request.order] = reason;
  }
  // endJointOrders() reports the end of the whole command.
  connection_.refused(Refusal{*kind, RefusalCause::kRobot, {request.id}, reason, 0});
}

void Version1Session::onAnswer(const protocol::ValueReply& reply) {
  const auto answers = [&reply](char letter) { return reply.letter == protocol::version2::replyKind(letter); };
  if (pendingCall() != nullptr && answers(pendingCall()->request.letter)) {
    onCallAnswered();
  } else if (pending_value_ && answers(pending_value_->letter) && reply.identifier == pending_value_->id) {
    onValue(reply);
  } else {
    connection_.context.warn(std::string("sent an answer to no request: '") + reply.letter + "', " +
                             std::to_string(reply.value));
  }
}

void Version1Session::onCallAnswered() {
  connection_.calls.transferEnds(now_);
  if (const Call& call = *pendingCall(); call.order() != 0) {
    connection_.context.notifier.tell(&Callbacks::on_ended, "on_ended",
                                      {EndedKind::kMotion, EndedHow::kUnknown, call.object, kUnknownEnd, call.order()});
  }
  connection_.calls.answer(kPendingNumber, nullptr, 0);
}

void Version1Session::onValue(const protocol::ValueReply& reply) {
  const ValueRequest request = *std::exchange(pending_value_, std::nullopt);
  const double position = fromMicro(protocol::microradiansFromCentidegrees(reply.value));
  if (request.set) {
    if (request.letter == protocol::REQUEST_JOINT) {
      connection_.context.notifier.tell(&Callbacks::on_joints_accepted, "on_joints_accepted",
                                        {{reply.identifier, position}});
    }
    if (request.letter == protocol::REQUEST_LED) {
      connection_.context.notifier.tell(&Callbacks::on_leds_accepted, "on_leds_accepted",
                                        {{reply.identifier, reply.value & 255}});
    }
    return;
  }
  Telemetry telemetry;
  telemetry.arrival = parser_.firstByteTime();
  if (request.letter == protocol::REQUEST_JOINT) {
    telemetry.joints = {{reply.identifier, position}};
    measured_joints_.insert(reply.identifier);
  } else {
    telemetry.sensors = {
        {reply.identifier, protocol::sensorValueFromVersion1(sensorKind("ERS-7", reply.identifier), reply.value)}};
  }
  connection_.measurements.deliver(std::move(telemetry), "");
}

Call* Version1Session::pendingPicture() const {
  Call* const pending = pendingCall();
  return pending != nullptr && pending->isForPicture() ? pending : nullptr;
}

bool Version1Session::isPictureDue() const {
  return connection_.pictures.streaming() || is_trial_pending_ || pendingPicture() != nullptr ||
         !parser_.betweenReplies();
}

Session::TimePoint Version1Session::silenceLimit() const {
  return isPictureDue() ? connection_.pictureDeadline() : TimePoint::max();
}

Session::TimePoint Version1Session::valueDeadline() const {
  return pending_value_ ? pending_value_->sent + connection_.answerLimit() : TimePoint::max();
}

void Version1Session::checkDeadlines(TimePoint now) {
  if (now >= silenceLimit()) {
    throw Fault::silent(connection_.context.address, connection_.context.read_timeout);
  }
  if (now >= valueDeadline()) {
    throw Fault::unanswered(connection_.context.address, describe(pending_value_->letter, pending_value_->id),
                            connection_.answerLimit());
  }
  checkCalls(now);
}

// If a call was sent and is not answered in time, the connection ends.
void Version1Session::checkCalls(TimePoint now) {
  std::optional<Fault> fault;
  const Call* const pending = pendingCall();
  if (pending != nullptr && now >= pending->deadline) {
    fault = Fault::unanswered(connection_.context.address, "the request to " + describe(*pending), pending->timeout);
  }
  connection_.expireCalls(now);
  if (fault) {
    throw Fault(*fault);
  }
}

Session::TimePoint Version1Session::nextDeadline() const {
  const PictureIntake& pictures = connection_.pictures;
  TimePoint next = std::min({connection_.calls.nextDeadline(), silenceLimit(), valueDeadline(), pictures.nextLook()});
  const bool free = !isAnswerPending();
  if (!pictures.streaming() && connection_.calls.nextForPicture() != nullptr && free && parser_.betweenReplies()) {
    next = std::min(next, pictures.drainedAt());
  }
  if (ready_ && mayPoll() && free) {
    next = std::min(next, poll_due_);
  }
  return next;
}

}  // namespace aibo_client
