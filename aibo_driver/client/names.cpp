#include "aibo_client/names.h"

#include <vector>

#include "aibo_client/exceptions.h"
#include "protocol/walk_requests.h"
#include "robot_model/robot_model.h"

namespace aibo_client {
namespace {

using robot_model::findRobotModel;
using robot_model::RobotModel;

/// The parts of one kind.
/// @param parts, number the members of RobotModel that have them
template <typename Part>
std::vector<Part> partsOf(const std::string& design, const Part* RobotModel::*parts, int RobotModel::*number) {
  std::vector<const RobotModel*> models = {findRobotModel(design.c_str())};
  if (models.front() == nullptr) {
    models = {findRobotModel("ERS-7"), findRobotModel("ERS-210")};
  }
  std::vector<Part> found;
  for (const RobotModel* const model : models) {
    found.insert(found.end(), model->*parts, model->*parts + model->*number);
  }
  return found;
}

std::vector<robot_model::Joint> jointsOf(const std::string& design) {
  return partsOf(design, &RobotModel::joints, &RobotModel::number_of_joints);
}

std::vector<robot_model::Sensor> sensorsOf(const std::string& design) {
  return partsOf(design, &RobotModel::sensors, &RobotModel::number_of_sensors);
}

std::vector<robot_model::Led> ledsOf(const std::string& design) {
  return partsOf(design, &RobotModel::leds, &RobotModel::number_of_leds);
}

template <typename Part>
int idOf(const std::string& kind, const std::string& name, const std::vector<Part>& parts) {
  std::string names;
  for (const Part& part : parts) {
    if (name == part.name) {
      return part.identifier;
    }
    names += (names.empty() ? "" : ", ") + std::string(part.name);
  }
  throw InvalidArgumentException("there is no " + kind + " '" + name + "'; there are " + names);
}

template <typename Part>
std::string nameOf(const std::string& kind, int id, const std::vector<Part>& parts) {
  for (const Part& part : parts) {
    if (part.identifier == id) {
      return part.name;
    }
  }
  return kind + " " + std::to_string(id);
}

}  // namespace

int idOfJoint(const std::string& name, const std::string& design) {
  return idOf("joint", name, jointsOf(design));
}

int idOfSensor(const std::string& name, const std::string& design) {
  return idOf("sensor", name, sensorsOf(design));
}

int idOfLed(const std::string& name, const std::string& design) {
  return idOf("LED", name, ledsOf(design));
}

std::string nameOfJoint(int id, const std::string& design) {
  return nameOf("joint", id, jointsOf(design));
}

std::string nameOfSensor(int id, const std::string& design) {
  return nameOf("sensor", id, sensorsOf(design));
}

std::string nameOfLed(int id, const std::string& design) {
  return nameOf("LED", id, ledsOf(design));
}

std::string nameOfPosture(Posture posture) {
  return protocol::version2::postureName(static_cast<protocol::version2::Posture>(posture));
}

}  // namespace aibo_client
