#include "client/possible_values.h"

#include <algorithm>
#include <limits>

#include "client/units.h"
#include "robot_model/robot_model.h"

namespace aibo_client {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr ValueRange kEverything = {-kInfinity, kInfinity};

constexpr double kPositionMargin = 0.2;   // rad
constexpr double kTwoTurns = 4 * 3.1416;  // rad

ValueRange possibleReadings(const robot_model::Sensor& sensor) {
  switch (sensor.kind) {
    case robot_model::SENSOR_TEMPERATURE:
      return {-40, 125};
    case robot_model::SENSOR_CHARGE:
      return {0, 1.05};
    case robot_model::SENSOR_TOUCH:
      return {0, 10.0 * sensor.highest};
    case robot_model::SENSOR_SWITCH:
      return {0, 1};
    default:  // in millionths of an SI unit
      return {std::min(0.0, 2 * fromMicro(sensor.lowest)), 2 * fromMicro(sensor.highest)};
  }
}

}  // namespace

ValueRange possiblePositions(const std::string& design, int id) {
  const robot_model::RobotModel* const model = robot_model::findRobotModel(design.c_str());
  const int index = model == nullptr ? robot_model::NO_JOINT : robot_model::findJointByIdentifier(*model, id);
  if (index == robot_model::NO_JOINT) {
    return {-kTwoTurns, kTwoTurns};
  }
  const robot_model::Joint& joint = model->joints[index];
  return {fromMicro(joint.mechanical_lowest) - kPositionMargin, fromMicro(joint.mechanical_highest) + kPositionMargin};
}

ValueRange possibleReadings(const std::string& design, int id) {
  const robot_model::RobotModel* const model = robot_model::findRobotModel(design.c_str());
  const int index = model == nullptr ? robot_model::NO_SENSOR : robot_model::findSensorByIdentifier(*model, id);
  return index == robot_model::NO_SENSOR ? kEverything : possibleReadings(model->sensors[index]);
}

bool isPossiblePlane(int width, int height) {
  return width >= 1 && width <= 416 && height >= 1 && height <= 320;
}

bool isPossible(const DetectedRegion& region, int width, int height) {
  constexpr double kRounding = 0.1;  // the robot rounds to 64ths of a pixel
  if (region.pixels == 0) {
    return region.width == 0 && region.height == 0;
  }
  const auto is_in = [](double value, int first, int count) {
    return first - kRounding <= value && value <= first + count - 1 + kRounding;
  };
  return region.width >= 1 && region.height >= 1 && region.left + region.width <= width &&
         region.top + region.height <= height && region.pixels <= static_cast<unsigned>(region.width * region.height) &&
         is_in(region.x, region.left, region.width) && is_in(region.y, region.top, region.height);
}

}  // namespace aibo_client
