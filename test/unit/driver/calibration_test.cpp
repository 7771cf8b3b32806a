#include "node/camera/calibration.h"

#include <camera_calibration_parsers/parse.h>
#include <gmock/gmock.h>
#include <ros/package.h>

#include "aibo_client/exceptions.h"
#include "files/files.h"
#include "node/camera/calibration_check.h"
#include "support/good_calibration.h"
#include "support/refusal.h"
#include "support/temporary_folder.h"

namespace aibo_driver::node {
namespace {

using test_support::goodCalibration;
using ::testing::HasSubstr;

std::string refusalOf(const std::string& url) {
  return test_support::refusalOf<aibo_client::InvalidArgumentException>([&] { calibrationFile(url, "left"); });
}

TEST(CalibrationFile, IsThatOfTheUrl) {
  EXPECT_EQ(calibrationFile("file:///tmp/eye.yaml", "left"), "/tmp/eye.yaml");
  EXPECT_EQ(calibrationFile("file:///tmp/${NAME}/${NAME}.yaml", "left"), "/tmp/left/left.yaml");
  const std::string package = ros::package::getPath("std_msgs");
  ASSERT_NE(package, "");
  EXPECT_EQ(calibrationFile("package://std_msgs/eyes/left.yaml", "left"), package + "/eyes/left.yaml");
}

TEST(CalibrationFile, IsInRosHomeByDefault) {
  EXPECT_EQ(calibrationFile("", "left"), files::rosHome() + "/camera_info/left.yaml");
}

TEST(CalibrationFile, OfAUrlThatNamesNoneIsRefused) {
  EXPECT_THAT(refusalOf("package://no_such_package/eye.yaml"), HasSubstr("there is no package 'no_such_package'"));
  EXPECT_THAT(refusalOf("package:///eye.yaml"), HasSubstr("there is no package ''"));
  for (const char* url : {"package://std_msgs", "package://std_msgs/", "file:///", "file:///tmp/",
                          "file:///${EYE}.yaml", "file:///eye", "file:///eye.txt"}) {
    EXPECT_THAT(refusalOf(url), HasSubstr("does not name a YAML or INI file")) << url;
  }
}

TEST(CalibrationFile, MayBeIniAsForCameraInfoManager) {
  const test_support::TemporaryFolder folder;
  const std::string file = calibrationFile("file://" + folder.path("eye.ini").string(), "left");
  saveCalibration(goodCalibration(), "left", file);
  std::string name;
  sensor_msgs::CameraInfo info;
  EXPECT_TRUE(camera_calibration_parsers::readCalibration(file, name, info));
  EXPECT_EQ(problemOf(info), "");
  EXPECT_NEAR(info.P[5], goodCalibration().P[5], 1e-5);
  info.distortion_model = "equidistant";
  EXPECT_THROW(saveCalibration(info, "left", file), files::FileException);
}

TEST(CalibrationFile, IsNotReadIfItWasCutOff) {
  const test_support::TemporaryFolder folder;
  const std::string file = folder.path("new/eye.yaml").string();
  saveCalibration(goodCalibration(), "left", file);
  std::string name;
  sensor_msgs::CameraInfo info;
  EXPECT_TRUE(camera_calibration_parsers::readCalibration(file, name, info));
  for (auto size = std::filesystem::file_size(file) - 2; size > 0; --size) {
    std::filesystem::resize_file(file, size);
    EXPECT_FALSE(camera_calibration_parsers::readCalibration(file, name, info)) << size;
  }
}

}  // namespace
}  // namespace aibo_driver::node
