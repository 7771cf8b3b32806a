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
  calls.transferBegins(size + call.largestAnswer(), now);
}

void Connection::refuse(const Call& call, const std::string& why, TimePoint now) {
  ++context.counters.refusals;
  if (!call.isForPicture()) {
    calls.transferEnds(now);
  }
  const std::string problem = context.address + " refused to " + describe(call) + ": " + why + ".";
  calls.answer(call.request_number, makeFailure(CallOutcome::kRefused, problem));
}

std::string Connection::lackOfRequest() const {
  return robot.server.empty() ? "speaks version 1 of the protocol, which has no request"
                              : "(" + robot.server + ") has no request";
}

void Connection::warnOfMissingColors(bool wanted) {
  if (!std::exchange(warned_of_colors_, wanted) && wanted) {
    context.warn(lackOfRequest() + " to detect colours: nothing is detected");
  }
}

void Connection::warnOfMissingSettings(bool format, bool camera) {
  if (!std::exchange(warned_of_format_, format) && format) {
    context.warn(lackOfRequest() +
                 " for resolution and rate of the stream: it sends every image of its camera, at 208x160");
  }
  if (!std::exchange(warned_of_camera_, camera) && camera) {
    context.warn(lackOfRequest() + " to set the camera: its settings stay as they are");
  }
}

void Connection::giveUpDatagrams(const std::string& why) {
  transport = PictureTransport::kTcp;
  transport_problem = why;
  context.warn("sends its pictures by TCP, not by UDP: " + why);
}

Connection::TimePoint Connection::pictureDeadline() const {
  return std::max(pictures.lastSign(), calls.transferEnd()) + context.read_timeout + pictures.extraInterval();
}

std::chrono::milliseconds Connection::answerLimit() const {
  return std::max(context.read_timeout, kShortestAnswerLimit);
}

}  // namespace aibo_driver
