#include "robot_model/robot_model.h"

#include <string.h>

#include <algorithm>

#include "robot_model/tables.h"

namespace robot_model {

namespace {

const int NOT_FOUND = -1;

template <typename Part>
int findByIdentifier(const Part* parts, int count, int identifier) {
  for (int i = 0; i < count; ++i) {
    if (parts[i].identifier == identifier) {
      return i;
    }
  }
  return NOT_FOUND;
}

template <typename Part>
int findByName(const Part* parts, int count, const char* name) {
  for (int i = 0; i < count; ++i) {
    if (strcmp(parts[i].name, name) == 0) {
      return i;
    }
  }
  return NOT_FOUND;
}

// The index of the part with this locator. A part without a locator is not a primitive of OPEN-R.
template <typename Part>
int findByLocator(const Part* parts, int count, const char* locator) {
  for (int i = 0; i < count; ++i) {
    if (parts[i].locator != 0 && strcmp(parts[i].locator, locator) == 0) {
      return i;
    }
  }
  return NOT_FOUND;
}

}  // namespace

const RobotModel* findRobotModel(const char* design) {
  const RobotModel* const models[] = {&ERS7, &ERS210};
  for (size_t i = 0; i < sizeof(models) / sizeof(models[0]); ++i) {
    if (strcmp(models[i]->design, design) == 0) {
      return models[i];
    }
  }
  return 0;
}

int findJointByIdentifier(const RobotModel& model, int identifier) {
  return findByIdentifier(model.joints, model.number_of_joints, identifier);
}

int findJointByName(const RobotModel& model, const char* name) {
  return findByName(model.joints, model.number_of_joints, name);
}

int findJointByLocator(const RobotModel& model, const char* locator) {
  return findByLocator(model.joints, model.number_of_joints, locator);
}

int findSensorByIdentifier(const RobotModel& model, int identifier) {
  return findByIdentifier(model.sensors, model.number_of_sensors, identifier);
}

int findSensorByName(const RobotModel& model, const char* name) {
  return findByName(model.sensors, model.number_of_sensors, name);
}

int findSensorByLocator(const RobotModel& model, const char* locator) {
  return findByLocator(model.sensors, model.number_of_sensors, locator);
}

int findLedByIdentifier(const RobotModel& model, int identifier) {
  return findByIdentifier(model.leds, model.number_of_leds, identifier);
}

int findLedByName(const RobotModel& model, const char* name) {
  return findByName(model.leds, model.number_of_leds, name);
}

int findLedByLocator(const RobotModel& model, const char* locator) {
  return findByLocator(model.leds, model.number_of_leds, locator);
}

int findEarByIdentifier(const RobotModel& model, int identifier) {
  return findByIdentifier(model.ears, model.number_of_ears, identifier);
}

int findEarByName(const RobotModel& model, const char* name) {
  return findByName(model.ears, model.number_of_ears, name);
}

int findEarByLocator(const RobotModel& model, const char* locator) {
  return findByLocator(model.ears, model.number_of_ears, locator);
}

bool isPressed(const Sensor& sensor, double value, bool was_pressed) {
  return sensor.on > 0 && value >= (was_pressed ? sensor.off : sensor.on);
}

int defaultAcceleration(const Joint& joint) {
  return joint.highest_speed * 10;
}

int coupledLowest(const Coupling& coupling, int leader_position) {
  const CouplingRow* const rows = coupling.rows;
  const int last = coupling.number_of_rows - 1;

  int first_not_below = 0;
  while (first_not_below < last && rows[first_not_below].to < leader_position) {
    ++first_not_below;
  }
  int last_not_above = last;
  while (last_not_above > 0 && rows[last_not_above].from > leader_position) {
    --last_not_above;
  }
  // The first and the last of these rows may be one row, two overlapping rows, or the rows on both sides of a gap.
  return std::max(rows[first_not_below].lowest, rows[last_not_above].lowest);
}

int lowestPosition(const RobotModel& model, int joint, const int* posture) {
  int lowest = model.joints[joint].lowest;
  for (int i = 0; i < model.number_of_couplings; ++i) {
    const Coupling& coupling = model.couplings[i];
    if (coupling.follower == joint) {
      lowest = std::max(lowest, coupledLowest(coupling, posture[coupling.leader]));
    }
  }
  return lowest;
}

void clampPosture(const RobotModel& model, int* posture) {
  for (int i = 0; i < model.number_of_joints; ++i) {
    posture[i] = std::min(std::max(posture[i], model.joints[i].lowest), model.joints[i].highest);
  }
  for (int i = 0; i < model.number_of_joints; ++i) {
    posture[i] = std::max(posture[i], lowestPosition(model, i, posture));
  }
}

}  // namespace robot_model
