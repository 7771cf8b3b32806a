#include "client/version1_session.h"

#include <algorithm>
#include <utility>

#include "client/fault.h"
#include "client/sensor_readings.h"
#include "client/units.h"
#include "protocol/units.h"
#include "protocol/version2.h"
#include "robot_model/robot_model.h"

namespace aibo_driver {
namespace {

// A connection on which nothing is due works if it stands for so long. One that the robot turns away is closed sooner.
constexpr std::chrono::milliseconds kSettleTime{1000};

Session::Bytes makeCommand(char letter, int identifier) {
  protocol::BasicGetCommand command;
  command.command = letter;
  command.identifier = static_cast<unsigned char>(identifier);
  Session::Bytes bytes(protocol::BASIC_COMMAND_SIZE);
  protocol::encodeCommand(command, bytes.data());
  return bytes;
}

// A request that sets a value is laid out as the reply.
Session::Bytes makeSetCommand(char letter, int identifier, short value) {
  protocol::ValueReply request;
  request.letter = letter;
  request.identifier = static_cast<unsigned char>(identifier);
  request.value = value;
  Session::Bytes bytes(protocol::VALUE_REQUEST_SIZE);
  protocol::encodeValueReply(request, bytes.data());
  return bytes;
}

const char* partOf(char letter) {
  switch (letter) {
    case protocol::REQUEST_SENSOR:
      return "sensor";
    case protocol::REQUEST_LED:
    case protocol::REQUEST_FACE_LEDS:
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

short toCentidegrees(double radian) {
  return protocol::centidegreesFromMicroradians(toMicro(radian));
}

/// True if these are all LEDs of an ERS-7, and all are to shine alike.
bool areAllAlike(const std::vector<LedCommand>& leds) {
  const robot_model::RobotModel& model = *robot_model::findRobotModel("ERS-7");
  const auto count = std::count_if(leds.begin(), leds.end(), [&](const LedCommand& led) {
    return robot_model::findLedByIdentifier(model, led.id) != robot_model::NO_LED &&
           led.intensity == leds.front().intensity && led.mode == leds.front().mode;
  });
  return count == model.number_of_leds;
}

}  // namespace

Version1Session::Version1Session(const SessionContext& context, ServerHabits& habits, VersionAnswer answer,
                                 TimePoint connected)
    : Session(context, connected),
      habits_(habits),
      connected_(connected),
      heard_(answer == VersionAnswer::kRefused),
      version_answer_owed_(answer == VersionAnswer::kOwed),
      poll_(connected),
      settled_(answer == VersionAnswer::kRefused) {
  for (const auto& unanswered : habits_.unanswered_polls) {
    if (unanswered.second >= ServerHabits::kUnansweredPollsLimit) {
      poll_.dropAll(unanswered.first);
    }
  }
}

void Version1Session::add(PictureRequest request, TimePoint now) {
  request.since = now;
  requests_.add(std::move(request));
}

void Version1Session::add(RobotRequest request) {
  if (isKnownToVersion1(request)) {
    calls_.add(std::move(request));
  } else {
    request.fail(CallOutcome::kRefused, address() + " speaks version 1 of the protocol, which cannot " +
                                            describe(request) + ". It needs an RCServer that speaks version 2.");
  }
}

void Version1Session::failRequests(CallOutcome outcome, const std::string& problem) {
  requests_.failAll(outcome, problem);
  calls_.failAll(outcome, problem);
}

// While a picture is owed, a toggle would have to wait behind it anyway, and a second `F` would leave open which answer
// belongs to which quality. `F` is never sent into the own stream.
Session::Bytes Version1Session::nextRequest(const Wish& wish, TimePoint now) {
  poll_wanted_ = wish.telemetry_period > 0;
  if (isAnswerOwed()) {
    return {};
  }
  dropStaleJointCommands(now);
  if (wish.streaming != stream().on()) {
    toggleStream(wish.jpeg_quality, now);
    return makeCommand(protocol::REQUEST_STREAM_TOGGLE, wish.jpeg_quality);
  }
  if (mayRequestPicture(now)) {
    picture_owed_ = true;
    signOfPicture(now);
    const int quality = requests_.front().quality;
    return makeCommand(protocol::REQUEST_PICTURE, quality == 0 ? wish.jpeg_quality : quality);
  }
  const RobotRequest* call = calls_.firstUnsent();
  return call != nullptr && !mustWaitForSpeedLimits(*call) ? nextCall(*call, now) : nextValueRequest(now);
}

bool Version1Session::mayRequestPicture(TimePoint now) const {
  return !requests_.empty() && !stream().on() && parser_.betweenReplies() && now >= stream().drainedAt();
}

bool Version1Session::mayPoll() const {
  return poll_wanted_ && !poll_.empty();
}

Session::Bytes Version1Session::nextCall(const RobotRequest& call, TimePoint now) {
  Bytes bytes = encodeForVersion1(call);
  dropSupersededJointCommands(call);
  calls_.sent(kCallOwed);
  transferBegins(bytes.size(), now);
  return bytes;
}

Session::Bytes Version1Session::nextValueRequest(TimePoint now) {
  const bool has_commands = !commands_.empty();
  if (mayPoll() && (has_commands ? poll_.isOverdue(now) : now >= poll_.dueAt())) {
    const ValuePoll::Value value = poll_.take(now);
    value_owed_ = ValueRequest{value.request, value.id, false, now};
    return makeCommand(value.request, value.id);
  }
  return has_commands ? nextCommand(now) : Bytes();
}

Session::Bytes Version1Session::nextCommand(TimePoint now) {
  if (!commands_.speed_limits.empty()) {
    const JointSpeedLimit limit = commands_.speed_limits.take(1).front();
    return setValue(protocol::REQUEST_MAX_VELOCITY, limit.id, toCentidegrees(limit.speed), now);
  }
  const bool others_wait = !commands_.leds.empty() || !commands_.ears.empty();
  const bool joints_next = !commands_.joints.empty() && (joints_turn_ || !others_wait);
  joints_turn_ = !joints_next;
  return joints_next ? nextJointCommand(now) : nextLedOrEarCommand(now);
}

Session::Bytes Version1Session::nextJointCommand(TimePoint now) {
  const JointTarget target = commands_.joints.takeTargetAfter(last_target_);
  last_target_ = target.id;
  return setValue(protocol::REQUEST_JOINT, target.id, toCentidegrees(target.position), now);
}

Session::Bytes Version1Session::nextLedOrEarCommand(TimePoint now) {
  if (!commands_.ears.empty()) {
    const EarCommand ear = commands_.ears.take(1).front();
    return setValue(protocol::REQUEST_EARS, ear.id, ear.drawn ? 1 : 0, now);
  }
  if (areAllAlike(commands_.leds.items())) {
    const LedCommand led = commands_.leds.take(commands_.leds.items().size()).front();
    const int mode = led.mode == LedMode::kA ? protocol::FACE_MODE_A : protocol::FACE_MODE_A + 1;
    return setValue(protocol::REQUEST_FACE_LEDS, mode, static_cast<short>(led.intensity), now);
  }
  const LedCommand led = commands_.leds.take(1).front();
  return setValue(protocol::REQUEST_LED, led.id, static_cast<short>(led.intensity), now);
}

Session::Bytes Version1Session::setValue(char letter, int id, short value, TimePoint now) {
  value_owed_ = ValueRequest{letter, id, true, now};
  return makeSetCommand(letter, id, value);
}

void Version1Session::parse(const std::uint8_t* data, std::size_t size) {
  heard_ = heard_ || size > 0;
  parser_.feed(data, size, now(), *this);
  if (parser_.betweenReplies()) {
    return;
  }
  signOfPicture(now());
  if (!stream().on() && !picture_owed_) {
    stream().lateBytes(now());
  }
}

void Version1Session::onPicture(Bytes jpeg, TimePoint first_byte_time) {
  signOfPicture(now());
  version_answer_owed_ = false;
  if (!stream().on() && !picture_owed_) {
    stream().lateBytes(now());
  }
  const PicturePtr picture = inspect(std::move(jpeg), first_byte_time);
  if (!picture) {
    picture_owed_ = false;  // the request is made again, as long as its time allows
    return;
  }
  settled_ = true;
  deliver(picture);
}

void Version1Session::deliver(const PicturePtr& picture) {
  if (picture_owed_) {
    picture_owed_ = false;
    publish(picture);
    requests_.answerFront(picture);
  } else if (!stream().on()) {
    dropUnexpected();
  } else if (publishFromStream(picture)) {
    requests_.answerFromStream(picture, stream().quality());
  }
}

void Version1Session::onValueReply(const protocol::ValueReply& reply, TimePoint first_byte_time) {
  const bool version_answer_owed = std::exchange(version_answer_owed_, false);
  if (version_answer_owed && protocol::version2::agreesToVersion2(reply)) {
    throw Fault::agreedTooLate(address());
  }
  const bool error = reply.letter == protocol::REPLY_ERROR;
  if (error && version_answer_owed) {
    settled_ = true;  // version 2 is refused, as was assumed
  } else if (error) {
    onError(reply.value);
  } else {
    onAnswer(reply, first_byte_time);
  }
}

void Version1Session::onError(int code) {
  const std::string wording = "error code " + std::to_string(code);
  if (picture_owed_) {
    settled_ = true;
    picture_owed_ = false;
    requests_.failFront(CallOutcome::kRefused, address() + " refused to take a picture: " + wording + ".");
  } else if (calls_.has(kCallOwed)) {
    onCallRefused(code);
  } else if (value_owed_) {
    onValueRefused(wording);
  } else if (stream().on()) {
    throw Fault::protocol(address(), "it refused to stream pictures: " + wording);
  } else {
    notifier().log(LogLevel::kWarn, address() + " sent an error that nobody had caused: " + wording + ".");
  }
}

void Version1Session::onCallRefused(int code) {
  settled_ = true;
  transferEnds(now());
  ++counters().refusals;
  RobotRequest call = *calls_.take(kCallOwed);
  call.fail(CallOutcome::kRefused, address() + " refused to " + describe(call) + ": " + explainRefusal(call, code) +
                                       " (error code " + std::to_string(code) + ").");
}

void Version1Session::onValueRefused(const std::string& code) {
  const ValueRequest request = *std::exchange(value_owed_, std::nullopt);
  settled_ = true;
  if (!request.set) {
    habits_.unanswered_polls.erase(request.letter);
    poll_.drop({request.letter, request.id});
  }
  noteRefusal(request.letter, describe(request.letter, request.id) + ": " + code);
}

void Version1Session::onAnswer(const protocol::ValueReply& reply, TimePoint first_byte_time) {
  const auto answers = [&reply](char letter) { return reply.letter == protocol::version2::replyKind(letter); };
  if (calls_.has(kCallOwed) && answers(calls_.get(kCallOwed)->letter)) {
    onCallAnswered();
  } else if (value_owed_ && answers(value_owed_->letter) && reply.identifier == value_owed_->id) {
    onValue(reply, first_byte_time);
  } else {
    notifier().log(LogLevel::kWarn, address() + " sent an answer that nobody had asked for: '" + reply.letter + "', " +
                                        std::to_string(reply.value) + ".");
  }
}

void Version1Session::onCallAnswered() {
  settled_ = true;
  transferEnds(now());
  calls_.take(kCallOwed)->answer({});
}

void Version1Session::onValue(const protocol::ValueReply& reply, TimePoint first_byte_time) {
  settled_ = true;
  const ValueRequest request = *std::exchange(value_owed_, std::nullopt);
  const double position = fromMicro(protocol::microradiansFromCentidegrees(reply.value));
  if (request.set) {
    noteAcceptance(request.letter);
    if (request.letter == protocol::REQUEST_JOINT) {
      publishAccepted({{reply.identifier, position}});
    }
    return;
  }
  habits_.unanswered_polls.erase(request.letter);
  Telemetry telemetry;
  telemetry.arrival = first_byte_time;
  if (request.letter == protocol::REQUEST_JOINT) {
    telemetry.joints = {{reply.identifier, position}};
  } else {
    telemetry.sensors = {makeVersion1Reading(reply.identifier, reply.value)};
  }
  publish(telemetry);
}

bool Version1Session::pictureDue() const {
  return stream().on() || picture_owed_ || !parser_.betweenReplies();
}

Session::TimePoint Version1Session::silenceLimit() const {
  return pictureDue() ? pictureSilenceLimit() : TimePoint::max();
}

Session::TimePoint Version1Session::valueDeadline() const {
  return value_owed_ ? value_owed_->sent + answerLimit() : TimePoint::max();
}

void Version1Session::checkDeadlines(TimePoint now) {
  if (now >= silenceLimit()) {
    failSilent();
  }
  if (now >= valueDeadline()) {
    failUnanswered();
  }
  checkCall(now);
  const bool owed_in_vain = picture_owed_ && now >= requests_.front().deadline;
  const std::chrono::milliseconds allowed = owed_in_vain ? requests_.front().timeout : std::chrono::milliseconds(0);
  requests_.expire(now, damageRemark());
  if (owed_in_vain) {
    throw Fault::pictureOverdue(address(), allowed);
  }
  if (!pictureDue() && now >= connected_ + kSettleTime) {
    settled_ = true;
  }
}

// A call that has been sent and is not answered in time ends the connection.
void Version1Session::checkCall(TimePoint now) {
  const RobotRequest* owed = calls_.get(kCallOwed);
  const bool owed_in_vain = owed != nullptr && now >= owed->deadline;
  const std::string request = owed_in_vain ? "the request to " + describe(*owed) : "";
  const std::chrono::milliseconds allowed = owed_in_vain ? owed->timeout : std::chrono::milliseconds(0);
  calls_.expire(now, "answer", ".");
  if (owed_in_vain) {
    throw Fault::unanswered(address(), request, allowed);
  }
}

void Version1Session::failUnanswered() {
  const char letter = value_owed_->letter;
  if (heard_ && !value_owed_->set && ++habits_.unanswered_polls[letter] == ServerHabits::kUnansweredPollsLimit) {
    notifier().log(LogLevel::kWarn, address() + " does not answer when it is asked for its " + partOf(letter) +
                                        "s. It is not asked again: there is no telemetry of them.");
  }
  throw Fault::unanswered(address(), describe(letter, value_owed_->id), answerLimit());
}

Session::TimePoint Version1Session::nextDeadline() const {
  TimePoint next =
      std::min({requests_.nextDeadline(), calls_.nextDeadline(), silenceLimit(), valueDeadline(), nextLook()});
  const bool free = !isAnswerOwed();
  if (!stream().on() && !requests_.empty() && free && parser_.betweenReplies()) {
    next = std::min(next, stream().drainedAt());
  }
  if (mayPoll() && free) {
    next = std::min(next, poll_.dueAt());
  }
  if (!settled_ && !pictureDue()) {
    next = std::min(next, connected_ + kSettleTime);
  }
  return next;
}

}  // namespace aibo_driver
