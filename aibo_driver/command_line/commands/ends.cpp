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

auto endIn(const Received& received) {
  return std::find_if(received.ends.begin(), received.ends.end(),
                      [](const aibo_client::ActivityEnd& end) { return end.order == Robot::kOrder; });
}

}  // namespace

std::optional<std::string> waitForEnd(Robot& robot, const std::string& name, double seconds) {
  if (!robot.waitUntil(hasEnded, nanosecondsOf(seconds))) {
    return std::nullopt;
  }
  const Received received = robot.received();
  const aibo_client::ActivityEnd end = *endIn(received);
  if (end.how != EndedHow::kDone) {
    throw FailedException(name + " " + wordsOf(end.how) + (end.reason.empty() ? "" : ": " + end.reason));
  }
  return end.reason;
}

bool hasEnded(const Received& received) {
  return endIn(received) != received.ends.end();
}

}  // namespace aibo_driver::command_line
