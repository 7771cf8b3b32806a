// Units on the wire: docs/protocol.md, "Sensors" and "Requests of version 1".
#include "protocol/units.h"

#include <gmock/gmock.h>

#include <climits>
#include <utility>

namespace protocol {
namespace {

using namespace robot_model;

TEST(Angles, OfVersion1AreHundredthsOfADegree) {
  const struct {
    int centidegrees;
    int microradians;
  } rows[] = {{0, 0},          {1, 175},         {-1, -175},         {-7500, -1308997},
              {8800, 1535890}, {13000, 2268928}, {-11500, -2007129}, {-300, -52360}};
  for (const auto& row : rows) {
    EXPECT_EQ(microradiansFromCentidegrees(static_cast<short>(row.centidegrees)), row.microradians);
    EXPECT_EQ(centidegreesFromMicroradians(row.microradians), row.centidegrees);
  }
  for (int centidegrees = SHRT_MIN; centidegrees <= SHRT_MAX; ++centidegrees) {
    const short value = static_cast<short>(centidegrees);
    ASSERT_EQ(centidegreesFromMicroradians(microradiansFromCentidegrees(value)), value);
  }
}

TEST(Angles, AreRoundedToTheNearestAndLimited) {
  const std::pair<int, int> rows[] = {{87, 0},          {88, 1},           {-87, 0},         {-88, -1},
                                      {5719095, 32767}, {10057460, 32767}, {INT_MAX, 32767}, {-5719270, -32768},
                                      {INT_MIN, -32768}};
  for (const auto& [microradians, centidegrees] : rows) {
    EXPECT_EQ(centidegreesFromMicroradians(microradians), centidegrees) << microradians;
  }
}

TEST(SensorValues, HaveTheUnitsOfTheDocument) {
  const struct {
    SensorKind kind;
    int measured;
    int version1;
    int version2;
    double si;
  } rows[] = {
      {SENSOR_DISTANCE, 230000, 23, 230000, 0.23},
      {SENSOR_ACCELERATION, -9810000, -981, -9810000, -9.81},
      {SENSOR_ACCELERATION, 19610000, 1961, 19610000, 19.61},
      {SENSOR_FORCE, 980000, 98, 980000, 0.98},
      {SENSOR_TEMPERATURE, 38250000, 3825, 38250000, 38.25},
      {SENSOR_CHARGE, 870000, 87, 870000, 0.87},
      {SENSOR_TOUCH, 14, 14, 14000000, 14},
      {SENSOR_SWITCH, 0, 0, 0, 0},
      {SENSOR_SWITCH, 1, 1, 1, 1},
  };
  for (const auto& row : rows) {
    EXPECT_EQ(version1SensorValue(row.kind, row.measured), row.version1) << row.kind;
    EXPECT_EQ(version2SensorValue(row.kind, row.measured), row.version2) << row.kind;
    EXPECT_DOUBLE_EQ(sensorValueFromVersion1(row.kind, static_cast<short>(row.version1)), row.si) << row.kind;
    EXPECT_DOUBLE_EQ(sensorValueFromVersion2(row.kind, row.version2), row.si) << row.kind;
  }
}

TEST(SensorValues, AreRoundedToTheNearestAndLimited) {
  EXPECT_EQ(version1SensorValue(SENSOR_DISTANCE, 234999), 23);
  EXPECT_EQ(version1SensorValue(SENSOR_DISTANCE, 235000), 24);
  EXPECT_EQ(version1SensorValue(SENSOR_ACCELERATION, -5000), -1);
  EXPECT_EQ(version1SensorValue(SENSOR_DISTANCE, INT_MAX), 32767);
  EXPECT_EQ(version1SensorValue(SENSOR_ACCELERATION, INT_MIN), -32768);
  EXPECT_EQ(version1SensorValue(SENSOR_TOUCH, 100000), 32767);
  EXPECT_EQ(version2SensorValue(SENSOR_TOUCH, 2148), INT_MAX);
  EXPECT_EQ(version2SensorValue(SENSOR_TOUCH, INT_MIN), INT_MIN);
}

}  // namespace
}  // namespace protocol
