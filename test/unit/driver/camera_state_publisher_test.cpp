#include "node/camera/camera_state_publisher.h"

#include <gtest/gtest.h>

namespace aibo_driver::node {
namespace {

TEST(CameraState, IsThatOfThePicture) {
  aibo_client::Picture picture;
  picture.width = 416;
  picture.height = 320;
  std_msgs::Header header;
  header.frame_id = "eye";
  CameraState state = cameraStateOf(picture, header);
  EXPECT_EQ(state.header.frame_id, "eye");
  EXPECT_EQ(state.width, 416);
  EXPECT_EQ(state.frame_number, 0U);
  EXPECT_EQ(state.gain, CameraState::UNKNOWN);
  picture.frame_number = 4711;
  picture.image_count = 12;
  picture.settings = aibo_client::CameraSettings();
  picture.settings->gain = 3;
  picture.settings->auto_exposure = true;
  state = cameraStateOf(picture, header);
  EXPECT_EQ(state.frame_number, 4711U);
  EXPECT_EQ(state.image_count, 12U);
  EXPECT_EQ(state.white_balance, CameraState::WB_FL_MODE);
  EXPECT_EQ(state.gain, CameraState::GAIN_HIGH);
  EXPECT_EQ(state.shutter_speed, CameraState::SHUTTER_MID);
  EXPECT_TRUE(state.auto_exposure);
  EXPECT_FALSE(state.auto_white_balance);
}

TEST(CameraState, IsAnotherOneIfAnyOfItsValuesDiffersAndNotForALaterPicture) {
  aibo_client::Picture picture;
  picture.settings = aibo_client::CameraSettings();
  const CameraState first = cameraStateOf(picture, std_msgs::Header());
  picture.frame_number = 2;
  picture.image_count = 3;
  EXPECT_TRUE(isSameState(first, cameraStateOf(picture, std_msgs::Header())));
  const auto expect_another = [&](const char* name, auto& value) {
    const auto before = std::exchange(value, static_cast<std::decay_t<decltype(value)>>(value == 0 ? 1 : 0));
    EXPECT_FALSE(isSameState(first, cameraStateOf(picture, std_msgs::Header()))) << name;
    value = before;
  };
  expect_another("width", picture.width);
  expect_another("white_balance", picture.settings->white_balance);
  expect_another("gain", picture.settings->gain);
  expect_another("shutter_speed", picture.settings->shutter_speed);
  expect_another("auto_exposure", picture.settings->auto_exposure);
  expect_another("auto_white_balance", picture.settings->auto_white_balance);
}

}  // namespace
}  // namespace aibo_driver::node
