#include "tools/lights/light_markers.h"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <set>
#include <tuple>

#include "robot_model/robot_model.h"

namespace lights {
namespace {

using aibo_driver::LedStates;
using aibo_driver::Touch;
using visualization_msgs::Marker;

// Between two LEDs that this robot does not have.
LedStates states(const std::string& name, float intensity, int mode = LedStates::MODE_A) {
  const int other = mode == LedStates::MODE_A ? LedStates::MODE_B : LedStates::MODE_A;
  LedStates leds;
  leds.names = {"tail_blue", name, "tail_orange"};
  leds.intensities = {0.77F, intensity, 0.66F};
  leds.modes = {static_cast<std::uint8_t>(other), static_cast<std::uint8_t>(mode), static_cast<std::uint8_t>(other)};
  return leds;
}

std::vector<Marker> shining(const LightMarkers& lights) {
  std::vector<Marker> found;
  for (const Marker& marker : lights.markers().markers) {
    if (marker.action == Marker::ADD) {
      found.push_back(marker);
    }
  }
  return found;
}

TEST(LightMarkers, HaveAPlaceForEachLedAndNoneShinesAtFirst) {
  LightMarkers lights("");
  EXPECT_TRUE(shining(lights).empty());
  const robot_model::RobotModel& model = *robot_model::findRobotModel("ERS-7");
  std::set<int> ids;
  for (int i = 0; i < model.number_of_leds; ++i) {
    const std::string name = model.leds[i].name;
    EXPECT_TRUE(lights.setLeds(states(name, 1.0F))) << name;
    ASSERT_EQ(shining(lights).size(), 1u) << name;
    const Marker marker = shining(lights).front();
    EXPECT_TRUE(ids.insert(marker.id).second) << name;
    const bool is_on_back = model.leds[i].place == robot_model::LED_ON_BACK;
    EXPECT_EQ(marker.header.frame_id, is_on_back ? "base_link" : "head_tilt_link") << name;
    EXPECT_TRUE(marker.frame_locked);
    EXPECT_EQ(marker.ns, "lights") << "as rviz calls them";
    EXPECT_EQ(marker.pose.orientation.w, 1);
    EXPECT_GT(std::min({marker.scale.x, marker.scale.y, marker.scale.z}), 0) << name;
    EXPECT_TRUE(lights.setLeds(states(name, 0)));
  }
}

TEST(LightMarkers, AreBrighterWithMoreIntensityAndDifferentInModeB) {
  LightMarkers lights("");
  lights.setLeds(states("face_1", 0.1F));
  const Marker faint = shining(lights).at(0);
  lights.setLeds(states("face_1", 1.0F));
  const Marker bright = shining(lights).at(0);
  EXPECT_GT(faint.color.a, 0.25);
  EXPECT_GT(bright.color.a, faint.color.a + 0.5);
  EXPECT_EQ(bright.color.a, 1);
  lights.setLeds(states("face_1", 5.0F));
  EXPECT_EQ(shining(lights).at(0).color.a, 1) << "rviz takes no more";
  EXPECT_TRUE(lights.setLeds(states("face_1", 1.0F, LedStates::MODE_B)));
  EXPECT_NE(shining(lights).at(0).color.g, bright.color.g);
  EXPECT_TRUE(lights.setLeds(states("face_1", 1.0F)));
  EXPECT_EQ(shining(lights).at(0).color.g, bright.color.g) << "it is in mode A again";
}

TEST(LightMarkers, HaveTheirColors) {
  const std::tuple<const char*, int, std::array<float, 3>> colors[] = {
      {"mode_red", LedStates::MODE_A, {1.0F, 0.1F, 0.1F}},
      {"mode_green", LedStates::MODE_A, {0.2F, 1.0F, 0.3F}},
      {"mode_blue", LedStates::MODE_A, {0.2F, 0.5F, 1.0F}},
      {"head_color", LedStates::MODE_B, {1.0F, 0.6F, 0.1F}},
      {"face_1", LedStates::MODE_A, {1.0F, 1.0F, 0.95F}},
      {"face_1", LedStates::MODE_B, {1.0F, 0.35F, 0.75F}},
      {"back_front_color", LedStates::MODE_A, {0.2F, 0.5F, 1.0F}},
      {"back_middle_color", LedStates::MODE_A, {1.0F, 0.6F, 0.1F}},
      {"back_rear_color", LedStates::MODE_A, {1.0F, 0.1F, 0.1F}}};
  for (const auto& [name, mode, color] : colors) {
    LightMarkers lights("");
    lights.setLeds(states(name, 0.5F, mode));
    const auto shown = shining(lights).at(0).color;
    EXPECT_EQ((std::array<float, 3>{shown.r, shown.g, shown.b}), color) << name << ", mode " << mode;
  }
}

TEST(LightMarkers, AreOffWhileItIsUnknownWhetherTheyShine) {
  LightMarkers lights("");
  lights.setLeds(states("face_1", 1.0F));
  EXPECT_TRUE(lights.setLeds(states("face_1", std::nanf(""))));
  EXPECT_TRUE(shining(lights).empty());
  LedStates two = states("face_1", 1.0F);
  two.names.push_back("face_2");
  two.intensities.push_back(1.0F);
  two.modes.push_back(LedStates::MODE_A);
  EXPECT_TRUE(lights.setLeds(two));
  EXPECT_EQ(shining(lights).size(), 2u);
}

TEST(LightMarkers, AreWhereTheModelHasThemAndTheFaceIsSymmetric) {
  LightMarkers lights("");
  Touch touch;
  touch.back_front = 1;
  lights.setTouch(touch);
  const Marker pad = shining(lights).at(0);
  EXPECT_EQ(pad.type, Marker::CUBE);
  EXPECT_EQ(pad.pose.position.x, 0.030);
  EXPECT_EQ(pad.pose.position.y, 0);
  EXPECT_EQ(pad.pose.position.z, 0.0450);
  EXPECT_EQ(pad.scale.x, 0.032);
  EXPECT_EQ(pad.scale.y, 0.028);
  EXPECT_EQ(pad.scale.z, 0.006);
  EXPECT_FLOAT_EQ(pad.color.a, 0.7F) << "the model shines through";
  lights.setTouch(Touch());
  for (const auto& [strip, x] : {std::pair("back_front_", 0.030), {"back_middle_", -0.004}, {"back_rear_", -0.038}}) {
    for (const char* color : {"color", "white"}) {
      lights.setLeds(states(std::string(strip) + color, 1));
      const Marker led = shining(lights).at(0);
      EXPECT_LT(std::abs(led.pose.position.x - x), pad.scale.x / 2) << strip << color << " is on its pad";
      EXPECT_GT(led.pose.position.z + led.scale.z / 2, pad.pose.position.z + pad.scale.z / 2) << strip << color;
      lights.setLeds(states(std::string(strip) + color, 0));
    }
  }
  touch = Touch();
  touch.paw_left_front = touch.paw_left_hind = touch.paw_right_front = touch.paw_right_hind = 1;
  lights.setTouch(touch);
  EXPECT_EQ(shining(lights).size(), 4u);
  for (const Marker& paw : shining(lights)) {
    EXPECT_EQ(std::vector({paw.scale.x, paw.scale.y, paw.scale.z}), std::vector(3, 0.032)) << paw.header.frame_id;
  }
  lights.setTouch(Touch());
  const auto place = [&lights](int number) {
    const std::string name = "face_" + std::to_string(number);
    lights.setLeds(states(name, 1));
    const auto position = shining(lights).at(0).pose.position;
    lights.setLeds(states(name, 0));
    return position;
  };
  for (int number = 1; number < 15; number += number == 9 ? 4 : 2) {  // all but the two in the middle are in pairs
    const double from_middle = std::hypot(place(number).x - 0.031, place(number).y - 0.005, place(number).z - 0.009);
    EXPECT_NEAR(from_middle, 0.0355, 1e-9) << number << " is on one of two balls, one at each side";
    EXPECT_DOUBLE_EQ(place(number).y, -place(number + 1).y);
    EXPECT_DOUBLE_EQ(place(number).x, place(number + 1).x);
    EXPECT_DOUBLE_EQ(place(number).z, place(number + 1).z);
  }
  EXPECT_DOUBLE_EQ(place(12).y, 0);
  EXPECT_GT(place(11).z, place(12).z);
  EXPECT_GT(place(12).x, place(11).x) << "it is the front of a ball";
}

TEST(LightMarkers, SayWhenNothingHasChanged) {
  LightMarkers lights("");
  EXPECT_FALSE(lights.setLeds(states("face_1", 0)));
  EXPECT_FALSE(lights.setLeds(states("tail_blue", 1))) << "an ERS-210's";
  LedStates torn = states("face_1", 1.0F);
  torn.intensities.clear();
  EXPECT_FALSE(lights.setLeds(torn));
  EXPECT_FALSE(lights.setTouch(Touch()));
  Touch touch;
  touch.chin = 1;
  EXPECT_TRUE(lights.setTouch(touch));
  touch.header.stamp = ros::Time(5);
  EXPECT_FALSE(lights.setTouch(touch));
}

TEST(LightMarkers, ShowEachSensorThatIsTouchedOnItsLink) {
  LightMarkers lights("left");
  const std::tuple<std::uint8_t Touch::*, const char*, double> places[] = {
      {&Touch::back_front, "base_link", 0.030},
      {&Touch::back_middle, "base_link", -0.004},
      {&Touch::back_rear, "base_link", -0.038},
      {&Touch::head, "head_tilt_link", -0.002},
      {&Touch::chin, "mouth_link", 0.020},
      {&Touch::paw_left_front, "left_front_foot_link", 0},
      {&Touch::paw_left_hind, "left_hind_foot_link", 0},
      {&Touch::paw_right_front, "right_front_foot_link", 0},
      {&Touch::paw_right_hind, "right_hind_foot_link", 0}};
  for (const auto& [place, link, x] : places) {
    Touch one;
    one.*place = 1;
    EXPECT_TRUE(lights.setTouch(one));
    ASSERT_EQ(shining(lights).size(), 1u) << link;
    EXPECT_EQ(shining(lights)[0].header.frame_id, std::string("left/") + link);
    EXPECT_EQ(shining(lights)[0].pose.position.x, x) << link;
  }
  lights.setTouch(Touch());
  Touch touch;
  touch.paw_right_hind = 1;
  lights.setTouch(touch);
  ASSERT_EQ(shining(lights).size(), 1u);
  EXPECT_EQ(shining(lights)[0].header.frame_id, "left/right_hind_foot_link");
  touch.paw_left_front = touch.paw_left_hind = touch.paw_right_front = touch.chin = touch.head = 1;
  touch.back_front = touch.back_middle = touch.back_rear = 1;
  lights.setTouch(touch);
  EXPECT_EQ(shining(lights).size(), 9u);
  EXPECT_TRUE(lights.setTouch(Touch()));
  EXPECT_TRUE(shining(lights).empty());
}

}  // namespace
}  // namespace lights
