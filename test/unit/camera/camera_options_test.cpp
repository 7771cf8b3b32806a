#include "camera/camera_options.h"

#include <gtest/gtest.h>

namespace aibo_driver::camera {
namespace {

using aibo_client::Resolution;

TEST(CameraOptions, AResolutionIsOneOfTheCamerasLayersOrDouble) {
  EXPECT_EQ(resolutionOf("52x40"), Resolution::kLow);
  EXPECT_EQ(resolutionOf("104x80"), Resolution::kMiddle);
  EXPECT_EQ(resolutionOf("208x160"), Resolution::kHigh);
  EXPECT_EQ(resolutionOf("416x320"), Resolution::kDouble);
  EXPECT_FALSE(resolutionOf(""));
  EXPECT_FALSE(resolutionOf("208X160"));
}

TEST(CameraOptions, ARateIsThatOfEveryNthImage) {
  EXPECT_EQ(everyNthImageOf(30), 1);
  EXPECT_EQ(everyNthImageOf(16), 2);
  EXPECT_EQ(everyNthImageOf(2), 15);
  EXPECT_EQ(everyNthImageOf(0), 15);
  EXPECT_EQ(everyNthImageOf(100), 1);
  EXPECT_DOUBLE_EQ(frameRateOf(4), 7.5);
}

TEST(Transport, ItsReasonIsTold) {
  using aibo_client::PictureTransport;
  aibo_client::ConnectionStatus status;
  status.transport_problem = "a firewall";
  EXPECT_EQ(transportReason(status), "") << "it was that of the connection before";
  status.transport_problem.clear();
  status.state = aibo_client::ConnectionState::kConnected;
  EXPECT_EQ(transportReason(status), "~transport is tcp");
  status.wanted_transport = PictureTransport::kAuto;
  EXPECT_EQ(transportReason(status), "UDP has not been tried yet");
  status.transport_problem = "a firewall";
  EXPECT_EQ(transportReason(status), "a firewall");
  status.transport_problem.clear();
  status.transport = PictureTransport::kUdp;
  EXPECT_EQ(transportReason(status), "datagrams from the robot get through");
}

}  // namespace
}  // namespace aibo_driver::camera
