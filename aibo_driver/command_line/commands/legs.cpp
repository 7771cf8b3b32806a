#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <string>

#include "aibo_client/exceptions.h"
#include "command_line/commands/commands.h"
#include "command_line/interruption.h"
#include "command_line/quantities.h"
#include "text/sentence.h"

namespace aibo_driver::command_line {

using aibo_client::Posture;
using aibo_client::WalkVelocity;

namespace {

constexpr std::chrono::milliseconds kSteeringPeriod{100};  // the robot stops 500 ms after the last command
constexpr double kLongestWalk = 60;                        // s
constexpr double kLongestPosture = 30;                     // s; lying down from standing takes about 5
constexpr double kStep = 0.001;                            // m/s and rad/s; velocities are sent in such steps

WalkVelocity velocityOf(const Arguments& arguments) {
  WalkVelocity velocity;
  for (const Assignment& part : parseAssignments(arguments.words, "forward=0.1m/s")) {
    if (part.name == "forward") {
      velocity.forward = parseSpeed("forward", part.value);
    } else if (part.name == "left") {
      velocity.left = parseSpeed("left", part.value);
    } else if (part.name == "turn") {
      velocity.turn = parseAngularSpeed("turn", part.value);
    } else {
      throw aibo_client::InvalidArgumentException("a walk has forward, left and turn, not '" + part.name + "'");
    }
  }
  return velocity;
}

/// False if the velocity is sent as 0.
bool moves(const WalkVelocity& velocity) {
  return std::max({std::abs(velocity.forward), std::abs(velocity.left), std::abs(velocity.turn)}) >= kStep / 2;
}

/// True if the robot walks otherwise than it was asked to.
bool isOther(const WalkVelocity& in_force, const WalkVelocity& wanted) {
  return std::abs(in_force.forward - wanted.forward) > kStep || std::abs(in_force.left - wanted.left) > kStep ||
         std::abs(in_force.turn - wanted.turn) > kStep;
}

std::string wordsOf(const WalkVelocity& velocity) {
  return "forward=" + text::decimal(velocity.forward, 3) + "m/s left=" + text::decimal(velocity.left, 3) +
         "m/s turn=" + text::decimal(velocity.turn, 3) + "rad/s";
}

/// Steers until the time is over or somebody presses Ctrl-C. After that, the robot stops in an orderly way.
void steer(Robot& robot, const WalkVelocity& velocity, double seconds) {
  using std::chrono::steady_clock;
  const steady_clock::time_point end = steady_clock::now() + nanosecondsOf(seconds);
  bool interrupted = false;
  robot.client().steer({});  // a walk begins only after a velocity of 0
  try {
    do {
      robot.client().steer(velocity, Robot::terms());
    } while (!robot.waitUnlessRefused([](const Received& received) { return received.end.has_value(); },
                                      std::min<std::chrono::nanoseconds>(kSteeringPeriod, end - steady_clock::now())) &&
             steady_clock::now() < end);
  } catch (const Interrupted&) {
    interrupted = true;
  } catch (const aibo_client::CommandException&) {
    if (!robot.received().velocity) {
      throw;
    }
    // The robot has ended the walk by itself, and now refuses to be steered. It then says how the walk has ended.
  }
  robot.client().steer({});
  if (interrupted) {
    robot.client().hold({}, Robot::kTimeout);
    throw Interrupted("the walk was interrupted");
  }
}

ExitStatus walk(const Arguments& arguments, Output& output) {
  const WalkVelocity velocity = velocityOf(arguments);
  const double seconds = arguments.number("seconds", 0.1, kLongestWalk);
  if (!moves(velocity)) {
    throw aibo_client::InvalidArgumentException(
        "a walk needs a velocity of at least 1mm/s or 0.001rad/s: see `aibo help walk`");
  }
  aibo_client::ClientOptions options;
  options.guard_walks = !arguments.has("unguarded");
  Robot robot(arguments.robot, output, options);
  robot.connect();
  steer(robot, velocity, seconds);
  const WalkVelocity in_force = robot.received().velocity.value_or(WalkVelocity());
  if (isOther(in_force, velocity)) {
    output.note("The robot cannot walk with " + wordsOf(velocity) + ": it walks with " + wordsOf(in_force) + ".");
  }
  if (!robot.waitForEnd("the walk", kLongestPosture)) {
    throw FailedException("the robot does not say that it stands");
  }
  output.result(
      "The robot has walked and stands.",
      Json::object(
          {{"walked", true}, {"forward", in_force.forward}, {"left", in_force.left}, {"turn", in_force.turn}}));
  return kDone;
}

/// @param motors what happens to the motors, in a sentence
/// @param done what the user is told at the end
Command postureCommand(const std::string& name, Posture posture, const std::string& summary, const std::string& motors,
                       const std::string& done) {
  const auto take = [=](const Arguments& arguments, Output& output) {
    Robot robot(arguments.robot, output);
    robot.connect();
    robot.client().takePosture(posture, Robot::kTimeout, Robot::terms());
    if (!robot.waitForEnd(name, kLongestPosture)) {
      throw FailedException("the robot did not take the posture in time");
    }
    output.result(done, Json::object({{"posture", name}}));
    return kDone;
  };
  return {name,
          "",
          summary,
          "The command ends when the robot has taken the posture. Ctrl-C ends it at once, and the joints hold. " +
              motors + " A server of version 1 has no such request.",
          {{name, summary}},
          take};
}

}  // namespace

std::vector<Command> legCommands() {
  return {
      {"walk",
       "[forward=SPEED] [left=SPEED] [turn=SPEED]",
       "walks for a short time",
       "Speeds need units: m/s, cm/s or mm/s, and deg/s or rad/s for turn; negative ones go back, to the right and "
       "clockwise. The robot keeps to its limits, and the command says with which velocity it walks then. It stands up "
       "first if it has to, and stands at the end. Ctrl-C stops it, and so does a lost connection, within half a "
       "second. The robot ends the walk before edges and walls that its sensors see; backward and sideways, it walks "
       "only where it has just walked. The motors have to be on. A server "
       "of version 1 cannot walk.",
       {{"walk forward=5cm/s --seconds 3", "about 15 cm"}, {"walk turn=-20deg/s", "to the right"}},
       walk,
       {{"seconds", "S", "1", "how long, 0.1 to 60"},
        {"unguarded", "", "", "walk on before edges and walls, and where the robot cannot see"}}},
      postureCommand("stand", Posture::kStand, "stands up", "The robot switches its motors on first.",
                     "The robot stands."),
      postureCommand("sit", Posture::kSit, "sits down", "The robot switches its motors on first.", "The robot sits."),
      postureCommand("rest", Posture::kRest, "lies down and switches the motors off",
                     "When the robot lies, it switches its motors off.", "The robot lies, and its motors are off.")};
}

}  // namespace aibo_driver::command_line
