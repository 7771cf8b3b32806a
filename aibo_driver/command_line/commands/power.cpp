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
  output.result(holds ? "The robot holds."
                      : "All motions are stopped. This server has no request that stops joints on their way.",
                Json::object({{"stopped", true}, {"holds", holds}}));
  return kDone;
}

}  // namespace

std::vector<Command> powerCommands() {
  return {
      {"motors",
       "on|off",
       "switches the motors of all joints on or off",
       "With the motors off, the joints can be moved by hand, and a robot that stands will fall: hold it. They stay as "
       "they are when the command ends. A server of version 1 has no such request.",
       {{"motors on", "the joints hold where they are"}, {"motors off", "the robot goes limp"}},
       switchMotors},
      {"stop",
       "",
       "stops everything that moves",
       "The joints brake and hold, until the next command. The robot serves one client at a time: while a driver or "
       "another command is connected, stop there (Ctrl-C, or rosservice call /aibo/stop, which holds until "
       "/aibo/release). A robot without a client has already stopped.",
       {{"stop", "motions, walks and joints stop"}},
       stop}};
}

}  // namespace aibo_driver::command_line
