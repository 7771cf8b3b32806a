#include "client/connection.h"

#include <algorithm>
#include <utility>

namespace aibo_driver {
namespace {

// However short the time allowed for pictures is, an answer may have to wait behind one.
constexpr std::chrono::milliseconds kShortestAnswerLimit{1000};

// Commands to the joints are meant for now. By then the user has seen that nothing moves.
constexpr std::chrono::milliseconds kLongestJointWait{500};

}  // namespace

void RefusalLog::refused(char letter, const std::string& problem) {
  ++context_.counters.refusals;
  if (problem != std::exchange(last_problems_[letter], problem)) {
    context_.warn("refused " + problem);
  }
}

void Connection::publish(Telemetry telemetry) {
  telemetry.connection_number = context.number;
  ++context.counters.telemetry;
  context.notifier.telemetry(telemetry);
}

void Connection::dropStaleJointCommands(TimePoint now) {
  const TimePoint stale = now - kLongestJointWait;
  if (std::exchange(last_joint_turn_, now) < stale && commands.joints.dropOlderThan(stale)) {
    context.notifier.log(LogLevel::kWarn, "Joint commands that had to wait for " + context.address + " for more than " +
                                              std::to_string(kLongestJointWait.count()) + " ms are dropped.");
  }
}

void Connection::dropStaleSteering(TimePoint now) {
  if (commands.steering && commands.steering->since < now - kLongestJointWait) {
    commands.steering.reset();
    context.notifier.log(LogLevel::kWarn, "A velocity to walk with that had to wait for " + context.address +
                                              " for more than " + std::to_string(kLongestJointWait.count()) +
                                              " ms is dropped.");
  }
}

void Connection::stopComes(const Call& call) {
  if (call.stopsRobot()) {
    commands.joints.drop(call.joints);
    commands.steering.reset();
  }
  calls.failCancelledBy(call, context.address);
}

void Connection::callSent(const Call& call, std::size_t size, TimePoint now) {
  if (call.takesOverJoints()) {
    commands.joints.clear();
  }
  calls.transferBegins(size, now);
}

void Connection::refuse(const Call& call, const std::string& why, TimePoint now) {
  ++context.counters.refusals;
  if (!call.isForPicture()) {
    calls.transferEnds(now);
  }
  const std::string problem = context.address + " refused to " + describe(call) + ": " + why + ".";
  calls.answer(call.request_number, makeFailure(CallOutcome::kRefused, problem));
}

Connection::TimePoint Connection::pictureDeadline() const {
  return std::max(pictures.lastSign(), calls.transferEnd()) + context.read_timeout;
}

std::chrono::milliseconds Connection::answerLimit() const {
  return std::max(context.read_timeout, kShortestAnswerLimit);
}

}  // namespace aibo_driver
