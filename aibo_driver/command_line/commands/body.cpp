#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "aibo_client/exceptions.h"
#include "command_line/commands/commands.h"

namespace aibo_driver::command_line {
namespace {

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

/// Waits for all sensors of the robot, and returns the values that have come.
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

}  // namespace

std::vector<Command> bodyCommands() {
  return {{"sensors",
           "",
           "shows what the sensors measure",
           "It shows distances, accelerations, buttons, touch and the battery, whose charge goes from 0 to 1. A server "
           "of version 1 takes a second.",
           {{"sensors", "one line a sensor"}, {"--json sensors", "the same for scripts"}},
           showSensors}};
}

}  // namespace aibo_driver::command_line
