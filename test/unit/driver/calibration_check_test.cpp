// What can be a calibration: docs/calibration.md, "What is refused".
#include "node/camera/calibration_check.h"

#include <camera_calibration_parsers/parse.h>
#include <gmock/gmock.h>

#include "node/camera/calibration.h"
#include "node/camera/nominal_calibration.h"
#include "support/good_calibration.h"
#include "support/temporary_folder.h"

namespace aibo_driver::node {
namespace {

using sensor_msgs::CameraInfo;
using ::testing::HasSubstr;

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();

/// A calibration of pictures of 208x160.
struct Lens {
  const char* model;
  std::vector<double> coefficients;
  double fx;
  double fy;
  double cx;
  double cy;
};

CameraInfo calibrationOf(const Lens& lens) {
  CameraInfo info = test_support::goodCalibration();
  info.distortion_model = lens.model;
  info.D = lens.coefficients;
  info.K = {lens.fx, 0, lens.cx, 0, lens.fy, lens.cy, 0, 0, 1};
  info.P = {lens.fx, 0, lens.cx, 0, 0, lens.fy, lens.cy, 0, 0, 0, 1, 0};
  return info;
}

const std::vector<Lens> kGood = {
    {"plumb_bob", {0.5, -30, 0.01, 0.002, 400}, 601, 598, 99, 83},
    {"plumb_bob", {3.9, 0, 0, 0, 0}, 190, 190, 104, 80},  // the corners are 2.9 times as far from the middle
    {"rational_polynomial", {-0.4, 0.1, 0, 0, 0.02, -0.3, 0.05, 0.01}, 189, 190, 104, 80},
    {"rational_polynomial", {-4, 2, 0, 0, 0.1, -4.1, 2.2, 0, 0, 0, 0, 0, 0, 0}, 300, 301, 104, 80},
    {"equidistant", {0, 0, 0, 0}, 120, 120, 103.5, 79.5},
    {"equidistant", {0.1, -0.05, 0.02, -0.004}, 60, 61, 104, 80},
    {"plumb_bob", {}, 190, 190, 104, 80},
    {"", {}, 190, 190, 104, 80},
};

const std::vector<Lens> kBad = {
    {"plumb_bob", {-0.147, 0.385, 0, 0}, 190, 190, 104, 80},
    {"plumb_bob", {-0.147, 0.385, 0, 0, -25}, 190, 190, 104, 80},
    {"plumb_bob", {4.7, 0, 0, 0, 0}, 190, 190, 104, 80},  // 3.2 times
    {"rational_polynomial", {12.1, -5, 0, 0, 1.3, -2.2, 0, 0}, 190, 190, 104, 80},
    {"rational_polynomial", std::vector<double>(15), 190, 190, 104, 80},
    {"equidistant", {0, 0, 0, 0, 0}, 190, 190, 104, 80},
    {"equidistant", {-0.9, -3, 0, 0}, 120, 120, 104, 80},
    {"", {-0.147, 0.385, 0, 0, 0}, 190, 190, 104, 80},
    {"plumb", {}, 190, 190, 104, 80},
};

TEST(CalibrationCheck, ALensOfEveryModelIsAccepted) {
  for (const Lens& lens : kGood) {
    EXPECT_EQ(problemOf(calibrationOf(lens)), "") << lens.model << " " << testing::PrintToString(lens.coefficients);
  }
}

TEST(CalibrationCheck, TheCalibrationInConfigIsAccepted) {
  std::string name;
  CameraInfo info;
  ASSERT_TRUE(camera_calibration_parsers::readCalibration(CONFIG "/ers7_camera.yaml", name, info));
  EXPECT_EQ(problemOf(info), "");
}

TEST(CalibrationCheck, ALensThatCannotBeIsRefused) {
  for (const Lens& lens : kBad) {
    EXPECT_THAT(problemOf(calibrationOf(lens)),
                testing::AnyOf(HasSubstr("coefficients"), HasSubstr("as no lens does"), HasSubstr("model is not")))
        << lens.model << " " << testing::PrintToString(lens.coefficients);
  }
}

using Change = std::function<void(CameraInfo&)>;

std::string problemWith(const Change& change) {
  CameraInfo info = test_support::goodCalibration();
  change(info);
  return problemOf(info);
}

TEST(CalibrationCheck, WhatRosProgramsWriteIsAccepted) {
  const Change rows[] = {
      [](CameraInfo&) {},
      [](CameraInfo& info) { info = nominalCalibration("ERS-7", 416, 320); },
      [](CameraInfo& info) { info = nominalCalibration("ERS-210", 44, 36); },
      [](CameraInfo& info) { info.R = {0.9998, 0.0175, 0, -0.0175, 0.9998, 0, 0, 0, 1}; },  // one of two cameras
      [](CameraInfo& info) { info.P[3] = -11.4; },
      [](CameraInfo& info) { info.binning_x = info.binning_y = 1; },
      [](CameraInfo& info) { info.roi.width = 208, info.roi.height = 160; },
  };
  for (const Change& change : rows) {
    EXPECT_EQ(problemWith(change), "") << &change - rows;
  }
}

TEST(CalibrationCheck, NumbersThatMakeNoSenseAreRefused) {
  const std::pair<Change, const char*> rows[] = {
      {[](CameraInfo& info) { info = CameraInfo(); }, "0x0"},
      {[](CameraInfo& info) { info.width = 417; }, "417x160"},
      {[](CameraInfo& info) { info.height = 321; }, "208x321"},
      {[](CameraInfo& info) { info.D[4] = kNoNumber; }, "not finite"},
      {[](CameraInfo& info) { info.K[0] = kInfinity; }, "not finite"},
      {[](CameraInfo& info) { info.R[8] = -kInfinity; }, "not finite"},
      {[](CameraInfo& info) { info.P[11] = kNoNumber; }, "not finite"},
      {[](CameraInfo& info) { info.K[0] = 0; }, "fx of K is 0, with which the camera would see 180 degrees"},
      {[](CameraInfo& info) { info.K[4] = 0; }, "fy of K is 0"},
      {[](CameraInfo& info) { info.K[4] = 3.2; }, "fy of K is 3.2"},
      {[](CameraInfo& info) { info.K[0] = 36.8; }, "fx of K is 36.8, with which the camera would see 141"},
      {[](CameraInfo& info) { info.K[0] = 1210; }, "fx of K is 1210, with which the camera would see 9.8"},
      {[](CameraInfo& info) { info.K[0] = 1900; }, "fx of K is 1900, with which the camera would see 6.2"},
      {[](CameraInfo& info) { info.K[2] = -1; }, "the middle cx, cy of K is -1, 80"},
      {[](CameraInfo& info) { info.K[5] = 805; }, "the middle cx, cy of K is 104, 805"},
      {[](CameraInfo& info) { info.K[3] = 5; }, "K does not have the form"},
      {[](CameraInfo& info) { info.K[8] = 0; }, "K does not have the form"},
      {[](CameraInfo& info) { info.K = {190, 5, 0, 104, 0, 0, 190, 80, 5}; }, "with decimal points?"},
      {[](CameraInfo& info) { info.R[8] = -1; }, "R is not a rotation"},
      {[](CameraInfo& info) { info.R[4] = 2; }, "R is not a rotation"},
      {[](CameraInfo& info) { info.P[0] = 0; }, "fx of P is 0"},
      {[](CameraInfo& info) { info.P[5] = -190; }, "fy of P is -190"},
      {[](CameraInfo& info) { info.P[10] = 0; }, "P does not have the form"},
      {[](CameraInfo& info) { info.binning_x = 2; }, "the robot sends whole pictures"},
      {[](CameraInfo& info) { info.roi.width = 104, info.roi.height = 80; }, "the robot sends whole pictures"},
  };
  for (const auto& [change, problem] : rows) {
    EXPECT_THAT(problemWith(change), HasSubstr(problem));
  }
}

class CalibrationFileCheckTest : public ::testing::Test {
 protected:
  std::string problemOfText(const std::string& text) {
    folder_.write("eye.yaml", text);
    return problemOfFile(folder_.path("eye.yaml").string());
  }

  test_support::TemporaryFolder folder_;
};

TEST_F(CalibrationFileCheckTest, WhatIsStoredIsReadAsItWas) {
  for (const Lens& lens : kGood) {
    const std::string file = folder_.path("eye.yaml").string();
    saveCalibration(calibrationOf(lens), "left", file);
    EXPECT_EQ(problemOfFile(file), "") << lens.model;
    CameraInfo read;
    std::string name;
    ASSERT_TRUE(camera_calibration_parsers::readCalibration(file, name, read)) << lens.model;
    EXPECT_EQ(read, calibrationOf(lens)) << lens.model;
  }
}

// As cameracalibrator.py writes it.
constexpr char kWritten[] =
    "image_width: 208\n"
    "image_height: 160\n"
    "camera_name: aibo\n"
    "camera_matrix:\n"
    "  rows: 3\n"
    "  cols: 3\n"
    "  data: [190.12345,   0.     , 104.5    ,\n"
    "           0.     , 191.5    ,  80.25   ,\n"
    "           0.     ,   0.     ,   1.     ]\n"
    "distortion_model: plumb_bob\n"
    "distortion_coefficients:\n"
    "  rows: 1\n"
    "  cols: 5\n"
    "  data: [-0.147000, 0.385000, 0.000100, -0.000200, 0.000000]\n"
    "rectification_matrix:\n"
    "  rows: 3\n"
    "  cols: 3\n"
    "  data: [1., 0., 0., 0., 1., 0., 0., 0., 1.]\n"
    "projection_matrix:\n"
    "  rows: 3\n"
    "  cols: 4\n"
    "  data: [188.0, 0., 105., 0., 0., 190., 80., 0., 0., 0., 1., 0.]\n";

TEST_F(CalibrationFileCheckTest, MatricesHaveAllTheirNumbers) {
  EXPECT_EQ(problemOfText(kWritten), "");
  const std::tuple<const char*, const char*, const char*> rows[] = {
      // in the file, what is replaced by what, and the problem
      {"190.12345", "190,12345", "camera_matrix in line 5 has rows: 3, cols: 3 and 10 numbers"},
      {"188.0", "188,0", "are they all there, with decimal points instead of commas?"},
      {"cols: 4", "cols: 3", "has rows: 3, cols: 3 and 12 numbers, but is a matrix of 3x4"},
      {"rows: 1", "rows: -1", "rows: -1, cols: 5"},
      {"camera_matrix", "matrix", "camera_matrix is missing"},
      {"data: [1.", "numbers: [1.", "rectification_matrix is missing, or has no data"},
      {"image_width: 208", "secret: {", "not the YAML of a calibration: see its line "},
  };
  for (const auto& [good, wrong, problem] : rows) {
    std::string text = kWritten;
    text.replace(text.find(good), std::string(good).size(), wrong);
    EXPECT_THAT(problemOfText(text), HasSubstr(problem)) << wrong;
  }
}

}  // namespace
}  // namespace aibo_driver::node
