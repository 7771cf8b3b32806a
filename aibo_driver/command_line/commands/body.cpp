#include <algorithm>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "aibo_driver/exceptions.h"
#include "body/led_names.h"
#include "command_line/commands/commands.h"
#include "command_line/quantities.h"

namespace aibo_driver::command_line {
namespace {

namespace po = boost::program_options;

constexpr double kLongest = 3600;  // s
constexpr double kEarTime = 0.3;   // s, until an ear has been drawn (128 ms) and let go

std::string unitOf(robot_model::SensorKind kind) {
  switch (kind) {
    case robot_model::SENSOR_DISTANCE:
      return "m";
    case robot_model::SENSOR_ACCELERATION:
      return "m/s^2";
    case robot_model::SENSOR_FORCE:
      return "N";
    case robot_model::SENSOR_TEMPERATURE:
      return "degrees Celsius";
    default:
      return "";
  }
}

bool canBePressed(const robot_model::Sensor& sensor) {
  return sensor.kind == robot_model::SENSOR_TOUCH || sensor.kind == robot_model::SENSOR_SWITCH;
}

const char* wordOf(robot_model::SensorKind kind, bool pressed) {
  return !pressed ? "" : kind == robot_model::SENSOR_TOUCH ? "touched" : "on";
}

/// Waits for all sensors of the robot, and returns what has come.
std::map<int, double> measureSensors(Robot& robot) {
  const auto all = static_cast<std::size_t>(robot.model().number_of_sensors);
  robot.client().setTelemetryPeriod(Robot::kTelemetryPeriod);
  robot.waitUntil([all](const Received& received) { return received.sensors.size() >= all; }, Robot::kMeasureTimeout);
  const std::map<int, double> sensors = robot.received().sensors;
  if (sensors.empty()) {
    throw FailedException("the robot does not report its sensors: does its server support them?");
  }
  return sensors;
}

ExitStatus showSensors(const Arguments& arguments, Output& output) {
  Robot robot(arguments.robot, output);
  robot.connect();
  const std::map<int, double> measured = measureSensors(robot);
  const robot_model::RobotModel& model = robot.model();
  std::string words;
  std::vector<Json> documents;
  for (int i = 0; i < model.number_of_sensors; ++i) {
    const robot_model::Sensor& sensor = model.sensors[i];
    const auto found = measured.find(sensor.identifier);
    if (found == measured.end()) {
      continue;
    }
    const bool pressed = canBePressed(sensor) && robot_model::isPressed(sensor, found->second, false);
    char line[128];
    std::snprintf(line, sizeof line, "%s%-24s %8.3f %s%s", words.empty() ? "" : "\n", sensor.name, found->second,
                  unitOf(sensor.kind).c_str(), wordOf(sensor.kind, pressed));
    words += line;
    documents.push_back(Json::object({{"name", sensor.name},
                                      {"value", found->second},
                                      {"unit", unitOf(sensor.kind)},
                                      {"pressed", canBePressed(sensor) ? Json(pressed) : Json()}}));
  }
  output.result(words, Json::object({{"robot", model.design}, {"sensors", Json::array(documents)}}));
  return kDone;
}

ExitStatus showBattery(const Arguments& arguments, Output& output) {
  Robot robot(arguments.robot, output);
  robot.connect();
  const robot_model::RobotModel& model = robot.model();
  const auto idOf = [&model](const char* name) {
    const int index = robot_model::findSensorByName(model, name);
    return index == robot_model::NO_SENSOR ? 0 : static_cast<int>(model.sensors[index].identifier);
  };
  const int charge_id = idOf("battery");
  const int temperature_id = idOf("temperature");
  robot.client().setTelemetryPeriod(Robot::kTelemetryPeriod);
  const bool measured = robot.waitUntil(
      [&](const Received& received) {
        return received.sensors.count(charge_id) > 0 && received.sensors.count(temperature_id) > 0;
      },
      Robot::kMeasureTimeout);
  if (!measured) {
    throw FailedException("the robot does not report its battery: does its server support sensors?");
  }
  const std::map<int, double> sensors = robot.received().sensors;
  const double charge = sensors.at(charge_id);
  const double temperature = sensors.at(temperature_id);
  char words[128];
  std::snprintf(words, sizeof words, "%.0f %% charged, %.0f degrees Celsius", 100 * charge, temperature);
  output.result(words, Json::object({{"charge", charge}, {"temperature", temperature}}));
  return kDone;
}

std::vector<LedCommand> ledCommands(const Arguments& arguments, const robot_model::RobotModel& model) {
  const std::string& mode = arguments.get<std::string>("mode");
  if (mode != "A" && mode != "B") {
    throw InvalidArgumentException("--mode can be A or B, not '" + mode + "'");
  }
  std::map<int, LedCommand> commands;
  for (const Assignment& led : parseAssignments(arguments.words, "face=0.5")) {
    const std::vector<int> ids = body::findLeds(led.name, model);
    if (ids.empty()) {
      throw InvalidArgumentException("no LED or group of LEDs is named '" + led.name + "': see `aibo help leds`");
    }
    const int level = body::ledLevel(parseNumber("the intensity of " + led.name, led.value, 0, 1));
    for (const int id : ids) {
      commands[id] = {id, level, mode == "B" ? LedMode::kB : LedMode::kA};
    }
  }
  std::vector<LedCommand> list;
  for (const auto& command : commands) {
    list.push_back(command.second);
  }
  return list;
}

ExitStatus setLeds(const Arguments& arguments, Output& output) {
  const double seconds = parseNumber("--seconds", arguments.get<std::string>("seconds"), 0, kLongest);
  Robot robot(arguments.robot, output);
  robot.connect();
  robot.client().commandLeds(ledCommands(arguments, robot.model()));
  robot.waitUnlessRefused([](const Received&) { return false; }, nanosecondsOf(seconds));
  output.result("The LEDs were set; the robot switches them off now.", Json::object({{"seconds", seconds}}));
  return kDone;
}

ExitStatus flickEars(const Arguments& arguments, Output& output) {
  const std::string which = arguments.words.empty() ? "both" : arguments.words.front();
  if (which != "left" && which != "right" && which != "both") {
    throw InvalidArgumentException("ears can be left, right or both, not '" + which + "'");
  }
  Robot robot(arguments.robot, output);
  robot.connect();
  robot.client().commandEars(which != "right", which != "left");
  robot.waitUnlessRefused([](const Received&) { return false; }, nanosecondsOf(kEarTime));
  output.result(which == "both" ? "Both ears flicked." : "The " + which + " ear flicked.",
                Json::object({{"ears", which}}));
  return kDone;
}

}  // namespace

Command sensorsCommand() {
  Command command;
  command.name = "sensors";
  command.summary = "shows what the sensors measure";
  command.details = "Distances, accelerations, buttons and touch, the battery. A server of version 1 takes a second.";
  command.examples = {{"sensors", "one line a sensor"}, {"--json sensors", "the same for scripts"}};
  command.run = showSensors;
  return command;
}

Command batteryCommand() {
  Command command;
  command.name = "battery";
  command.summary = "shows how full and how warm the battery is";
  command.details = "The charge goes from 0 to 1 in JSON.";
  command.examples = {{"battery", "such as 87 % charged, 29 degrees Celsius"}};
  command.run = showBattery;
  return command;
}

Command ledsCommand() {
  Command command;
  command.name = "leds";
  command.synopsis = "LED=INTENSITY...";
  command.summary = "lights LEDs for a while";
  command.details =
      "LEDs have names such as face_1 and head_white, and groups: face, head, back, all. An intensity goes from 0 to "
      "1. "
      "The robot switches all LEDs off when its client goes, so the command stays for --seconds, or until Ctrl-C.";
  command.examples = {{"leds face=1", "lights the face for 5 s"},
                      {"leds all=0.2 back=1 --seconds 60", "the later one counts for the back"}};
  command.fewest_words = 1;
  command.most_words = 32;
  for (const std::string& name : body::namesOfLeds(*robot_model::findRobotModel("ERS-7"))) {
    command.completions.push_back(name + "=");
  }
  command.add_options = [](po::options_description& options) {
    options.add_options()("seconds", po::value<std::string>()->default_value("5")->value_name("S"),
                          "how long, 0 to 3600")("mode",
                                                 po::value<std::string>()->default_value("A")->value_name("A|B"),
                                                 "Sony's display mode of face and back");
  };
  command.run = setLeds;
  return command;
}

Command earsCommand() {
  Command command;
  command.name = "ears";
  command.synopsis = "[left|right|both]";
  command.summary = "flicks the ears";
  command.details = "A magnet draws an ear for an eighth of a second.";
  command.examples = {{"ears", "flicks both"}, {"ears left", "flicks one"}};
  command.most_words = 1;
  command.completions = {"left", "right", "both"};
  command.run = flickEars;
  return command;
}

}  // namespace aibo_driver::command_line
