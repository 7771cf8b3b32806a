// The identifiers of docs/protocol.md, "Joints", "Sensors" and "LEDs and ears".
#include <gmock/gmock.h>

#include "robot_model/robot_model.h"

namespace robot_model {
namespace {

struct Find {
  int (*by_identifier)(const RobotModel& model, int identifier);
  int (*by_name)(const RobotModel& model, const char* name);
  int (*by_locator)(const RobotModel& model, const char* locator);
};

/// All parts in the order of the table, such as "1 left_ear, 2 right_ear". Each is found by everything that it has.
template <typename Part>
std::string partsOf(const RobotModel& model, const Part* parts, int count, const Find& find) {
  std::string all;
  for (int i = 0; i < count; ++i) {
    const Part& part = parts[i];
    EXPECT_EQ(find.by_identifier(model, part.identifier), i) << part.name;
    EXPECT_EQ(find.by_name(model, part.name), i) << part.name;
    EXPECT_TRUE(part.locator == nullptr || find.by_locator(model, part.locator) == i) << part.name;
    all += (i == 0 ? "" : ", ") + std::to_string(part.identifier) + " " + part.name;
  }
  EXPECT_EQ(find.by_identifier(model, 99), -1);
  EXPECT_EQ(find.by_name(model, "wing"), -1);
  EXPECT_EQ(find.by_locator(model, "PRM:/r9"), -1);
  return all;
}

const std::string kLegParts =
    "11 left_front_rotator, 12 left_front_elevator, 13 left_front_knee, "
    "21 left_hind_rotator, 22 left_hind_elevator, 23 left_hind_knee, "
    "31 right_front_rotator, 32 right_front_elevator, 33 right_front_knee, "
    "41 right_hind_rotator, 42 right_hind_elevator, 43 right_hind_knee, ";
const std::string kTailParts = "51 tail_pan, 52 tail_tilt";
const std::string kPawParts = "14 paw_left_front, 24 paw_left_hind, 34 paw_right_front, 44 paw_right_hind, ";
const std::string kAccelerations = "61 acceleration_front_back, 62 acceleration_right_left, 63 acceleration_up_down";

TEST(Parts, HaveTheirIdentifiers) {
  const struct {
    const char* design;
    std::string joints;
    std::string sensors;
    std::string leds;
  } rows[] = {
      {"ERS-7", "1 neck_tilt, 2 head_pan, 3 head_tilt, 4 mouth, " + kLegParts + kTailParts,
       "5 head_touch, 6 back_rear, 7 back_middle, 8 back_front, 9 chin, " + kPawParts +
           "53 range_near, 54 range_far, 55 range_chest, " + kAccelerations +
           ", 66 battery, 67 temperature, 94 wlan_switch",
       "1 head_color, 2 head_white, 3 mode_red, 4 mode_green, 5 mode_blue, 6 wireless, "
       "7 face_1, 8 face_2, 9 face_3, 10 face_4, 11 face_5, 12 face_6, 13 face_7, "
       "14 face_8, 15 face_9, 16 face_10, 17 face_11, 18 face_12, 19 face_13, 20 face_14, "
       "21 back_front_color, 22 back_front_white, 23 back_middle_color, 24 back_middle_white, "
       "25 back_rear_color, 26 back_rear_white"},
      {"ERS-210", "1 head_tilt, 2 head_pan, 3 head_roll, 4 mouth, " + kLegParts + kTailParts,
       "5 head_rear, 6 head_front, 7 chin, 8 range_head, " + kPawParts + "53 temperature, 54 back, " + kAccelerations,
       "1 eye_left_bottom, 2 eye_left_middle, 3 eye_left_top, "
       "4 eye_right_bottom, 5 eye_right_middle, 6 eye_right_top, 7 mode, 8 tail_blue, 9 tail_orange"},
  };
  for (const auto& row : rows) {
    const RobotModel& model = *findRobotModel(row.design);
    EXPECT_STREQ(model.design, row.design);
    EXPECT_EQ(partsOf(model, model.joints, model.number_of_joints,
                      {findJointByIdentifier, findJointByName, findJointByLocator}),
              row.joints);
    EXPECT_EQ(partsOf(model, model.sensors, model.number_of_sensors,
                      {findSensorByIdentifier, findSensorByName, findSensorByLocator}),
              row.sensors);
    EXPECT_EQ(partsOf(model, model.leds, model.number_of_leds, {findLedByIdentifier, findLedByName, findLedByLocator}),
              row.leds);
    EXPECT_EQ(partsOf(model, model.ears, model.number_of_ears, {findEarByIdentifier, findEarByName, findEarByLocator}),
              "1 left_ear, 2 right_ear");
  }
  EXPECT_EQ(findRobotModel("ERS-220"), nullptr);
}

TEST(Leds, OfAnErs7HaveSonysNamesAndSomeAnIntensity) {
  const RobotModel& model = *findRobotModel("ERS-7");
  std::string all;
  for (int i = 0; i < model.number_of_leds; ++i) {
    const std::string locator = model.leds[i].locator;
    all += locator.substr(locator.rfind(':') + 1) + (model.leds[i].kind == LED2 ? " " : "+ ");
  }
  EXPECT_EQ(all, "l1 l2 l3 l4 l5 l6 la+ lb+ lc+ ld+ le+ lf+ lg+ lh+ li+ lj+ lk+ ll+ lm+ ln+ lu+ lv+ lw+ lx+ ly+ lz+ ");
}

TEST(Sensors, HaveTheirRanges) {
  const RobotModel& model = *findRobotModel("ERS-7");
  const std::tuple<const char*, int, int> rows[] = {{"range_near", 50000, 500000},
                                                    {"range_far", 200000, 1500000},
                                                    {"range_chest", 100000, 900000},
                                                    {"acceleration_front_back", -19613300, 19613300},
                                                    {"acceleration_right_left", -19613300, 19613300},
                                                    {"acceleration_up_down", -19613300, 19613300}};
  for (const auto& [name, lowest, highest] : rows) {
    const Sensor& sensor = model.sensors[findSensorByName(model, name)];
    EXPECT_EQ(sensor.lowest, lowest) << name;
    EXPECT_EQ(sensor.highest, highest) << name;
  }
}

// Touch sensors have Sony's levels; a switch is only on or off.
TEST(Sensors, ArePressedWithHysteresis) {
  const struct {
    const char* name;
    double on;
    double off;
  } rows[] = {
      {"head_touch", 9, 9}, {"back_rear", 14, 10}, {"back_middle", 14, 10}, {"back_front", 12, 12}, {"chin", 1, 1}};
  const RobotModel& model = *findRobotModel("ERS-7");
  for (const auto& row : rows) {
    SCOPED_TRACE(row.name);
    const Sensor& sensor = model.sensors[findSensorByName(model, row.name)];
    EXPECT_FALSE(isPressed(sensor, 0, false));
    EXPECT_FALSE(isPressed(sensor, row.on - 0.5, false));
    EXPECT_TRUE(isPressed(sensor, row.on, false));
    EXPECT_TRUE(isPressed(sensor, row.off, true));
    EXPECT_FALSE(isPressed(sensor, row.off - 0.5, true));
  }
}

}  // namespace
}  // namespace robot_model
