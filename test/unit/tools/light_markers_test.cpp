#include "tools/light_markers.h"

#include <gmock/gmock.h>

#include <cmath>

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
  EXPECT_TRUE(lights.setLeds(states("face_1", 1.0F, LedStates::MODE_B)));
  EXPECT_NE(shining(lights).at(0).color.g, bright.color.g);
}

TEST(LightMarkers, AreOffWhileItIsUnknownWhetherTheyShine) {
  LightMarkers lights("");
  lights.setLeds(states("face_1", 1.0F));
  EXPECT_TRUE(lights.setLeds(states("face_1", std::nanf(""))));
  EXPECT_TRUE(shining(lights).empty());
}

TEST(LightMarkers, SayWhenNothingHasChanged) {
  LightMarkers lights("");
  EXPECT_FALSE(lights.setLeds(states("face_1", 0)));
  EXPECT_FALSE(lights.setLeds(states("tail_blue", 1))) << "an ERS-210's";
  LedStates torn = states("face_1", 1.0F);
  torn.intensities.clear();
  EXPECT_FALSE(lights.setLeds(torn));
  Touch touch;
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
  EXPECT_TRUE(lights.setTouch(Touch()));
  EXPECT_TRUE(shining(lights).empty());
}

}  // namespace
}  // namespace lights
