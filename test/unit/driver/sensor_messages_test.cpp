#include "node/body/sensor_messages.h"

#include <gmock/gmock.h>

#include <cmath>

namespace aibo_driver::node {
namespace {

using namespace std::chrono_literals;
using aibo_client::Telemetry;
using Readings = std::vector<std::pair<std::string, double>>;  // by the names of the robot's sensors

constexpr double kGravity = 9.81;
constexpr float kFloatInfinity = std::numeric_limits<float>::infinity();

const robot_model::RobotModel& ers7() {
  return *robot_model::findRobotModel("ERS-7");
}

const robot_model::Sensor& sensorOf(const std::string& name) {
  return ers7().sensors[robot_model::findSensorByName(ers7(), name.c_str())];
}

Telemetry telemetryWith(const Readings& readings) {
  Telemetry telemetry;
  telemetry.connection_number = 41;
  telemetry.arrival += 137ms;
  telemetry.sensors.push_back({sensorOf("range_chest").identifier, 0.33});  // before what the test is about
  for (const auto& reading : readings) {
    telemetry.sensors.push_back({sensorOf(reading.first).identifier, reading.second});
  }
  return telemetry;
}

TEST(JointStatesTest, NamesTheJointsThatWereMeasured) {
  const movement::JointTable table("ERS-7", 3.0);
  movement::MeasuredJoints measured(table);
  JointStates states(table, measured);
  constexpr int kHeadPan = 2;
  Telemetry telemetry;
  EXPECT_FALSE(states.read(telemetry)) << "no joint in it";
  telemetry.joints = {{kHeadPan, 0.5}, {255, 0.1}};
  measured.update(telemetry);
  const auto message = states.read(telemetry);
  ASSERT_TRUE(message);
  EXPECT_THAT(message->name, testing::ElementsAre("head_pan"));
  EXPECT_THAT(message->position, testing::ElementsAre(0.5));
  EXPECT_THAT(message->velocity, testing::ElementsAre(0.0));
  EXPECT_THAT(message->effort, testing::IsEmpty());
}

TEST(JointStatesTest, HaveTheDutyAsEffortIfItIsKnownOfAllJoints) {
  const movement::JointTable table("ERS-7", 3.0);
  movement::MeasuredJoints measured(table);
  JointStates states(table, measured);
  Telemetry telemetry;
  telemetry.joints = {{1, 0.5, 0.25}, {2, 0.1, -1}};
  measured.update(telemetry);
  EXPECT_THAT(states.read(telemetry)->effort, testing::ElementsAre(0.25, -1));
  telemetry.joints[0].duty.reset();
  measured.update(telemetry);
  EXPECT_THAT(states.read(telemetry)->effort, testing::IsEmpty());
}

TEST(RangeFinderTest, HoldsDistanceAndRange) {
  const std::tuple<const char*, float, float> rows[] = {
      // Model Information ERS-7
      {"range_near", 0.05F, 0.5F},
      {"range_far", 0.2F, 1.5F},
      {"range_chest", 0.1F, 0.9F},
  };
  for (const auto& [name, shortest, longest] : rows) {
    const auto message = RangeFinder(sensorOf(name)).read(telemetryWith({{name, 0.33}}));
    ASSERT_TRUE(message) << name;
    EXPECT_FLOAT_EQ(message->range, 0.33F) << name;
    EXPECT_FLOAT_EQ(message->min_range, shortest) << name;
    EXPECT_FLOAT_EQ(message->max_range, longest) << name;
    EXPECT_EQ(message->radiation_type, sensor_msgs::Range::INFRARED) << name;
    EXPECT_NEAR(message->field_of_view, 2 * M_PI / 180, 1e-3) << name;
  }
}

TEST(RangeFinderTest, IsInfiniteOutOfRange) {
  const auto rangeAt = [](double distance) {
    return RangeFinder(sensorOf("range_near")).read(telemetryWith({{"range_near", distance}}))->range;
  };
  EXPECT_FLOAT_EQ(rangeAt(0.06), 0.06F);
  EXPECT_EQ(rangeAt(0.05), -kFloatInfinity);
  EXPECT_EQ(rangeAt(0.03), -kFloatInfinity);
  EXPECT_FLOAT_EQ(rangeAt(0.49), 0.49F);
  EXPECT_EQ(rangeAt(0.5), kFloatInfinity);
  EXPECT_EQ(rangeAt(0.9), kFloatInfinity);
}

class AccelerometerTest : public ::testing::Test {
 protected:
  Accelerometer accelerometer_{ers7()};
};

// As Tekkotsu describes real robots, see sensor_messages.h: each posture makes one of Sony's values negative.
TEST_F(AccelerometerTest, PointsUpwardsInTheAxesOfTheBody) {
  const auto at = [this](double front_back, double right_left, double up_down) {
    const auto message = accelerometer_.read(telemetryWith({{"acceleration_front_back", front_back},
                                                            {"acceleration_right_left", right_left},
                                                            {"acceleration_up_down", up_down}}));
    return message ? message->linear_acceleration : geometry_msgs::Vector3();
  };
  EXPECT_EQ(at(0, 0, -kGravity).z, kGravity) << "standing: up is where its back points, +z";
  EXPECT_EQ(at(-kGravity, 0, 0).x, kGravity) << "sitting on its butt: up is where its nose points, +x";
  EXPECT_EQ(at(0, -kGravity, 0).y, -kGravity) << "lying on its left side: up is where its right side points, -y";
}

TEST_F(AccelerometerTest, WaitsForAllAxesEachTime) {
  std::vector<std::pair<const char*, double>> axes = {
      {"acceleration_front_back", 1}, {"acceleration_right_left", 2}, {"acceleration_up_down", 3}};
  for (int i = 0; i < 6; ++i) {  // each of them is twice the last one
    EXPECT_FALSE(accelerometer_.read(telemetryWith({{axes[0].first, axes[0].second}})));
    EXPECT_FALSE(accelerometer_.read(telemetryWith({{axes[1].first, axes[1].second}}))) << axes[2].first;
    EXPECT_FALSE(accelerometer_.read(telemetryWith({{"chin", 1}})));
    const auto message = accelerometer_.read(telemetryWith({{axes[2].first, axes[2].second}}));
    ASSERT_TRUE(message);
    EXPECT_EQ(message->linear_acceleration.x, -1);
    EXPECT_EQ(message->linear_acceleration.y, 2);
    EXPECT_EQ(message->linear_acceleration.z, -3);
    EXPECT_EQ(message->orientation_covariance[0], -1) << "not measured";
    EXPECT_EQ(message->angular_velocity_covariance[0], -1);
    EXPECT_EQ(message->linear_acceleration_covariance[0], 0);
    std::rotate(axes.begin(), axes.begin() + 1, axes.end());
  }
}

class TouchSensorsTest : public ::testing::Test {
 protected:
  TouchSensors touch_{ers7()};
};

TEST_F(TouchSensorsTest, HoldsEachSensorUnderItsName) {
  const std::vector<std::pair<std::string, std::uint8_t Touch::*>> fields = {
      {"paw_left_front", &Touch::paw_left_front},
      {"paw_left_hind", &Touch::paw_left_hind},
      {"paw_right_front", &Touch::paw_right_front},
      {"paw_right_hind", &Touch::paw_right_hind},
      {"chin", &Touch::chin},
      {"head_touch", &Touch::head},
      {"back_front", &Touch::back_front},
      {"back_middle", &Touch::back_middle},
      {"back_rear", &Touch::back_rear}};
  for (const auto& touched : fields) {
    Readings readings;
    for (const auto& field : fields) {
      const double value = sensorOf(field.first).kind == robot_model::SENSOR_SWITCH ? 1 : 40;
      readings.emplace_back(field.first, field.first == touched.first ? value : 0);
    }
    const auto message = touch_.read(telemetryWith(readings));
    ASSERT_TRUE(message);
    for (const auto& field : fields) {
      EXPECT_EQ((*message).*field.second != 0, field.first == touched.first) << touched.first << " " << field.first;
    }
  }
}

TEST(TouchSensors, OfAnErs210HaveOneBack) {
  TouchSensors touch(*robot_model::findRobotModel("ERS-210"));
  Telemetry telemetry;
  telemetry.sensors.push_back({node::sensorOf(*robot_model::findRobotModel("ERS-210"), "back").identifier, 1});
  const auto message = touch.read(telemetry);
  EXPECT_TRUE(message && message->back_middle);
}

// Model Information ERS-7: the rear of the back is touched from 14 on, and no longer below 10.
TEST_F(TouchSensorsTest, HoldsATouchUntilItIsClearlyOver) {
  const auto touchedAt = [this](double strength) {
    const auto message = touch_.read(telemetryWith({{"back_rear", strength}}));
    EXPECT_TRUE(message && message->back_rear_strength == static_cast<float>(strength));
    return message && message->back_rear;
  };
  EXPECT_FALSE(touchedAt(12));
  EXPECT_TRUE(touchedAt(14));
  EXPECT_TRUE(touchedAt(12));
  EXPECT_FALSE(touchedAt(9));
  EXPECT_FALSE(touchedAt(12));
}

TEST_F(TouchSensorsTest, KeepsEarlierValuesUntilTheNextConnection) {
  EXPECT_TRUE(touch_.read(telemetryWith({{"chin", 1}}))->chin);
  EXPECT_FALSE(touch_.read(telemetryWith({{"battery", 0.5}}))) << "nothing new";
  const auto second = touch_.read(telemetryWith({{"head_touch", 30}}));
  ASSERT_TRUE(second);
  EXPECT_TRUE(second->chin);
  EXPECT_TRUE(second->head);
  EXPECT_TRUE(std::isnan(second->back_front_strength)) << "not read yet";
  Telemetry telemetry = telemetryWith({{"paw_left_hind", 1}});
  ++telemetry.connection_number;
  const auto third = touch_.read(telemetry);
  ASSERT_TRUE(third);
  EXPECT_FALSE(third->chin);
  EXPECT_TRUE(std::isnan(third->head_strength));
}

TEST(BatteryTest, HoldsTheChargeAndMarksEverythingElseAsUnknown) {
  Battery battery(sensorOf("battery"), sensorOf("temperature"));
  const auto message = battery.read(telemetryWith({{"battery", 0.87}}));
  ASSERT_TRUE(message);
  EXPECT_FLOAT_EQ(message->percentage, 0.87F);
  EXPECT_TRUE(message->present);
  for (const float unknown : {message->voltage, message->temperature, message->current, message->charge,
                              message->capacity, message->design_capacity}) {
    EXPECT_TRUE(std::isnan(unknown));
  }
  EXPECT_EQ(message->power_supply_status, sensor_msgs::BatteryState::POWER_SUPPLY_STATUS_UNKNOWN);
}

TEST(BatteryTest, HoldsTheTemperatureInDegreesCelsius) {
  Battery battery(sensorOf("battery"), sensorOf("temperature"));
  EXPECT_FALSE(battery.read(telemetryWith({{"temperature", 31.5}}))) << "version 1 reports one after the other";
  EXPECT_FLOAT_EQ(battery.read(telemetryWith({{"battery", 0.87}}))->temperature, 31.5F);
}

TEST(BatteryTest, IsPublishedOnceASecond) {
  Battery battery(sensorOf("battery"), sensorOf("temperature"));
  for (const auto begin : {0s, 100s}) {  // the radio was off meanwhile
    int messages = 0;
    for (int i = 0; i < 3 * 31; ++i) {
      Telemetry telemetry = telemetryWith({{"battery", 0.5}});
      telemetry.arrival += begin + i * 32ms;
      messages += battery.read(telemetry) ? 1 : 0;
    }
    EXPECT_EQ(messages, 3);
  }
}

}  // namespace
}  // namespace aibo_driver::node
