#include "node/camera/nominal_calibration.h"

#include <gmock/gmock.h>

#include "simulator/ers7/camera/ycrcb_image.h"

namespace aibo_driver::node {
namespace {

using sensor_msgs::CameraInfo;

TEST(NominalCalibration, OfTheErs7IsThatOfItsFieldOfView) {
  const CameraInfo info = nominalCalibration("ERS-7", 208, 160);
  EXPECT_EQ(info.width, 208u);
  EXPECT_EQ(info.height, 160u);
  EXPECT_NEAR(info.K[0], 191.9, 0.05);
  EXPECT_NEAR(info.K[4], 192.2, 0.05);
  EXPECT_DOUBLE_EQ(info.K[2], 103.5);
  EXPECT_DOUBLE_EQ(info.K[5], 79.5);
  EXPECT_EQ(info.distortion_model, "plumb_bob");
  EXPECT_THAT(info.D, testing::ElementsAre(0, 0, 0, 0, 0));
  EXPECT_THAT(info.R, testing::ElementsAre(1, 0, 0, 0, 1, 0, 0, 0, 1));
  EXPECT_THAT(info.P, testing::ElementsAre(info.K[0], 0, info.K[2], 0, 0, info.K[4], info.K[5], 0, 0, 0, 1, 0));
}

// Which counts from the corner of the first pixel, ROS from its centre.
TEST(NominalCalibration, IsThatOfTheSimulatedCamera) {
  const CameraInfo info = nominalCalibration("ERS-7", simulated_ers7::kPictureWidth, simulated_ers7::kPictureHeight);
  EXPECT_NEAR(info.P[0], simulated_ers7::kFocalLengthX, 1e-9);
  EXPECT_NEAR(info.P[5], simulated_ers7::kFocalLengthY, 1e-9);
  EXPECT_NEAR(info.P[2], simulated_ers7::kPictureWidth / 2.0 - 0.5, 1e-9);
  EXPECT_NEAR(info.P[6], simulated_ers7::kPictureHeight / 2.0 - 0.5, 1e-9);
}

TEST(NominalCalibration, OfTheErs210HasItsOwnFieldOfView) {
  const CameraInfo info = nominalCalibration("ERS-210", 176, 144);
  EXPECT_NEAR(info.K[0], 160.1, 0.05);  // 88 / tan(28.8 degrees)
  EXPECT_NEAR(info.K[4], 162.5, 0.05);  // 72 / tan(23.9 degrees)
}

TEST(ScaleCalibration, FitsPicturesOfAMultipleOrAFractionOfTheSize) {
  const CameraInfo info = nominalCalibration("ERS-7", 208, 160);
  for (const auto& [width, height] : {std::pair{416u, 320u}, {208u, 160u}, {104u, 80u}, {52u, 40u}}) {
    const auto scaled = scaleCalibration(info, width, height);
    ASSERT_TRUE(scaled) << width;
    const CameraInfo wanted = nominalCalibration("ERS-7", width, height);
    EXPECT_EQ(scaled->width, width);
    EXPECT_EQ(scaled->height, height);
    EXPECT_THAT(scaled->K, testing::Pointwise(testing::DoubleNear(1e-9), wanted.K));
    EXPECT_THAT(scaled->P, testing::Pointwise(testing::DoubleNear(1e-9), wanted.P));
    EXPECT_EQ(scaled->D, info.D) << "the coefficients do not depend on the size";
  }
}

TEST(ScaleCalibration, DoesNotFitPicturesOfAnotherShapeOrNoWholeFactor) {
  const CameraInfo info = nominalCalibration("ERS-7", 208, 160);
  EXPECT_FALSE(scaleCalibration(info, 176, 144));
  EXPECT_FALSE(scaleCalibration(info, 416, 160));
  EXPECT_FALSE(scaleCalibration(info, 208, 80));
  EXPECT_FALSE(scaleCalibration(info, 156, 120)) << "three quarters";
  EXPECT_FALSE(scaleCalibration(CameraInfo(), 208, 160));
}

}  // namespace
}  // namespace aibo_driver::node
