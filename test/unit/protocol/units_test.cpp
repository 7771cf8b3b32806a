#include "protocol/units.h"

#include <gmock/gmock.h>

#include <climits>
#include <cmath>

namespace protocol {
namespace {

using namespace robot_model;

TEST(Angles, OfKnownJointsAreConverted) {
  // Limits of the ERS-7's joints in degrees and in the microradians that OPEN-R programs use for them.
  EXPECT_EQ(microradiansFromCentidegrees(0), 0);
  EXPECT_EQ(microradiansFromCentidegrees(-7500), -1308997);
  EXPECT_EQ(microradiansFromCentidegrees(8800), 1535890);
  EXPECT_EQ(microradiansFromCentidegrees(13000), 2268928);
  EXPECT_EQ(microradiansFromCentidegrees(-11500), -2007129);
  EXPECT_EQ(microradiansFromCentidegrees(-300), -52360);
  EXPECT_EQ(centidegreesFromMicroradians(-1308997), -7500);
  EXPECT_EQ(centidegreesFromMicroradians(1535890), 8800);
  EXPECT_EQ(centidegreesFromMicroradians(500000), 2865);
}

TEST(Angles, AreRoundedToTheNearest) {
  // 0.01 degree is 174.533 microradian, so 0 becomes 1 at 87.27.
  EXPECT_EQ(centidegreesFromMicroradians(87), 0);
  EXPECT_EQ(centidegreesFromMicroradians(88), 1);
  EXPECT_EQ(centidegreesFromMicroradians(-87), 0);
  EXPECT_EQ(centidegreesFromMicroradians(-88), -1);
  EXPECT_EQ(microradiansFromCentidegrees(1), 175);
  EXPECT_EQ(microradiansFromCentidegrees(-1), -175);
}

TEST(Angles, OfVersion1SurviveTheRoundTripToMicroradians) {
  for (int centidegrees = SHRT_MIN; centidegrees <= SHRT_MAX; ++centidegrees) {
    const short value = static_cast<short>(centidegrees);
    const int microradians = microradiansFromCentidegrees(value);
    ASSERT_NEAR(microradians, value * 174.53292519943295, 0.5);
    ASSERT_EQ(centidegreesFromMicroradians(microradians), value);
  }
}

TEST(Angles, BeyondVersion1AreLimited) {
  EXPECT_EQ(microradiansFromCentidegrees(-32768), -5719095);
  EXPECT_EQ(centidegreesFromMicroradians(5718920), 32767);
  EXPECT_EQ(centidegreesFromMicroradians(5719095), 32767);
  EXPECT_EQ(centidegreesFromMicroradians(10057460), 32767);
  EXPECT_EQ(centidegreesFromMicroradians(INT_MAX), 32767);
  EXPECT_EQ(centidegreesFromMicroradians(-5719270), -32768);
  EXPECT_EQ(centidegreesFromMicroradians(INT_MIN), -32768);
}

TEST(SensorValues, OfMeasurementsAreHundredthsInVersion1) {
  EXPECT_EQ(version1SensorValue(SENSOR_DISTANCE, 234567), 23);          // 0.234567 m
  EXPECT_EQ(version1SensorValue(SENSOR_ACCELERATION, -9806650), -981);  // m/s^2
  EXPECT_EQ(version1SensorValue(SENSOR_ACCELERATION, 19613300), 1961);  // the most that can be measured
  EXPECT_EQ(version1SensorValue(SENSOR_FORCE, 980665), 98);             // N
  EXPECT_EQ(version1SensorValue(SENSOR_TEMPERATURE, 38250000), 3825);   // degree Celsius
  EXPECT_EQ(version1SensorValue(SENSOR_TEMPERATURE, -10000000), -1000);
  EXPECT_EQ(version1SensorValue(SENSOR_CHARGE, 870000), 87);
  EXPECT_EQ(version1SensorValue(SENSOR_CHARGE, 1000000), 100);
}

TEST(SensorValues, OfMeasurementsAreMillionthsInVersion2) {
  EXPECT_EQ(version2SensorValue(SENSOR_DISTANCE, 234567), 234567);
  EXPECT_EQ(version2SensorValue(SENSOR_ACCELERATION, -9806650), -9806650);
  EXPECT_EQ(version2SensorValue(SENSOR_CHARGE, 870000), 870000);
  EXPECT_EQ(version2SensorValue(SENSOR_TEMPERATURE, INT_MAX), INT_MAX);
  EXPECT_EQ(version2SensorValue(SENSOR_TEMPERATURE, INT_MIN), INT_MIN);
}

TEST(SensorValues, OfATouchAreItsStrength) {
  EXPECT_EQ(version1SensorValue(SENSOR_TOUCH, 0), 0);
  EXPECT_EQ(version1SensorValue(SENSOR_TOUCH, 14), 14);
  EXPECT_EQ(version2SensorValue(SENSOR_TOUCH, 14), 14000000);
  EXPECT_EQ(version2SensorValue(SENSOR_TOUCH, 80), 80000000);
}

TEST(SensorValues, OfASwitchAreZeroAndOne) {
  for (const int value : {0, 1}) {
    EXPECT_EQ(version1SensorValue(SENSOR_SWITCH, value), value);
    EXPECT_EQ(version2SensorValue(SENSOR_SWITCH, value), value);
    EXPECT_EQ(sensorValueFromVersion1(SENSOR_SWITCH, static_cast<short>(value)), value);
    EXPECT_EQ(sensorValueFromVersion2(SENSOR_SWITCH, value), value);
  }
}

TEST(SensorValues, AreRoundedToTheNearest) {
  EXPECT_EQ(version1SensorValue(SENSOR_DISTANCE, 234999), 23);
  EXPECT_EQ(version1SensorValue(SENSOR_DISTANCE, 235000), 24);
  EXPECT_EQ(version1SensorValue(SENSOR_ACCELERATION, -4999), 0);
  EXPECT_EQ(version1SensorValue(SENSOR_ACCELERATION, -5000), -1);
}

TEST(SensorValues, BeyondTheWireAreLimited) {
  EXPECT_EQ(version1SensorValue(SENSOR_DISTANCE, 327670000), 32767);
  EXPECT_EQ(version1SensorValue(SENSOR_DISTANCE, INT_MAX), 32767);
  EXPECT_EQ(version1SensorValue(SENSOR_ACCELERATION, INT_MIN), -32768);
  EXPECT_EQ(version1SensorValue(SENSOR_TOUCH, 100000), 32767);
  EXPECT_EQ(version2SensorValue(SENSOR_TOUCH, 2147), 2147000000);
  EXPECT_EQ(version2SensorValue(SENSOR_TOUCH, 2148), INT_MAX);
  EXPECT_EQ(version2SensorValue(SENSOR_TOUCH, INT_MIN), INT_MIN);
}

TEST(SensorValues, ReadFromTheWireAreInSiUnits) {
  EXPECT_DOUBLE_EQ(sensorValueFromVersion1(SENSOR_DISTANCE, 23), 0.23);
  EXPECT_DOUBLE_EQ(sensorValueFromVersion1(SENSOR_ACCELERATION, -981), -9.81);
  EXPECT_DOUBLE_EQ(sensorValueFromVersion1(SENSOR_CHARGE, 87), 0.87);
  EXPECT_DOUBLE_EQ(sensorValueFromVersion1(SENSOR_TOUCH, 14), 14);
  EXPECT_DOUBLE_EQ(sensorValueFromVersion2(SENSOR_DISTANCE, 234567), 0.234567);
  EXPECT_DOUBLE_EQ(sensorValueFromVersion2(SENSOR_ACCELERATION, -9806650), -9.80665);
  EXPECT_DOUBLE_EQ(sensorValueFromVersion2(SENSOR_TEMPERATURE, 38250000), 38.25);
  EXPECT_DOUBLE_EQ(sensorValueFromVersion2(SENSOR_TOUCH, 14000000), 14);
}

}  // namespace
}  // namespace protocol
