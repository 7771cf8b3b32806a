#include "node/body/power_status.h"

#include <diagnostic_msgs/DiagnosticStatus.h>
#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <gmock/gmock.h>

namespace aibo_driver::node {
namespace {

using diagnostic_msgs::DiagnosticStatus;
using diagnostic_updater::DiagnosticStatusWrapper;
using ::testing::HasSubstr;

constexpr int kBattery = 66;
constexpr int kTemperature = 67;
constexpr int kOther = 55;
constexpr bool kAsked = true;
constexpr std::uint64_t kConnection = 3;

aibo_client::Telemetry telling(std::vector<aibo_client::SensorReading> sensors) {
  aibo_client::Telemetry telemetry;
  telemetry.connection_number = kConnection;
  telemetry.sensors = std::move(sensors);
  telemetry.sensors.insert(telemetry.sensors.begin(), {kOther, 0.33});
  return telemetry;
}

DiagnosticStatusWrapper reportOf(const PowerStatus& power, bool asked = kAsked) {
  DiagnosticStatusWrapper status;
  power.report(asked, kConnection, status);
  return status;
}

DiagnosticStatusWrapper reportAt(double charge, double temperature) {
  PowerStatus power(*robot_model::findRobotModel("ERS-7"));
  power.update(telling({{kBattery, 0.01}, {kTemperature, 80}}));
  power.update(telling({{kTemperature, temperature}, {kBattery, charge}}));
  return reportOf(power);
}

TEST(PowerStatus, HasALevelForChargeAndHeat) {
  constexpr auto kOk = DiagnosticStatus::OK;
  constexpr auto kWarn = DiagnosticStatus::WARN;
  constexpr auto kError = DiagnosticStatus::ERROR;
  const std::tuple<double, double, int, const char*> rows[] = {
      {0.87, 31.5, kOk, "battery at 87 %"},        {0.20, 30, kOk, "20 %"},
      {0.19, 30, kWarn, "19 %: charge it soon"},   {0.10, 30, kWarn, "10 %"},
      {0.09, 30, kError, "9 %: charge it now"},    {0.9, 49, kOk, ""},
      {0.9, 50, kWarn, "50 degrees Celsius: let"}, {0.9, 60, kError, "60 degrees"},
      {0.15, 50, kWarn, "15 %: charge it soon"},   {0.15, 50, kWarn, "50 degrees"},
  };
  for (const auto& [charge, temperature, level, message] : rows) {
    const DiagnosticStatusWrapper status = reportAt(charge, temperature);
    EXPECT_EQ(status.level, level) << charge << " " << temperature;
    EXPECT_THAT(status.message, HasSubstr(message));
  }
  const DiagnosticStatusWrapper status = reportAt(0.87, 31.5);
  ASSERT_EQ(status.values.size(), 2u);
  EXPECT_EQ(status.values[0].value, "87");
  EXPECT_EQ(status.values[1].value, "31.5");
}

TEST(PowerStatus, TellsTheChargeOrTheTemperatureAloneWhileTheOtherIsUnknown) {
  const robot_model::RobotModel& model = *robot_model::findRobotModel("ERS-7");
  PowerStatus hot(model);
  hot.update(telling({{kTemperature, 60}}));
  EXPECT_EQ(reportOf(hot).level, DiagnosticStatus::ERROR);
  EXPECT_THAT(reportOf(hot).message, testing::AllOf(HasSubstr("does not report its battery"), HasSubstr("60 degrees")));
  EXPECT_EQ(reportOf(hot, !kAsked).level, DiagnosticStatus::OK) << "what it told before may be over";
  PowerStatus empty(model);
  empty.update(telling({{kBattery, 0}}));
  EXPECT_EQ(reportOf(empty).message, "battery at 0 %: charge it now, the robot is about to switch itself off");
}

TEST(PowerStatus, OfASilentRobotIsAFaultOnlyIfItWasAsked) {
  PowerStatus power(*robot_model::findRobotModel("ERS-7"));
  EXPECT_EQ(reportOf(power).level, DiagnosticStatus::WARN);
  EXPECT_THAT(reportOf(power).message, HasSubstr("RCServer"));
  EXPECT_EQ(reportOf(power, !kAsked).level, DiagnosticStatus::OK);
  EXPECT_THAT(reportOf(power, !kAsked).message, HasSubstr("idle"));
}

TEST(PowerStatus, OfALostConnectionIsTheLastOneUntilTheNextMeasurement) {
  PowerStatus power(*robot_model::findRobotModel("ERS-7"));
  power.update(telling({{kBattery, 0.05}, {kTemperature, 70}}));
  EXPECT_THAT(reportOf(power, !kAsked).message, HasSubstr("last measured: battery at 5 %"));
  EXPECT_EQ(reportOf(power, !kAsked).level, DiagnosticStatus::OK);
  DiagnosticStatusWrapper after_reconnect;
  power.report(kAsked, kConnection + 1, after_reconnect);
  EXPECT_THAT(after_reconnect.message, HasSubstr("does not report its battery"));
  EXPECT_EQ(after_reconnect.level, DiagnosticStatus::WARN);
}

}  // namespace
}  // namespace aibo_driver::node
