#include "node/camera/calibration.h"

#include <camera_calibration_parsers/parse.h>
#include <gmock/gmock.h>
#include <ros/package.h>

#include <cstdint>

#include "aibo_client/exceptions.h"
#include "files/files.h"
#include "support/full_disk.h"
#include "support/good_calibration.h"
#include "support/temporary_folder.h"

namespace aibo_driver::node {
namespace {

using sensor_msgs::CameraInfo;
using test_support::goodCalibration;
using ::testing::HasSubstr;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

std::string problemWith(const std::function<void(CameraInfo&)>& change) {
  CameraInfo info = goodCalibration();
  change(info);
  return problemOf(info);
}

std::string refusalOf(const std::string& url) {
  try {
    return "accepted as " + calibrationFile(url, "left");
  } catch (const aibo_client::InvalidArgumentException& error) {
    return error.what();
  }
}

TEST(CalibrationFile, IsThatOfTheUrl) {
  EXPECT_EQ(calibrationFile("file:///tmp/eye.yaml", "left"), "/tmp/eye.yaml");
  EXPECT_EQ(calibrationFile("file:///tmp/${NAME}/${NAME}.yaml", "left"), "/tmp/left/left.yaml");
  const std::string package = ros::package::getPath("std_msgs");
  ASSERT_NE(package, "");
  EXPECT_EQ(calibrationFile("package://std_msgs/eyes/left.yaml", "left"), package + "/eyes/left.yaml");
}

TEST(CalibrationFile, IsInRosHomeByDefault) {
  const char* ros_home = std::getenv("ROS_HOME");
  const std::string before = ros_home != nullptr ? ros_home : "";
  ::setenv("ROS_HOME", "/var/ros", 1);
  EXPECT_EQ(calibrationFile("", "left"), "/var/ros/camera_info/left.yaml");
  ::unsetenv("ROS_HOME");
  EXPECT_THAT(calibrationFile("", "left"), testing::EndsWith("/.ros/camera_info/left.yaml"));
  if (ros_home != nullptr) {
    ::setenv("ROS_HOME", before.c_str(), 1);
  }
}

TEST(CalibrationFile, OfAUrlThatNamesNoneIsRefused) {
  EXPECT_THAT(refusalOf("package://no_such_package/eye.yaml"), HasSubstr("there is no package 'no_such_package'"));
  EXPECT_THAT(refusalOf("package:///eye.yaml"), HasSubstr("there is no package ''"));
  for (const char* url : {"package://std_msgs", "package://std_msgs/", "file:///", "file:///tmp/", "file:///${EYE}"}) {
    EXPECT_THAT(refusalOf(url), HasSubstr("does not name a file")) << url;
  }
}

TEST(CalibrationFile, StaysAsItWasIfTheDiskIsFull) {
  const test_support::TemporaryFolder folder;
  const std::string file = folder.path("eye.yaml").string();
  saveCalibration(goodCalibration(), "left", file);
  const auto size = std::filesystem::file_size(file);
  {
    const test_support::FullDisk full;
    EXPECT_THROW(saveCalibration(goodCalibration(), "right", file), files::FileException);
  }
  EXPECT_EQ(std::filesystem::file_size(file), size);
  const std::filesystem::directory_iterator files(folder.path());
  EXPECT_EQ(std::distance(begin(files), end(files)), 1) << "nothing else is left";
}

TEST(CalibrationFile, IsNotReadIfItWasCutOff) {
  const test_support::TemporaryFolder folder;
  const std::string file = folder.path("new/eye.yaml").string();
  saveCalibration(goodCalibration(), "left", file);
  std::string name;
  CameraInfo info;
  EXPECT_TRUE(camera_calibration_parsers::readCalibration(file, name, info));
  for (auto size = std::filesystem::file_size(file) - 2; size > 0; --size) {
    std::filesystem::resize_file(file, size);
    EXPECT_FALSE(camera_calibration_parsers::readCalibration(file, name, info)) << size;
  }
}

TEST(CalibrationFile, OfAnotherKindIsRefused) {
  EXPECT_THROW(saveCalibration(goodCalibration(), "left", "/nowhere/eye.txt"), files::FileException);
}

TEST(Calibration, OfEveryModelAndSizeIsAccepted) {
  for (const char* model : {"", "plumb_bob", "rational_polynomial", "equidistant"}) {
    EXPECT_EQ(problemWith([&](CameraInfo& info) { info.distortion_model = model; }), "") << model;
  }
  EXPECT_EQ(problemWith([](CameraInfo& info) { info.D.assign(14, 0.0); }), "");
  EXPECT_EQ(problemWith([](CameraInfo& info) { info.width = 416; }), "");
  EXPECT_EQ(problemWith([](CameraInfo& info) { info.height = 320; }), "");
}

TEST(Calibration, ThatNoCameraHasIsRefused) {
  const std::pair<std::function<void(CameraInfo&)>, const char*> rows[] = {
      {[](CameraInfo& info) { info = CameraInfo(); }, "0x0"},
      {[](CameraInfo& info) { info.height = 0; }, "208x0"},
      {[](CameraInfo& info) { info.width = 417; }, "417x160"},
      {[](CameraInfo& info) { info.height = 321; }, "208x321"},
      {[](CameraInfo& info) { info.width = std::numeric_limits<std::uint32_t>::max(); }, "4294967295x160"},
      {[](CameraInfo& info) { info.distortion_model = "plumb"; }, "distortion model"},
      {[](CameraInfo& info) { info.D.assign(15, 0.0); }, "15 coefficients"},
      {[](CameraInfo& info) { info.D[4] = kNoNumber; }, "not finite"},
      {[](CameraInfo& info) { info.K[0] = kInfinity; }, "not finite"},
      {[](CameraInfo& info) { info.R[8] = -kInfinity; }, "not finite"},
      {[](CameraInfo& info) { info.P[11] = kNoNumber; }, "not finite"},
  };
  for (const auto& [change, problem] : rows) {
    EXPECT_THAT(problemWith(change), HasSubstr(problem));
  }
}

}  // namespace
}  // namespace aibo_driver::node
