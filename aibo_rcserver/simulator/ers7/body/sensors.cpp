#include "simulator/ers7/body/sensors.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

namespace simulated_ers7 {

using Eigen::Isometry3d;
using Eigen::Vector3d;

struct RangeFinder {
  bool in_head;     ///< true: in the head; false: in the body
  Vector3d place;   ///< metres
  double down;      ///< downward tilt from straight ahead, in radians
  longword period;  ///< frames
  longword phase;   ///< the first frame
};

namespace {

// The positions are from Tekkotsu's kinematic table of the ERS-7. The two sensors in the head are at the camera's
// height.
const std::map<std::string, RangeFinder> kRangeFinders = {
    {"range_near", {true, Vector3d(0.0769, 0.0028, -0.0146), 0, 6, 0}},
    {"range_far", {true, Vector3d(0.0769, -0.0080, -0.0146), 0, 6, 3}},
    {"range_head", {true, Vector3d(0.0769, 0, -0.0146), 0, 4, 0}},  // the ERS-210's; place and period are our choice
    {"range_chest", {false, Vector3d(0.109136, 0, -0.003384), std::acos(-1.0) / 6, 5, 0}},
};

const std::map<std::string, Vector3d> kAccelerationAxes = {
    {"acceleration_front_back", Vector3d(1, 0, 0)},
    {"acceleration_right_left", Vector3d(0, -1, 0)},
    {"acceleration_up_down", Vector3d(0, 0, 1)},
};

const std::map<std::string, Leg> kPaws = {
    {"paw_left_front", robot_model::LEFT_FRONT_LEG},
    {"paw_left_hind", robot_model::LEFT_HIND_LEG},
    {"paw_right_front", robot_model::RIGHT_FRONT_LEG},
    {"paw_right_hind", robot_model::RIGHT_HIND_LEG},
};

Ray rayOf(const RangeFinder& finder, const Situation& situation) {
  const Isometry3d& body = situation.stance.body;
  const Isometry3d carrier = finder.in_head ? body * headInBody(situation.head) : body;
  return {carrier * finder.place, carrier.linear() * Vector3d(std::cos(finder.down), 0, -std::sin(finder.down))};
}

bool canBePressed(const robot_model::Sensor& sensor) {
  return sensor.kind == robot_model::SENSOR_TOUCH || sensor.kind == robot_model::SENSOR_SWITCH ||
         sensor.kind == robot_model::SENSOR_FORCE;
}

}  // namespace

Sensors::Sensors(const robot_model::RobotModel& model, const Scene& scene, std::uint64_t seed)
    : scene_(scene), random_(seed) {
  for (int i = 0; i < model.number_of_sensors; ++i) {
    const robot_model::Sensor& sensor = model.sensors[i];
    const bool pressed = std::string(sensor.name) == "wlan_switch";
    sensors_.push_back({&sensor, measurementOf(sensor, sensors_.size()), pressed, {}});
  }
}

std::function<int(const Situation&)> Sensors::measurementOf(const robot_model::Sensor& model, std::size_t sensor) {
  const auto paw = kPaws.find(model.name);
  switch (model.kind) {
    case robot_model::SENSOR_DISTANCE:
      return [this, sensor, &finder = kRangeFinders.at(model.name)](const Situation& situation) {
        return distance(sensor, finder, situation);
      };
    case robot_model::SENSOR_ACCELERATION:
      return [this, sensor, axis = kAccelerationAxes.at(model.name)](const Situation& situation) {
        return acceleration(sensor, axis, situation);
      };
    case robot_model::SENSOR_TOUCH:
      return
          [this, sensor](const Situation&) { return (sensors_[sensor].pressed ? kTouchStrength : 1) + errorUpTo(1); };
    case robot_model::SENSOR_SWITCH:
      if (paw != kPaws.end()) {
        return [this, sensor, leg = paw->second](const Situation& situation) {
          return static_cast<int>(sensors_[sensor].pressed || situation.stance.paw_down[leg]);
        };
      }
      return [this, sensor](const Situation&) { return static_cast<int>(sensors_[sensor].pressed); };
    case robot_model::SENSOR_FORCE:
      return [this, sensor](const Situation&) {
        return sensors_[sensor].pressed ? sensors_[sensor].model->highest / 2 : 0;
      };
    case robot_model::SENSOR_TEMPERATURE:
      return [](const Situation&) { return kRoomTemperature; };
    case robot_model::SENSOR_CHARGE:
      break;  // the battery measures these
  }
  return [](const Situation&) { return 0; };
}

void Sensors::passFrame(const Situation& situation) {
  for (Sensor& sensor : sensors_) {
    OSensorValue value = {};
    value.value = sensor.measure(situation);
    std::rotate(sensor.readings.begin(), sensor.readings.begin() + 1, sensor.readings.end());
    sensor.readings.back() = value;
  }
}

void Sensors::press(const std::string& name, bool pressed) {
  std::string known;
  for (Sensor& sensor : sensors_) {
    if (!canBePressed(*sensor.model)) {
      continue;
    }
    if (name == sensor.model->name) {
      sensor.pressed = pressed;
      return;
    }
    known += std::string(known.empty() ? "" : ", ") + sensor.model->name;
  }
  throw std::invalid_argument("there is no \"" + name + "\" to press; there are " + known);
}

int Sensors::distance(std::size_t sensor, const RangeFinder& finder, const Situation& situation) {
  const robot_model::Sensor& model = *sensors_[sensor].model;
  const bool has_measured = sensors_[sensor].readings.back().value != 0;
  if (has_measured && situation.frame % finder.period != finder.phase) {
    return sensors_[sensor].readings.back().value;
  }
  const double distance = 1e6 * scene_.castRay(rayOf(finder, situation)).distance;
  if (distance >= model.highest) {
    return static_cast<int>(model.highest);  // without an echo, the reading has no error
  }
  const double measured = distance + errorUpTo(static_cast<int>(kDistanceError * distance));
  return static_cast<int>(std::clamp<double>(measured, model.lowest, model.highest));
}

int Sensors::acceleration(std::size_t sensor, const Vector3d& axis, const Situation& situation) {
  const robot_model::Sensor& model = *sensors_[sensor].model;
  const Vector3d felt = Vector3d(0, 0, -kGravity) - situation.acceleration;
  const double along_axis = 1e6 * axis.dot(situation.stance.body.linear().transpose() * felt);
  const double measured = std::round(along_axis) + errorUpTo(kAccelerationError);
  return static_cast<int>(std::clamp<double>(measured, model.lowest, model.highest));
}

int Sensors::errorUpTo(int most) {
  // std::uniform_int_distribution is not used, because its numbers differ between libraries.
  return static_cast<int>(random_() % (2 * static_cast<std::uint64_t>(most) + 1)) - most;
}

}  // namespace simulated_ers7
