#include <algorithm>
#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "aibo_client/exceptions.h"
#include "command_line/commands/commands.h"
#include "command_line/interruption.h"
#include "command_line/quantities.h"
#include "files/files.h"
#include "movement/joint_table.h"

namespace aibo_driver::command_line {
namespace {

constexpr std::chrono::milliseconds kPlayTimeout{2000};
constexpr std::chrono::milliseconds kFileTimeout{5000};
constexpr std::chrono::milliseconds kUploadTimeout{15000};
constexpr double kLongestPlay = 3600;       // s
constexpr double kLowestMotionSpeed = 0.1;  // rad/s, as in the driver
constexpr double kBlindPlay = 10;           // s, for a server that does not report ends

ExitStatus list(const Arguments& arguments, Output& output) {
  Robot robot(arguments.robot, output);
  robot.connect();
  const std::vector<std::string> names = robot.client().listMotions(kFileTimeout);
  std::string words;
  for (const std::string& name : names) {
    words += (words.empty() ? "" : "\n") + name;
  }
  output.result(names.empty() ? "There are no motions on the robot." : words,
                Json::object({{"motions", Json::array({names.begin(), names.end()})}}));
  return kDone;
}

/// Waits while a motion plays. It stops the motion when the time has passed, and at Ctrl-C.
/// @return what the robot has said about the motion's end, if the motion has played to its end
std::optional<std::string> waitWhileItPlays(Robot& robot, const std::string& name, double seconds) {
  std::optional<std::string> done;
  try {
    if (robot.reportsEnds()) {
      done = robot.waitForEnd(name, seconds);
    } else {
      robot.waitUntil([](const Received&) { return false; }, nanosecondsOf(seconds));
    }
  } catch (const Interrupted&) {
    robot.client().stopMotion(name, kPlayTimeout);
    throw;
  }
  if (!done) {
    robot.client().stopMotion(name, kPlayTimeout);
  }
  return done;
}

ExitStatus play(const Arguments& arguments, Output& output) {
  const std::string name = files::motionFileName(arguments.words.front());
  const int times = arguments.wholeNumber("times", 1, 65535);
  const bool limited = arguments.has("seconds");
  double seconds = limited ? arguments.number("seconds", 0.1, kLongestPlay) : kLongestPlay;
  const double speed =
      arguments.has("speed") ? parseAngularSpeed("--speed", arguments.get("speed")) : movement::kNoSpeedLimit;
  if (!(speed >= kLowestMotionSpeed && speed <= movement::kNoSpeedLimit)) {
    throw aibo_client::InvalidArgumentException("--speed must be from 5.8deg/s (0.1 rad/s) to 1145deg/s (20 rad/s)");
  }
  Robot robot(arguments.robot, output);
  robot.connect();
  if (!robot.reportsEnds() && !limited) {
    seconds = kBlindPlay;
    output.note("This server does not say when a motion ends, so it is stopped after 10 s (--seconds).");
  }
  const movement::JointTable table(robot.model().design, movement::kUsualSpeedLimit, speed);
  robot.client().setJointSpeedLimits(table.motionSpeedLimits());
  const std::string changes = robot.client().playMotion(name, times, kPlayTimeout, Robot::terms());
  if (!changes.empty()) {
    output.note(name + " plays differently than in its file: " + changes + ".");
  }
  const std::optional<std::string> done = waitWhileItPlays(robot, name, seconds);
  const std::string remark = done && !done->empty() ? ": " + *done + "." : ".";
  output.result(
      name + (done ? " was played to its end" + remark : " was played, and stopped when its time was over."),
      Json::object(
          {{"motion", name}, {"to_its_end", done.has_value()}, {"changes", changes}, {"remark", done.value_or("")}}));
  return kDone;
}

ExitStatus upload(const Arguments& arguments, Output& output) {
  const std::string& file = arguments.words.front();
  const std::string given =
      arguments.words.size() > 1 ? arguments.words[1] : std::filesystem::path(file).filename().string();
  const std::string name = files::motionFileName(given);
  const std::vector<std::uint8_t> content = files::loadMotion(file);
  Robot robot(arguments.robot, output);
  robot.connect();
  robot.client().uploadMotion(name, content, kUploadTimeout);
  output.result(name + " is on the robot, " + std::to_string(content.size()) + " bytes.",
                Json::object({{"motion", name}, {"bytes", content.size()}}));
  return kDone;
}

ExitStatus deleteMotion(const Arguments& arguments, Output& output) {
  const std::string name = files::motionFileName(arguments.words.front());
  Robot robot(arguments.robot, output);
  robot.connect();
  robot.client().deleteMotion(name, kFileTimeout);
  output.result(name + " was deleted from the robot.", Json::object({{"motion", name}}));
  return kDone;
}

}  // namespace

std::vector<Command> motionCommands() {
  return {
      {"motions",
       "",
       "lists the motions on the robot's memory stick",
       "A server of version 1 cannot list them, but plays them by name.",
       {{"motions", "one name a line"}},
       list},
      {"play",
       "MOTION",
       "plays a motion from the robot's memory stick",
       "It stays connected until the motion has ended, because the robot stops its motions when its client goes; "
       "Ctrl-C stops it. The motors have to be on. Joints are as fast as the motion asks for, up to their own limits.",
       {{"play nod", "plays NOD.MTN once"}, {"play wag --times 3", "three times"}},
       play,
       {{"times", "N", "1", "how often, 1 to 65535"},
        {"speed", "V", "", "limit for all joints, such as 90deg/s; 5.8deg/s to 1145deg/s"},
        {"seconds", "S", "",
         "longest time to play; the default is to its end, or 10 if the server does not report ends"}}},
      {"upload",
       "FILE [NAME]",
       "stores a motion on the robot's memory stick",
       "The file has to be a motion (MTN). RCSERVER.CFG on the robot has to allow it (ALLOW_UPLOAD). Without NAME, the "
       "motion gets the name of its file: at most eight characters and .MTN.",
       {{"upload wave.mtn", "the robot can now play WAVE.MTN"}},
       upload},
      {"delete",
       "MOTION",
       "deletes a motion from the robot's memory stick",
       "RCSERVER.CFG on the robot has to allow it (ALLOW_DELETE).",
       {{"delete wave", "WAVE.MTN is gone"}},
       deleteMotion}};
}

}  // namespace aibo_driver::command_line
