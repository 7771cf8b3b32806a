#include "client/units.h"

#include "protocol/sensor_values.h"
#include "robot_model/robot_model.h"

namespace aibo_driver {
namespace {

robot_model::SensorKind kindOf(const std::string& design, int id) {
  const robot_model::RobotModel* model = robot_model::findRobotModel(design.c_str());
  const int index = model == nullptr ? robot_model::NO_SENSOR : robot_model::findSensorByIdentifier(*model, id);
  return index == robot_model::NO_SENSOR ? robot_model::SENSOR_DISTANCE : model->sensors[index].kind;
}

}  // namespace

SensorReading makeVersion1Reading(int id, short value) {
  return {id, protocol::sensorValueFromVersion1(kindOf("ERS-7", id), value)};
}

SensorReading makeVersion2Reading(const std::string& design, int id, int value) {
  return {id, protocol::sensorValueFromVersion2(kindOf(design, id), value)};
}

}  // namespace aibo_driver
