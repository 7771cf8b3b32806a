#include "node/body/power_status.h"

#include <diagnostic_msgs/DiagnosticStatus.h>
#include <diagnostic_updater/DiagnosticStatusWrapper.h>
#include <gmock/gmock.h>

namespace aibo_driver::node {
namespace {

using diagnostic_msgs::DiagnosticStatus;
using diagnostic_updater::DiagnosticStatusWrapper;
using ::testing::AllOf;
using ::testing::HasSubstr;

constexpr int kBattery = 66;
constexpr int kTemperature = 67;
constexpr int kOther = 55;
constexpr bool kAsked = true;

aibo_client::Telemetry telling(std::vector<aibo_client::SensorReading> sensors) {
  aibo_client::Telemetry telemetry;
  telemetry.sensors = std::move(sensors);
  telemetry.sensors.insert(telemetry.sensors.begin(), {kOther, 0.33});
  return telemetry;
}

DiagnosticStatusWrapper reportOf(const PowerStatus& power, bool asked = kAsked) {
  DiagnosticStatusWrapper status;
  power.report(asked, status);
  return status;
}

DiagnosticStatusWrapper reportAt(double charge, double temperature) {
  PowerStatus power(*robot_model::findRobotModel("ERS-7"));
  power.update(telling({{kBattery, 0.01}, {kTemperature, 80}}));
  power.update(telling({{kTemperature, temperature}, {kBattery, charge}}));
  return reportOf(power);
}

TEST(PowerStatus, ReportsHowFullAndWarmTheBatteryIs) {
  const DiagnosticStatusWrapper status = reportAt(0.87, 31.5);
  EXPECT_EQ(status.level, DiagnosticStatus::OK);
  EXPECT_EQ(status.message, "battery at 87 %");
  ASSERT_EQ(status.values.size(), 2u);
  EXPECT_EQ(status.values[0].value, "87");
  EXPECT_EQ(status.values[1].value, "31.5");
}

TEST(PowerStatus, WarnsBelow20PercentAndFailsBelow10) {
  EXPECT_EQ(reportAt(0.20, 30).level, DiagnosticStatus::OK);
  EXPECT_EQ(reportAt(0.19, 30).level, DiagnosticStatus::WARN);
  EXPECT_EQ(reportAt(0.10, 30).level, DiagnosticStatus::WARN);
  EXPECT_EQ(reportAt(0.09, 30).level, DiagnosticStatus::ERROR);
  EXPECT_THAT(reportAt(0.09, 30).message, AllOf(HasSubstr("9 %"), HasSubstr("charge it now")));
}

TEST(PowerStatus, WarnsOfHeatAndOfBothAtOnce) {
  EXPECT_EQ(reportAt(0.9, 49).level, DiagnosticStatus::OK);
  EXPECT_EQ(reportAt(0.9, 50).level, DiagnosticStatus::WARN);
  EXPECT_EQ(reportAt(0.9, 60).level, DiagnosticStatus::ERROR);
  EXPECT_THAT(reportAt(0.15, 50).message,
              AllOf(HasSubstr("15 %: charge it soon"), HasSubstr("50 degrees Celsius: let")));
}

TEST(PowerStatus, TellsTheChargeOrTheTemperatureAloneWhileTheOtherIsUnknown) {
  const robot_model::RobotModel& model = *robot_model::findRobotModel("ERS-7");
  PowerStatus hot(model);
  hot.update(telling({{kTemperature, 60}}));
  EXPECT_EQ(reportOf(hot).level, DiagnosticStatus::ERROR);
  EXPECT_THAT(reportOf(hot).message, AllOf(HasSubstr("does not report its battery"), HasSubstr("60 degrees")));
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
  power.connectionLost();
  EXPECT_THAT(reportOf(power, !kAsked).message, HasSubstr("last measured: battery at 5 %"));
  EXPECT_EQ(reportOf(power, !kAsked).level, DiagnosticStatus::OK);
  EXPECT_THAT(reportOf(power).message, HasSubstr("does not report its battery")) << "the next robot has not, yet";
  power.update(telling({{kBattery, 0.9}}));
  EXPECT_EQ(reportOf(power).level, DiagnosticStatus::OK) << "the next robot has not told its temperature yet";
}

}  // namespace
}  // namespace aibo_driver::node
