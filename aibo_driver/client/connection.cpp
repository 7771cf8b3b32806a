#include "client/connection.h"

#include <string>
#include <utility>

#include "protocol/stick_pictures.h"

namespace aibo_client {

namespace version2 = protocol::version2;

namespace {

// An answer may have to wait behind a picture, so it gets at least this much time, even if read_timeout is shorter.
constexpr std::chrono::milliseconds kShortestAnswerLimit{1000};

}  // namespace

Connection::Connection(const ConnectionContext& the_context, TimePoint established)
    : context(the_context),
      pictures(context, established),
      measurements(context),
      colors(context),
      sound(context),
      commands([this](const Refusal& refusal) { tell(refusal); }) {
  status.state = ConnectionState::kConnecting;
}

void Connection::refused(const Refusal& refusal) {
  ++context.counters.refusals;
  tell(refusal);
}

void Connection::refused(const std::string& problem) {
  ++context.counters.refusals;
  context.warn("refused " + problem);
}

void Connection::dropTooOld(TimePoint now) {
  // The words are made only when they are needed, because this function runs whenever the client's thread wakes.
  const auto reason = [this] { return "too old: it could not be sent to " + context.address + " in time"; };
  if (!commands.joints.empty() || commands.steering) {
    commands.dropTooOld(now, reason());
  }
  calls.failIf([now](const Call& call) { return !call.wasSent() && call.terms && call.terms->not_after < now; },
               [&](const Call& call) {
                 tellRefused(call, RefusalCause::kTooOld, reason());
                 return CommandException("The order to " + describe(call) + " is " + reason() + ".");
               });
}

void Connection::limitSpeeds(std::vector<JointSpeedLimit> limits) {
  const auto is_in_force = [this](const JointSpeedLimit& limit) {
    return std::exchange(speed_limits_[limit.id], limit.speed) == limit.speed;
  };
  limits.erase(std::remove_if(limits.begin(), limits.end(), is_in_force), limits.end());
  commands.speed_limits.add(limits);
}

void Connection::forgetSpeedLimits(const std::vector<int>& joints) {
  for (const int joint : joints) {
    speed_limits_.erase(joint);
  }
}

void Connection::add(Call call) {
  call.dropFrom(&commands);
  calls.failIf([&call](const Call& other) { return !other.wasSent() && call.cancels(other); },
               [&](const Call& other) {
                 const std::string told = "was told to " + describe(call) + " before ";
                 tellRefused(other, RefusalCause::kStopped, "the robot " + told + "this request was sent");
                 return CommandException(context.address + " " + told + "it was asked to " + describe(other) + ".");
               });
  calls.add(std::move(call));
}

void Connection::expireCalls(TimePoint now) {
  calls.failIf([now](const Call& call) { return call.deadline <= now; },
               [&](const Call& call) {
                 const std::string time = " within " + std::to_string(call.timeout.count()) + " ms";
                 std::string problem = "no answer" + time + ". The robot may or may not " + describe(call) + ".";
                 if (call.isForPicture()) {
                   problem = "no picture" + time + pictures.damageRemark();
                 } else if (!call.wasSent()) {
                   problem = "the request could not be sent" + time;
                   tellRefused(call, RefusalCause::kTooOld, problem);
                   problem += ".";
                 }
                 return TimeoutException(problem, FaultKind::kNone, call.wasSent());
               });
}

void Connection::callSent(const Call& call, std::size_t size, TimePoint now) {
  if (call.sound_part) {
    return;  // samples are few bytes, and the transfer of a file may be under way
  }
  calls.transferBegins(size + (call.has(version2::FETCHES_FILE) ? version2::MAX_STICK_PICTURE_SIZE : 0), now);
}

void Connection::refuse(const Call& call, RefusalCause cause, const std::string& why, TimePoint now) {
  ++context.counters.refusals;
  if (call.has(version2::NEEDS_MEMORY_STICK)) {
    calls.transferEnds(now);
  }
  tellRefused(call, cause, why);
  calls.failIf([&call](const Call& each) { return &each == &call; },
               [&](const Call&) {
                 return CommandException(context.address + " refused to " + describe(call) + ": " + why + ".");
               });
}

// When the connection ends, all orders end with it, and nothing is said of them.
void Connection::tell(const Refusal& refusal) {
  if (status.state != ConnectionState::kDisconnected) {
    context.notifier.tell(&Callbacks::on_refused, "on_refused", refusal);
  }
}

/// The user follows a numbered order by its number, whether or not a caller waits for the answer.
void Connection::tellRefused(const Call& call, RefusalCause cause, const std::string& reason) {
  if (call.order() != 0) {
    tell({refusedRequest(call.request.letter).value(), cause, {}, reason, call.order()});
  }
}

void Connection::giveUpDatagrams(const std::string& why) {
  status.transport = PictureTransport::kTcp;
  if (why != std::exchange(status.transport_problem, why)) {
    context.notifier.log(LogLevel::kInfo, context.address + " sends its pictures by TCP, not by UDP: " + why + ".");
  }
}

Connection::TimePoint Connection::pictureDeadline() const {
  return std::max(pictures.lastSign(), calls.transferEnd()) + context.read_timeout + pictures.extraInterval();
}

std::chrono::milliseconds Connection::answerLimit() const {
  return std::max(context.read_timeout, kShortestAnswerLimit);
}

}  // namespace aibo_client
