#include "command_line/commands/ends.h"

#include <algorithm>

#include "command_line/command.h"
#include "command_line/quantities.h"

namespace aibo_driver::command_line {

using aibo_client::EndedHow;

namespace {

const char* wordsOf(EndedHow how) {
  switch (how) {
    case EndedHow::kDone:
      return "was done";
    case EndedHow::kReplaced:
      return "was replaced";
    case EndedHow::kStopped:
      return "was stopped";
    case EndedHow::kRefused:
      return "could not go on";
    case EndedHow::kFell:
      return "ended because the robot fell or was lifted";
    case EndedHow::kUnknown:
    case EndedHow::kNotReached:
    case EndedHow::kLost:
      break;
  }
  return "ended in a way that this program does not know";
}

}  // namespace

std::optional<std::string> waitForEnd(Robot& robot, aibo_client::EndedKind kind, const std::string& name,
                                      double seconds) {
  const auto is_it = [&](const aibo_client::MotionEnd& end) {
    return end.kind == kind && (name.empty() || end.name == name);
  };
  const auto has_ended = [&](const Received& received) {
    return std::any_of(received.ends.begin(), received.ends.end(), is_it);
  };
  if (!robot.waitUntil(has_ended, nanosecondsOf(seconds))) {
    return std::nullopt;
  }
  const Received received = robot.received();
  const aibo_client::MotionEnd end = *std::find_if(received.ends.begin(), received.ends.end(), is_it);
  if (end.how != EndedHow::kDone) {
    throw FailedException((name.empty() ? "the movement" : name) + " " + wordsOf(end.how) +
                          (end.reason.empty() ? "" : ": " + end.reason));
  }
  return end.reason;
}

}  // namespace aibo_driver::command_line
