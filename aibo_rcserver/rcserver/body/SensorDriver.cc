#include "rcserver/body/SensorDriver.h"

#include <OPENR/OPENRAPI.h>

#include <algorithm>

#include "rcserver/body/SensorReports.h"

using robot_model::Sensor;

namespace {

const longword FRAMES_BETWEEN_POWER = 125;  // 1 s

// Per cent in millionths of all.
int ChargeOf(const OPowerStatus& status) {
  return std::min<int>(status.remainingCapacity, 100) * 10000;
}

// Tenths of a kelvin in millionths of a degree Celsius. Nothing that is hotter than 1000 kelvin tells it.
int TemperatureOf(const OPowerStatus& status) {
  return (std::min<int>(status.temperature, 10000) * 2 - 5463) * 50000;
}

}  // namespace

SensorDriver::SensorDriver() : sensors_(NULL), last_power_(0 - FRAMES_BETWEEN_POWER) {}

SensorDriver::~SensorDriver() {
  delete sensors_;
}

void SensorDriver::Open(const robot_model::RobotModel& robot) {
  sensors_ = new Sensors(robot);
  for (int i = 0; i < robot.number_of_sensors; ++i) {
    if (robot.sensors[i].locator != NULL) {
      primitives_.Open(i, robot.sensors[i].name, robot.sensors[i].locator);
    }
  }
}

void SensorDriver::Close() {
  primitives_.Close();
  delete sensors_;
  sensors_ = NULL;
}

bool SensorDriver::Read(OSensorFrameVectorData* vector, longword* frame) {
  SensorReports reports(vector, primitives_);
  bool is_any = false;
  while (reports.Next()) {
    is_any = true;
    *frame = reports.Frame();
    OSensorValue report;
    reports.Read(&report);
    sensors_->Measured(reports.Row(), report.value);
  }
  if (is_any && *frame - last_power_ >= FRAMES_BETWEEN_POWER) {
    ReadPower(*frame);
  }
  return is_any;
}

// What is no primitive comes from the power supply.
void SensorDriver::ReadPower(longword now) {
  last_power_ = now;
  OPowerStatus status;
  if (OPENR::GetPowerStatus(&status) != oSUCCESS) {
    return;
  }
  for (int i = 0; i < sensors_->NumberOfSensors(); ++i) {
    const Sensor& sensor = sensors_->Sensor(i);
    if (sensor.locator == NULL) {
      sensors_->Measured(i, sensor.kind == robot_model::SENSOR_CHARGE ? ChargeOf(status) : TemperatureOf(status));
    }
  }
}
