#include "node/body/power_status.h"

#include <diagnostic_msgs/DiagnosticStatus.h>
#include <diagnostic_updater/DiagnosticStatusWrapper.h>

#include <string>

#include "node/body/sensor_messages.h"
#include "text/sentence.h"

namespace aibo_driver::node {
namespace {

using diagnostic_msgs::DiagnosticStatus;
using diagnostic_updater::DiagnosticStatusWrapper;

void updateFrom(const aibo_client::Telemetry& telemetry, const robot_model::RobotModel& model, const char* name,
                std::optional<double>* value) {
  const int index = robot_model::findSensorByName(model, name);
  if (index == robot_model::NO_SENSOR) {
    return;
  }
  const std::optional<double> reading = readingOf(model.sensors[index], telemetry);
  if (reading) {
    *value = reading;
  }
}

std::string rounded(double value, const char* unit) {
  return text::decimal(value, 0) + " " + unit;
}

void warnOfCharge(double charge, DiagnosticStatusWrapper& status) {
  const std::string text = "battery at " + rounded(100 * charge, "%");
  if (charge < PowerStatus::kEmptyCharge) {
    status.mergeSummary(DiagnosticStatus::ERROR, text + ": charge it now, the robot is about to switch itself off");
  } else if (charge < PowerStatus::kLowCharge) {
    status.mergeSummary(DiagnosticStatus::WARN, text + ": charge it soon");
  }
}

void warnOfTemperature(double temperature, DiagnosticStatusWrapper& status) {
  const std::string text = "battery at " + rounded(temperature, "degrees Celsius");
  if (temperature >= PowerStatus::kHot) {
    status.mergeSummary(DiagnosticStatus::ERROR, text + ": too hot, switch the robot off and let it cool down");
  } else if (temperature >= PowerStatus::kWarm) {
    status.mergeSummary(DiagnosticStatus::WARN, text + ": let the robot rest");
  }
}

}  // namespace

void PowerStatus::update(const aibo_client::Telemetry& telemetry) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (connection_ != telemetry.connection_number) {
    connection_ = telemetry.connection_number;
    charge_.reset();
    temperature_.reset();
  }
  updateFrom(telemetry, model_, "battery", &charge_);
  updateFrom(telemetry, model_, "temperature", &temperature_);
}

void PowerStatus::report(bool asked, std::uint64_t connection, DiagnosticStatusWrapper& status) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::string last = charge_ ? "battery at " + rounded(100 * *charge_, "%") : "";
  if (!asked) {
    status.summary(DiagnosticStatus::OK, "idle: the robot is not connected, or telemetry_rate is 0" +
                                             (last.empty() ? "" : "; last measured: " + last));
    return;
  }
  const bool is_present = connection_ >= connection;
  if (is_present && charge_) {
    status.summary(DiagnosticStatus::OK, last);
    status.addf("charge, %", "%.0f", 100 * *charge_);
    warnOfCharge(*charge_, status);
  } else {
    status.summary(DiagnosticStatus::WARN, "the robot does not report its battery: does its RCServer support sensors?");
  }
  if (is_present && temperature_) {
    status.addf("temperature, degrees Celsius", "%.1f", *temperature_);
    warnOfTemperature(*temperature_, status);
  }
}

}  // namespace aibo_driver::node
