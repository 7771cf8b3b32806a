#include "node/camera/calibration_check.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <sstream>
#include <tuple>

#include "aibo_client/jpeg_inspector.h"

namespace aibo_driver::node {
namespace {

using sensor_msgs::CameraInfo;

// The limits are our choice: Sony's cameras see 45 to 58 degrees, and a lens in front of one may change that. Focal
// lengths in millimetres, or with a lost decimal point, are far beyond these limits.
constexpr double kNarrowestView = 10;  // degrees
constexpr double kWidestView = 140;    // degrees

// How far a corner of the picture may be moved, as a multiple of its distance from the middle. No real lens moves it so
// far, but calibrations from too few pictures do. The value is our choice.
constexpr double kMostDistortion = 3;

constexpr double kRoundingOfRotations = 0.01;  // of products; files have a few digits

// The models and numbers of CameraInfo.msg and OpenCV. Older releases of cameracalibrator.py wrote all 14 numbers of
// OpenCV for a rational_polynomial.
const std::map<std::string, std::set<std::size_t>> kCoefficients = {
    {"", {}}, {"plumb_bob", {5}}, {"rational_polynomial", {8, 12, 14}}, {"equidistant", {4}}};

template <typename Numbers>
bool allFinite(const Numbers& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double number) { return std::isfinite(number); });
}

template <typename... Parts>
std::string join(const Parts&... parts) {
  std::ostringstream text;
  (text << ... << parts);
  return text.str();
}

std::string problemOfSize(const CameraInfo& info) {
  if (info.width == 0 || info.height == 0 || info.width > aibo_client::kLargestPictureWidth ||
      info.height > aibo_client::kLargestPictureHeight) {
    return join("the camera has no pictures of ", info.width, "x", info.height, "; image_width and image_height are ",
                "those of the pictures that were used, such as 208x160");
  }
  const bool is_whole = info.roi.width == 0 || (info.roi.width == info.width && info.roi.height == info.height);
  if (info.binning_x > 1 || info.binning_y > 1 || !is_whole) {
    return "it has binning or a part of the picture (roi), but the robot sends whole pictures; set all of these to 0";
  }
  return {};
}

/// How far a lens moves a corner of the picture, as a multiple of the corner's distance from the middle.
double distortionOf(const CameraInfo& info) {
  const auto d = [&info](std::size_t i) { return i < info.D.size() ? info.D[i] : 0; };
  const double x = info.width / 2.0 / info.K[0];
  const double y = info.height / 2.0 / info.K[4];
  const double r2 = x * x + y * y;
  if (info.distortion_model == "equidistant") {
    const double angle = std::atan(std::sqrt(r2));
    const double a2 = angle * angle;
    return angle / std::sqrt(r2) * (1 + a2 * (d(0) + a2 * (d(1) + a2 * (d(2) + a2 * d(3)))));
  }
  const double radial = (1 + r2 * (d(0) + r2 * (d(1) + r2 * d(4)))) / (1 + r2 * (d(5) + r2 * (d(6) + r2 * d(7))));
  const double moved_x = x * radial + 2 * d(2) * x * y + d(3) * (r2 + 2 * x * x);
  const double moved_y = y * radial + d(2) * (r2 + 2 * y * y) + 2 * d(3) * x * y;
  return radial > 0 ? std::hypot(moved_x, moved_y) / std::sqrt(r2) : radial;
}

std::string problemOfDistortion(const CameraInfo& info) {
  const auto model = kCoefficients.find(info.distortion_model);
  if (model == kCoefficients.end()) {
    return "the distortion model is not plumb_bob, rational_polynomial or equidistant";
  }
  if (!info.D.empty() && model->second.count(info.D.size()) == 0) {
    return join(
        "D has ", info.D.size(), " coefficients, which ",
        model->first.empty() ? "no distortion model" : "the distortion model " + model->first,
        " does not have; plumb_bob has 5, rational_polynomial 8, equidistant 4; none at all means no distortion");
  }
  const double distortion = distortionOf(info);
  if (!(distortion >= 1 / kMostDistortion && distortion <= kMostDistortion)) {
    return join("D moves a corner of the picture to ", distortion,
                " times its distance from the middle, as no lens does; calibrate again, with the board in all corners");
  }
  return {};
}

/// @param focal_length the focal length in pixels
std::string problemOfView(const std::string& name, double focal_length, std::uint32_t pixels) {
  const double view = 2 * std::atan2(pixels / 2.0, focal_length) * 180 / std::acos(-1.0);
  if (view >= kNarrowestView && view <= kWidestView) {
    return {};
  }
  return join(name, " is ", focal_length, ", with which the camera would see ", view, " degrees, and not ",
              kNarrowestView, "..", kWidestView, "; a focal length is a number of pixels, here about ", pixels);
}

/// @param matrix K, or P, which has a fourth column
std::string problemOfMatrix(const std::string& name, const double* matrix, std::size_t columns,
                            const CameraInfo& info) {
  const double* const row0 = matrix;
  const double* const row1 = matrix + columns;
  const double* const row2 = matrix + 2 * columns;
  if (row0[1] != 0 || row1[0] != 0 || row2[0] != 0 || row2[1] != 0 || row2[2] != 1) {
    return name + " does not have the form fx 0 cx, 0 fy cy, 0 0 1" + (columns == 4 ? " and a fourth column" : "") +
           "; are its numbers in order, with decimal points?";
  }
  const std::string of_width = problemOfView("fx of " + name, row0[0], info.width);
  const std::string of_height = problemOfView("fy of " + name, row1[1], info.height);
  if (!of_width.empty() || !of_height.empty()) {
    return of_width.empty() ? of_height : of_width;
  }
  const bool is_within = row0[2] >= 0 && row0[2] <= info.width && row1[2] >= 0 && row1[2] <= info.height;
  return is_within ? ""
                   : join("the middle cx, cy of ", name, " is ", row0[2], ", ", row1[2],
                          ", which is not in the picture of ", info.width, "x", info.height);
}

std::string problemOfRotation(const CameraInfo& info) {
  const auto& r = info.R;
  bool is_rotation =
      r[0] * (r[4] * r[8] - r[5] * r[7]) - r[1] * (r[3] * r[8] - r[5] * r[6]) + r[2] * (r[3] * r[7] - r[4] * r[6]) >
      0;  // not a mirror
  for (std::size_t i = 0; i < 9; ++i) {
    const double* const a = &r[i / 3 * 3];
    const double* const b = &r[i % 3 * 3];
    const double product = a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    is_rotation = is_rotation && std::abs(product - (i / 3 == i % 3 ? 1 : 0)) <= kRoundingOfRotations;
  }
  return is_rotation ? "" : "R is not a rotation; for a single camera it is 1 0 0, 0 1 0, 0 0 1";
}

/// @param rows 0 means any number of rows and columns
std::string problemOfNumbers(const YAML::Node& file, const std::string& name, int rows, int columns) {
  const YAML::Node node = file[name];
  const YAML::Node numbers = node ? node["data"] : node;
  if (!numbers || !numbers.IsSequence()) {
    return name + " is missing, or has no data: [...]";
  }
  const auto given_rows = node["rows"].as<int>();
  const auto given_columns = node["cols"].as<int>();
  const bool fits = rows == 0 || (given_rows == rows && given_columns == columns);
  // Few enough that the product does not overflow. A wrong number of coefficients is reported later.
  const bool is_full = given_rows >= 0 && given_rows <= 99 && given_columns >= 0 && given_columns <= 99 &&
                       numbers.size() == static_cast<std::size_t>(given_rows * given_columns);
  if (fits && is_full) {
    return {};
  }
  return join(name, " in line ", node.Mark().line + 1, " has rows: ", given_rows, ", cols: ", given_columns, " and ",
              numbers.size(), " numbers", rows == 0 ? "" : join(", but is a matrix of ", rows, "x", columns),
              "; are they all there, with decimal points instead of commas?");
}

}  // namespace

bool isEmpty(const CameraInfo& info) {
  return std::all_of(info.K.begin(), info.K.end(), [](double number) { return number == 0; });
}

std::string problemOf(const CameraInfo& info) {
  if (!allFinite(info.D) || !allFinite(info.K) || !allFinite(info.R) || !allFinite(info.P)) {
    return "a number in it is not finite; calibrate again";
  }
  std::string problem = problemOfSize(info);
  problem = problem.empty() ? problemOfMatrix("K", &info.K[0], 3, info) : problem;
  problem = problem.empty() ? problemOfDistortion(info) : problem;
  problem = problem.empty() ? problemOfRotation(info) : problem;
  return problem.empty() ? problemOfMatrix("P", &info.P[0], 4, info) : problem;
}

std::string problemOfFile(const std::string& file) {
  try {
    const YAML::Node content = YAML::LoadFile(file);
    for (const auto& [name, rows, columns] : {std::tuple("camera_matrix", 3, 3),
                                              {"distortion_coefficients", 0, 0},
                                              {"rectification_matrix", 3, 3},
                                              {"projection_matrix", 3, 4}}) {
      if (const std::string problem = problemOfNumbers(content, name, rows, columns); !problem.empty()) {
        return problem;
      }
    }
    return {};
  } catch (const YAML::Exception& error) {  // the text of the exception may quote the file, which may be any file
    return "it is not the YAML of a calibration" +
           (error.mark.is_null() ? "" : join(": see its line ", error.mark.line + 1));
  }
}

}  // namespace aibo_driver::node
