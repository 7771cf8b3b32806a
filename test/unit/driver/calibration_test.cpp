#include "ros/camera/calibration.h"

#include <gmock/gmock.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <string>

#include "support/good_calibration.h"

namespace aibo_driver::node {
namespace {

using sensor_msgs::CameraInfo;
using test_support::goodCalibration;
using ::testing::HasSubstr;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

std::string problemWith(const std::function<void(CameraInfo*)>& change) {
  CameraInfo info = goodCalibration();
  change(&info);
  return problemOf(info);
}

TEST(Calibration, OfTheCameraIsAccepted) {
  EXPECT_EQ(problemOf(goodCalibration()), "");
}

TEST(Calibration, OfEveryModelAndSizeIsAccepted) {
  for (const char* model : {"", "plumb_bob", "rational_polynomial", "equidistant"}) {
    EXPECT_EQ(problemWith([&](CameraInfo* info) { info->distortion_model = model; }), "") << model;
  }
  EXPECT_EQ(problemWith([](CameraInfo* info) { info->D.assign(14, 0.0); }), "");
  EXPECT_EQ(problemWith([](CameraInfo* info) { info->width = 416; }), "");
  EXPECT_EQ(problemWith([](CameraInfo* info) { info->height = 320; }), "");
}

TEST(Calibration, OfASizeThatNoPictureHasIsRefused) {
  EXPECT_THAT(problemOf(CameraInfo()), HasSubstr("0x0"));
  EXPECT_THAT(problemWith([](CameraInfo* info) { info->height = 0; }), HasSubstr("208x0"));
  EXPECT_THAT(problemWith([](CameraInfo* info) { info->width = 417; }), HasSubstr("417x160"));
  EXPECT_THAT(problemWith([](CameraInfo* info) { info->height = 321; }), HasSubstr("208x321"));
  EXPECT_THAT(problemWith([](CameraInfo* info) { info->width = std::numeric_limits<std::uint32_t>::max(); }),
              HasSubstr("4294967295x160"));
}

TEST(Calibration, OfAnUnknownModelIsRefused) {
  EXPECT_THAT(problemWith([](CameraInfo* info) { info->distortion_model = "plumb"; }), HasSubstr("distortion model"));
  EXPECT_THAT(problemWith([](CameraInfo* info) { info->D.assign(15, 0.0); }), HasSubstr("15 coefficients"));
}

TEST(Calibration, WithANumberThatIsNotFiniteIsRefused) {
  EXPECT_THAT(problemWith([](CameraInfo* info) { info->D[4] = kNoNumber; }), HasSubstr("not finite"));
  EXPECT_THAT(problemWith([](CameraInfo* info) { info->K[0] = kInfinity; }), HasSubstr("not finite"));
  EXPECT_THAT(problemWith([](CameraInfo* info) { info->R[8] = -kInfinity; }), HasSubstr("not finite"));
  EXPECT_THAT(problemWith([](CameraInfo* info) { info->P[11] = kNoNumber; }), HasSubstr("not finite"));
}

}  // namespace
}  // namespace aibo_driver::node
