#include "camera/camera_options.h"

#include <gtest/gtest.h>

#include "node/camera/camera_state_publisher.h"

namespace aibo_driver::node {
namespace {

using aibo_client::Resolution;

TEST(CameraOptions, AResolutionIsOneOfTheCamerasLayersOrDouble) {
  EXPECT_EQ(camera::resolutionOf("52x40"), Resolution::kLow);
  EXPECT_EQ(camera::resolutionOf("104x80"), Resolution::kMiddle);
  EXPECT_EQ(camera::resolutionOf("208x160"), Resolution::kHigh);
  EXPECT_EQ(camera::resolutionOf("416x320"), Resolution::kDouble);
  EXPECT_FALSE(camera::resolutionOf(""));
  EXPECT_FALSE(camera::resolutionOf("208X160"));
}

TEST(CameraOptions, ARateIsThatOfEveryNthImage) {
  EXPECT_EQ(camera::everyNthImageOf(30), 1);
  EXPECT_EQ(camera::everyNthImageOf(16), 2);
  EXPECT_EQ(camera::everyNthImageOf(2), 15);
  EXPECT_EQ(camera::everyNthImageOf(0), 15);
  EXPECT_EQ(camera::everyNthImageOf(100), 1);
  EXPECT_DOUBLE_EQ(camera::frameRateOf(4), 7.5);
}

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

TEST(Transport, ItsReasonIsTold) {
  using aibo_client::PictureTransport;
  aibo_client::ConnectionStatus status;
  status.transport_problem = "a firewall";
  EXPECT_EQ(camera::transportReason(status), "") << "it was that of the connection before";
  status.transport_problem.clear();
  status.state = aibo_client::ConnectionState::kConnected;
  EXPECT_EQ(camera::transportReason(status), "~transport is tcp");
  status.wanted_transport = PictureTransport::kAuto;
  EXPECT_EQ(camera::transportReason(status), "UDP has not been tried yet");
  status.transport_problem = "a firewall";
  EXPECT_EQ(camera::transportReason(status), "a firewall");
  status.transport_problem.clear();
  status.transport = PictureTransport::kUdp;
  EXPECT_EQ(camera::transportReason(status), "datagrams from the robot get through");
}

TEST(CameraState, IsTheSameForALaterPictureWithTheSameSettings) {
  aibo_client::Picture picture;
  picture.settings = aibo_client::CameraSettings();
  const CameraState first = cameraStateOf(picture, std_msgs::Header());
  picture.frame_number = 2;
  picture.image_count = 3;
  EXPECT_TRUE(isSameState(first, cameraStateOf(picture, std_msgs::Header())));
}

TEST(CameraState, IsAnotherOneIfAnyOfItsValuesDiffers) {
  aibo_client::Picture picture;
  picture.settings = aibo_client::CameraSettings();
  const CameraState first = cameraStateOf(picture, std_msgs::Header());
  const auto expect_another = [&](const char* name, auto& value) {
    const auto before = std::exchange(value, static_cast<std::decay_t<decltype(value)>>(value == 0 ? 1 : 0));
    EXPECT_FALSE(isSameState(first, cameraStateOf(picture, std_msgs::Header()))) << name;
    value = before;
  };
  expect_another("width", picture.width);
  expect_another("height", picture.height);
  expect_another("white_balance", picture.settings->white_balance);
  expect_another("gain", picture.settings->gain);
  expect_another("shutter_speed", picture.settings->shutter_speed);
  expect_another("auto_exposure", picture.settings->auto_exposure);
  expect_another("auto_white_balance", picture.settings->auto_white_balance);
}

}  // namespace
}  // namespace aibo_driver::node
