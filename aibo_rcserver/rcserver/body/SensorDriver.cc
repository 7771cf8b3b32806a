#include "rcserver/body/SensorDriver.h"

#include <OPENR/OPENRAPI.h>

#include <algorithm>

namespace {

const unsigned FRAMES_BETWEEN_POWER = 125;  // 1 s

// The charge in millionths. OPEN-R gives it in per cent.
int ChargeOf(const OPowerStatus& status) {
  return std::min<int>(status.remainingCapacity, 100) * 10000;
}

// The temperature in millionths of a degree Celsius. OPEN-R gives it in tenths of a kelvin. Readings above 1000 K are
// clamped, so that the result fits.
int TemperatureOf(const OPowerStatus& status) {
  return (std::min<int>(status.temperature, 10000) * 2 - 5463) * 50000;
}

}  // namespace

SensorDriver::SensorDriver(const robot_model::RobotModel& robot)
    : robot_(robot), power_interval_(FRAMES_BETWEEN_POWER) {
  for (int i = 0; i < robot_model::MAX_SENSORS; ++i) {
    has_value_[i] = false;
    values_[i] = 0;
  }
}

void SensorDriver::Open() {
  for (int i = 0; i < robot_.number_of_sensors; ++i) {
    if (robot_.sensors[i].locator != NULL) {
      primitives_.Open(i, robot_.sensors[i].name, robot_.sensors[i].locator);
    }
  }
}

bool SensorDriver::Read(OSensorFrameVectorData* vector, longword* frame) {
  SensorReports reports(vector, primitives_);
  bool is_any = false;
  while (reports.Next()) {
    is_any = true;
    *frame = reports.Frame();
    OSensorValue report;
    reports.Read(&report);
    Measured(reports.Row(), report.value);
  }
  if (is_any && power_interval_.Chooses(*frame)) {
    ReadPower();
  }
  return is_any;
}

void SensorDriver::Measured(int sensor, int value) {
  has_value_[sensor] = true;
  values_[sensor] = value;
}

// Sensors that are not primitives get their values from the power supply.
void SensorDriver::ReadPower() {
  OPowerStatus status;
  if (OPENR::GetPowerStatus(&status) != oSUCCESS) {
    return;
  }
  for (int i = 0; i < robot_.number_of_sensors; ++i) {
    if (robot_.sensors[i].locator == NULL) {
      Measured(i, robot_.sensors[i].kind == robot_model::SENSOR_CHARGE ? ChargeOf(status) : TemperatureOf(status));
    }
  }
}
