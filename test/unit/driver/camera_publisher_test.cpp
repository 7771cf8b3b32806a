#include "node/camera/camera_publisher.h"

#include <gtest/gtest.h>

namespace aibo_driver::node {
namespace {

TEST(CameraState, IsThatOfThePicture) {
  aibo_client::Picture picture;
  picture.width = 416;
  picture.height = 320;
  CameraState state = cameraStateOf(picture);
  EXPECT_EQ(state.width, 416);
  EXPECT_EQ(state.frame_number, 0U);
  EXPECT_EQ(state.gain, CameraState::UNKNOWN);
  picture.frame_number = 4711;
  picture.image_count = 12;
  picture.settings = aibo_client::CameraSettings();
  picture.settings->gain = 3;
  picture.settings->auto_exposure = true;
  state = cameraStateOf(picture);
  EXPECT_EQ(state.frame_number, 4711U);
  EXPECT_EQ(state.image_count, 12U);
  EXPECT_EQ(state.white_balance, CameraState::WB_FL_MODE);
  EXPECT_EQ(state.gain, CameraState::GAIN_HIGH);
  EXPECT_EQ(state.shutter_speed, CameraState::SHUTTER_MID);
  EXPECT_TRUE(state.auto_exposure);
  EXPECT_FALSE(state.auto_white_balance);
}

}  // namespace
}  // namespace aibo_driver::node
