#include <chrono>
#include <string>

#include "aibo_client/exceptions.h"
#include "command_line/commands/commands.h"

namespace aibo_driver::command_line {
namespace {

ExitStatus switchMotors(const Arguments& arguments, Output& output) {
  const std::string& wish = arguments.words.front();
  if (wish != "on" && wish != "off") {
    throw aibo_client::InvalidArgumentException("motors can be switched on or off, not '" + wish + "'");
  }
  Robot robot(arguments.robot, output);
  robot.connect();
  const bool on = robot.client().setMotors(wish == "on", Robot::kTimeout);
  if (on != (wish == "on")) {
    throw FailedException(std::string("the robot says that its motors are still ") + (on ? "on" : "off"));
  }
  output.result(on ? "The motors are on: the joints hold." : "The motors are off: the joints can be moved by hand.",
                Json::object({{"motors", on}}));
  return kDone;
}

ExitStatus stop(const Arguments& arguments, Output& output) {
  Robot robot(arguments.robot, output);
  robot.connect();
  const bool holds = robot.reportsEnds();
  if (holds) {
    robot.client().hold({}, Robot::kTimeout);
  } else {
    robot.client().stopMotion("", Robot::kTimeout);
  }
  output.result(holds ? "The robot holds: nothing moves it any more."
                      : "All motions are stopped. This server has no request that stops joints on their way.",
                Json::object({{"stopped", true}, {"holds", holds}}));
  return kDone;
}

}  // namespace

Command motorsCommand() {
  Command command;
  command.name = "motors";
  command.synopsis = "on|off";
  command.summary = "switches the motors of all joints on or off";
  command.details =
      "With the motors off, the joints can be moved by hand, and a robot that stands will fall: hold it. They stay as "
      "they are when the command ends. A server of version 1 has no such request.";
  command.examples = {{"motors on", "the joints hold where they are"}, {"motors off", "the robot goes limp"}};
  command.fewest_words = command.most_words = 1;
  command.completions = {"on", "off"};
  command.run = switchMotors;
  return command;
}

Command stopCommand() {
  Command command;
  command.name = "stop";
  command.summary = "stops everything that moves";
  command.details =
      "The joints brake and hold, until the next command. The robot serves one client at a time: while a driver or "
      "another command is connected, stop there (Ctrl-C, or rosservice call /aibo/stop, which holds until "
      "/aibo/release). A robot without a client has already stopped.";
  command.examples = {{"stop", "motions, walks and joints stop"}};
  command.run = stop;
  return command;
}

}  // namespace aibo_driver::command_line
