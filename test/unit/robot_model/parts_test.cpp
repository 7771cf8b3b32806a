#include <gmock/gmock.h>

#include "robot_model/robot_model.h"

namespace robot_model {
namespace {

const char* const kDesigns[] = {"ERS-7", "ERS-210"};

const RobotModel& model(const std::string& design) {
  return *findRobotModel(design.c_str());
}

struct ExpectedSensor {
  const char* name;
  int identifier;
  const char* locator;
  SensorKind kind;
  int lowest;
  int highest;
};

void expectSensors(const std::string& design, const std::vector<ExpectedSensor>& sensors) {
  ASSERT_EQ(model(design).number_of_sensors, static_cast<int>(sensors.size()));
  for (const ExpectedSensor& expected : sensors) {
    SCOPED_TRACE(design + " " + expected.name);
    const int found = findSensorByName(model(design), expected.name);
    ASSERT_NE(found, NO_SENSOR);
    const Sensor& sensor = model(design).sensors[found];
    EXPECT_EQ(sensor.identifier, expected.identifier);
    EXPECT_STREQ(sensor.locator, expected.locator);
    EXPECT_EQ(sensor.kind, expected.kind);
    EXPECT_EQ(sensor.lowest, expected.lowest);
    EXPECT_EQ(sensor.highest, expected.highest);
    EXPECT_EQ(findSensorByIdentifier(model(design), expected.identifier), found);
    if (expected.locator != nullptr) {
      EXPECT_EQ(findSensorByLocator(model(design), expected.locator), found);
    }
  }
}

TEST(Sensors, OfTheErs7) {
  expectSensors("ERS-7",
                {{"head_touch", 5, "PRM:/r1/c1/c2/c3/t1-Sensor:t1", SENSOR_TOUCH, 0, 80},
                 {"back_rear", 6, "PRM:/t2-Sensor:t2", SENSOR_TOUCH, 0, 80},
                 {"back_middle", 7, "PRM:/t3-Sensor:t3", SENSOR_TOUCH, 0, 80},
                 {"back_front", 8, "PRM:/t4-Sensor:t4", SENSOR_TOUCH, 0, 80},
                 {"chin", 9, "PRM:/r1/c1/c2/c3/c4/s5-Sensor:s5", SENSOR_SWITCH, 0, 1},
                 {"paw_left_front", 14, "PRM:/r2/c1/c2/c3/c4-Sensor:24", SENSOR_SWITCH, 0, 1},
                 {"paw_left_hind", 24, "PRM:/r3/c1/c2/c3/c4-Sensor:34", SENSOR_SWITCH, 0, 1},
                 {"paw_right_front", 34, "PRM:/r4/c1/c2/c3/c4-Sensor:44", SENSOR_SWITCH, 0, 1},
                 {"paw_right_hind", 44, "PRM:/r5/c1/c2/c3/c4-Sensor:54", SENSOR_SWITCH, 0, 1},
                 {"range_near", 53, "PRM:/r1/c1/c2/c3/p1-Sensor:p1", SENSOR_DISTANCE, 50000, 500000},
                 {"range_far", 54, "PRM:/r1/c1/c2/c3/p2-Sensor:p2", SENSOR_DISTANCE, 200000, 1500000},
                 {"range_chest", 55, "PRM:/p1-Sensor:p1", SENSOR_DISTANCE, 100000, 900000},
                 {"acceleration_front_back", 61, "PRM:/a1-Sensor:a1", SENSOR_ACCELERATION, -19613300, 19613300},
                 {"acceleration_right_left", 62, "PRM:/a2-Sensor:a2", SENSOR_ACCELERATION, -19613300, 19613300},
                 {"acceleration_up_down", 63, "PRM:/a3-Sensor:a3", SENSOR_ACCELERATION, -19613300, 19613300},
                 {"battery", 66, nullptr, SENSOR_CHARGE, 0, 1000000},
                 {"temperature", 67, nullptr, SENSOR_TEMPERATURE, 0, 0},
                 {"wlan_switch", 94, "PRM:/b1-Sensor:b1", SENSOR_SWITCH, 0, 1}});
}

TEST(Sensors, OfTheErs210) {
  expectSensors("ERS-210",
                {{"head_rear", 5, "PRM:/r1/c1/c2/c3/f1-Sensor:f1", SENSOR_FORCE, 0, 980665},
                 {"head_front", 6, "PRM:/r1/c1/c2/c3/f2-Sensor:f2", SENSOR_FORCE, 0, 980665},
                 {"chin", 7, "PRM:/r1/c1/c2/c3/c4/s5-Sensor:s5", SENSOR_SWITCH, 0, 1},
                 {"range_head", 8, "PRM:/r1/c1/c2/c3/p1-Sensor:p1", SENSOR_DISTANCE, 100000, 900000},
                 {"paw_left_front", 14, "PRM:/r2/c1/c2/c3/c4-Sensor:s4", SENSOR_SWITCH, 0, 1},
                 {"paw_left_hind", 24, "PRM:/r3/c1/c2/c3/c4-Sensor:s4", SENSOR_SWITCH, 0, 1},
                 {"paw_right_front", 34, "PRM:/r4/c1/c2/c3/c4-Sensor:s4", SENSOR_SWITCH, 0, 1},
                 {"paw_right_hind", 44, "PRM:/r5/c1/c2/c3/c4-Sensor:s4", SENSOR_SWITCH, 0, 1},
                 {"temperature", 53, "PRM:/r6/t1-Sensor:t1", SENSOR_TEMPERATURE, 0, 0},
                 {"back", 54, "PRM:/r6/s1-Sensor:s1", SENSOR_SWITCH, 0, 1},
                 {"acceleration_front_back", 61, "PRM:/a1-Sensor:a1", SENSOR_ACCELERATION, -19613300, 19613300},
                 {"acceleration_right_left", 62, "PRM:/a2-Sensor:a2", SENSOR_ACCELERATION, -19613300, 19613300},
                 {"acceleration_up_down", 63, "PRM:/a3-Sensor:a3", SENSOR_ACCELERATION, -19613300, 19613300}});
}

// Touch sensors have Sony's levels; a switch is only on or off.
TEST(Sensors, ArePressedWithHysteresis) {
  struct Levels {
    const char* name;
    double on;
    double off;
  };
  for (const Levels& levels : std::vector<Levels>{{"head_touch", 9, 9},
                                                  {"back_rear", 14, 10},
                                                  {"back_middle", 14, 10},
                                                  {"back_front", 12, 12},
                                                  {"chin", 1, 1}}) {
    SCOPED_TRACE(levels.name);
    const Sensor& sensor = model("ERS-7").sensors[findSensorByName(model("ERS-7"), levels.name)];
    EXPECT_FALSE(isPressed(sensor, 0, false));
    EXPECT_FALSE(isPressed(sensor, levels.on - 0.5, false));
    EXPECT_TRUE(isPressed(sensor, levels.on, false));
    EXPECT_TRUE(isPressed(sensor, levels.off, true));
    EXPECT_FALSE(isPressed(sensor, levels.off - 0.5, true));
  }
}

struct ExpectedLed {
  const char* name;
  int identifier;
  const char* locator;
  LedKind kind;
  LedPlace place;
};

void expectLeds(const std::string& design, const std::vector<ExpectedLed>& leds) {
  for (const ExpectedLed& expected : leds) {
    SCOPED_TRACE(design + " " + expected.name);
    const int found = findLedByIdentifier(model(design), expected.identifier);
    ASSERT_NE(found, NO_LED);
    const Led& led = model(design).leds[found];
    EXPECT_STREQ(led.name, expected.name);
    EXPECT_STREQ(led.locator, expected.locator);
    EXPECT_EQ(led.kind, expected.kind);
    EXPECT_EQ(led.place, expected.place);
    EXPECT_EQ(findLedByName(model(design), expected.name), found);
    EXPECT_EQ(findLedByLocator(model(design), expected.locator), found);
  }
}

TEST(Leds, OfTheErs7) {
  ASSERT_EQ(model("ERS-7").number_of_leds, 26);
  expectLeds("ERS-7", {{"head_color", 1, "PRM:/r1/c1/c2/c3/l1-LED2:l1", LED2, LED_ON_HEAD},
                       {"head_white", 2, "PRM:/r1/c1/c2/c3/l2-LED2:l2", LED2, LED_ON_HEAD},
                       {"mode_red", 3, "PRM:/r1/c1/c2/c3/l3-LED2:l3", LED2, LED_ON_HEAD},
                       {"mode_green", 4, "PRM:/r1/c1/c2/c3/l4-LED2:l4", LED2, LED_ON_HEAD},
                       {"mode_blue", 5, "PRM:/r1/c1/c2/c3/l5-LED2:l5", LED2, LED_ON_HEAD},
                       {"wireless", 6, "PRM:/r1/c1/c2/c3/l6-LED2:l6", LED2, LED_ON_HEAD},
                       {"back_front_color", 21, "PRM:/lu-LED3:lu", LED3, LED_ON_BACK},
                       {"back_front_white", 22, "PRM:/lv-LED3:lv", LED3, LED_ON_BACK},
                       {"back_middle_color", 23, "PRM:/lw-LED3:lw", LED3, LED_ON_BACK},
                       {"back_middle_white", 24, "PRM:/lx-LED3:lx", LED3, LED_ON_BACK},
                       {"back_rear_color", 25, "PRM:/ly-LED3:ly", LED3, LED_ON_BACK},
                       {"back_rear_white", 26, "PRM:/lz-LED3:lz", LED3, LED_ON_BACK}});
  for (int i = 0; i < 14; ++i) {
    const std::string name = "face_" + std::to_string(i + 1);
    const std::string letters = std::string("l") + static_cast<char>('a' + i);
    const std::string locator = "PRM:/r1/c1/c2/c3/" + letters + "-LED3:" + letters;
    expectLeds("ERS-7", {{name.c_str(), 7 + i, locator.c_str(), LED3, LED_ON_FACE}});
  }
}

TEST(Leds, OfTheErs210) {
  ASSERT_EQ(model("ERS-210").number_of_leds, 9);
  expectLeds("ERS-210", {{"eye_left_bottom", 1, "PRM:/r1/c1/c2/c3/l1-LED2:l1", LED2, LED_ON_FACE},
                         {"eye_left_middle", 2, "PRM:/r1/c1/c2/c3/l2-LED2:l2", LED2, LED_ON_FACE},
                         {"eye_left_top", 3, "PRM:/r1/c1/c2/c3/l3-LED2:l3", LED2, LED_ON_FACE},
                         {"eye_right_bottom", 4, "PRM:/r1/c1/c2/c3/l4-LED2:l4", LED2, LED_ON_FACE},
                         {"eye_right_middle", 5, "PRM:/r1/c1/c2/c3/l5-LED2:l5", LED2, LED_ON_FACE},
                         {"eye_right_top", 6, "PRM:/r1/c1/c2/c3/l6-LED2:l6", LED2, LED_ON_FACE},
                         {"mode", 7, "PRM:/r1/c1/c2/c3/l7-LED2:l7", LED2, LED_ON_HEAD},
                         {"tail_blue", 8, "PRM:/r6/l1-LED2:l1", LED2, LED_ON_TAIL},
                         {"tail_orange", 9, "PRM:/r6/l2-LED2:l2", LED2, LED_ON_TAIL}});
}

void expectEar(const std::string& design, int identifier, const char* name, const char* locator, EarKind kind) {
  const int found = findEarByIdentifier(model(design), identifier);
  ASSERT_NE(found, NO_EAR);
  EXPECT_STREQ(model(design).ears[found].name, name);
  EXPECT_STREQ(model(design).ears[found].locator, locator);
  EXPECT_EQ(model(design).ears[found].kind, kind);
  EXPECT_EQ(findEarByName(model(design), name), found);
  EXPECT_EQ(findEarByLocator(model(design), locator), found);
}

TEST(Ears, AreTwo) {
  expectEar("ERS-7", 1, "left_ear", "PRM:/r1/c1/c2/c3/e5-Joint4:15", EAR_JOINT4);
  expectEar("ERS-7", 2, "right_ear", "PRM:/r1/c1/c2/c3/e6-Joint4:16", EAR_JOINT4);
  expectEar("ERS-210", 1, "left_ear", "PRM:/r1/c1/c2/c3/e1-Joint3:j5", EAR_JOINT3);
  expectEar("ERS-210", 2, "right_ear", "PRM:/r1/c1/c2/c3/e2-Joint3:j6", EAR_JOINT3);
  for (const char* design : kDesigns) {
    EXPECT_EQ(model(design).number_of_ears, 2);
  }
  EXPECT_EQ(findEarByIdentifier(model("ERS-7"), 3), NO_EAR);
  EXPECT_EQ(findEarByName(model("ERS-7"), "ear"), NO_EAR);
  EXPECT_EQ(findEarByLocator(model("ERS-7"), "PRM:/r1/c1/c2/c3/e1-Joint3:j5"), NO_EAR);
}

}  // namespace
}  // namespace robot_model
