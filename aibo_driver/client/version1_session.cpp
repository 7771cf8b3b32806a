#include "client/version1_session.h"

#include <algorithm>
#include <utility>

#include "client/fault.h"
#include "client/units.h"
#include "protocol/angles.h"
#include "protocol/version2.h"

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

std::string describe(char letter, int id) {
  return std::string("the request '") + letter + "' for joint " + std::to_string(id);
}

}  // namespace

Version1Session::Version1Session(const SessionContext& context, ServerHabits& habits, VersionAnswer answer,
                                 TimePoint connected)
    : Session(context, connected),
      habits_(habits),
      connected_(connected),
      version_answer_owed_(answer == VersionAnswer::kOwed),
      poll_(connected),
      settled_(answer == VersionAnswer::kRefused) {}

void Version1Session::add(PictureRequest request, TimePoint now) {
  request.since = now;
  requests_.add(std::move(request));
}

void Version1Session::add(MotorRequest request) {
  request.fail(CallOutcome::kRefused, address() +
                                          " speaks version 1 of the protocol, which cannot switch the motors on or "
                                          "off. It needs an RCServer that speaks version 2.");
}

// While a picture is owed, a toggle would have to wait behind it anyway, and a second `F` would leave open which answer
// belongs to which quality. `F` is never sent into the own stream.
Session::Bytes Version1Session::nextRequest(const Wish& wish, TimePoint now) {
  poll_wanted_ = wish.telemetry_period > 0;
  if (picture_owed_ || value_owed_) {
    return {};
  }
  if (wish.streaming != stream().on()) {
    toggleStream(now);
    return makeCommand(protocol::REQUEST_STREAM_TOGGLE, wish.jpeg_quality);
  }
  if (mayRequestPicture(now)) {
    picture_owed_ = true;
    signOfPicture(now);
    const int quality = requests_.front().quality;
    return makeCommand(protocol::REQUEST_PICTURE, quality == 0 ? wish.jpeg_quality : quality);
  }
  return nextValueRequest(now);
}

bool Version1Session::mayRequestPicture(TimePoint now) const {
  return !requests_.empty() && !stream().on() && parser_.betweenReplies() && now >= stream().drainedAt();
}

bool Version1Session::mayPoll() const {
  return poll_wanted_ && !poll_.empty() && habits_.unanswered_polls < ServerHabits::kUnansweredPollsLimit;
}

Session::Bytes Version1Session::nextValueRequest(TimePoint now) {
  const bool has_commands = joint_commands_.hasSpeedLimits() || joint_commands_.hasTargets();
  if (mayPoll() && (has_commands ? poll_.isOverdue(now) : now >= poll_.dueAt())) {
    value_owed_ = ValueRequest{protocol::REQUEST_JOINT, poll_.take(now), false, now};
    return makeCommand(value_owed_->letter, value_owed_->id);
  }
  if (joint_commands_.hasSpeedLimits()) {
    const JointSpeedLimit limit = joint_commands_.takeSpeedLimits(1).front();
    return setValue(protocol::REQUEST_MAX_VELOCITY, limit.id, limit.speed, now);
  }
  if (joint_commands_.hasTargets()) {
    const JointTarget target = joint_commands_.takeTargetAfter(last_target_);
    last_target_ = target.id;
    return setValue(protocol::REQUEST_JOINT, target.id, target.position, now);
  }
  return {};
}

/// @param value rad or rad/s
Session::Bytes Version1Session::setValue(char letter, int id, double value, TimePoint now) {
  value_owed_ = ValueRequest{letter, id, true, now};
  return makeSetCommand(letter, id, protocol::centidegreesFromMicroradians(toMicro(value)));
}

void Version1Session::parse(const std::uint8_t* data, std::size_t size) {
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
    requests_.answerFromStream(picture);
  }
}

void Version1Session::onValueReply(const protocol::ValueReply& reply) {
  const bool version_answer_owed = std::exchange(version_answer_owed_, false);
  if (version_answer_owed && protocol::version2::agreesToVersion2(reply)) {
    throw Fault::agreedTooLate(address());
  }
  const bool error = reply.letter == protocol::REPLY_ERROR;
  if (error && version_answer_owed) {
    settled_ = true;  // version 2 is refused, as was assumed
  } else if (error) {
    onError("error code " + std::to_string(reply.value));
  } else {
    onValue(reply);
  }
}

void Version1Session::onError(const std::string& code) {
  if (picture_owed_) {
    settled_ = true;
    picture_owed_ = false;
    requests_.failFront(CallOutcome::kRefused, address() + " refused to take a picture: " + code + ".");
  } else if (value_owed_) {
    onValueRefused(code);
  } else if (stream().on()) {
    throw Fault::protocol(address(), "it refused to stream pictures: " + code);
  } else {
    notifier().log(LogLevel::kWarn, address() + " sent an error that nobody had caused: " + code + ".");
  }
}

void Version1Session::onValueRefused(const std::string& code) {
  const ValueRequest request = *std::exchange(value_owed_, std::nullopt);
  settled_ = true;
  habits_.unanswered_polls = 0;
  if (!request.set) {
    poll_.drop(request.id);
  }
  noteRefusal(describe(request.letter, request.id) + ": " + code);
}

void Version1Session::onValue(const protocol::ValueReply& reply) {
  const bool expected = value_owed_ && reply.letter == protocol::version2::replyKind(value_owed_->letter) &&
                        reply.identifier == value_owed_->id;
  if (!expected) {
    notifier().log(LogLevel::kWarn, address() + " sent an answer that nobody had asked for: '" + reply.letter + "', " +
                                        std::to_string(reply.value) + ".");
    return;
  }
  settled_ = true;
  habits_.unanswered_polls = 0;
  if (reply.letter == protocol::version2::replyKind(protocol::REQUEST_JOINT)) {
    onJointPosition(reply);
  }
  value_owed_.reset();
}

void Version1Session::onJointPosition(const protocol::ValueReply& reply) {
  const double position = fromMicro(protocol::microradiansFromCentidegrees(reply.value));
  if (value_owed_->set) {
    publishAccepted({{reply.identifier, position}});
  } else {
    Telemetry telemetry;
    telemetry.arrival = now();
    telemetry.joints = {{reply.identifier, position}};
    publish(telemetry);
  }
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

void Version1Session::failUnanswered() {
  if (!value_owed_->set && ++habits_.unanswered_polls == ServerHabits::kUnansweredPollsLimit) {
    notifier().log(LogLevel::kWarn, address() + " does not answer when it is asked for its joints. It is not asked " +
                                        "again: there is no telemetry.");
  }
  throw Fault::unanswered(address(), describe(value_owed_->letter, value_owed_->id), answerLimit());
}

Session::TimePoint Version1Session::nextDeadline() const {
  TimePoint next = std::min({requests_.nextDeadline(), silenceLimit(), valueDeadline(), nextLook()});
  const bool free = !picture_owed_ && !value_owed_;
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
