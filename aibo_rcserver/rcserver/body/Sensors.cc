#include "rcserver/body/Sensors.h"

Sensors::Sensors(const robot_model::RobotModel& robot) : robot_(robot) {
  for (int i = 0; i < robot_model::MAX_SENSORS; ++i) {
    has_value_[i] = false;
    values_[i] = 0;
  }
}

void Sensors::Measured(int sensor, int value) {
  has_value_[sensor] = true;
  values_[sensor] = value;
}
