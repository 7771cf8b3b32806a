#include "node/camera/calibration.h"

#include <camera_calibration_parsers/parse.h>
#include <camera_calibration_parsers/parse_ini.h>
#include <camera_calibration_parsers/parse_yml.h>
#include <ros/console.h>
#include <ros/package.h>

#include <cstddef>
#include <exception>
#include <filesystem>
#include <optional>
#include <sstream>
#include <string_view>
#include <system_error>

#include "aibo_client/exceptions.h"
#include "files/files.h"
#include "node/camera/calibration_check.h"
#include "node/camera/nominal_calibration.h"
#include "text/sentence.h"

namespace aibo_driver::node {
namespace {

using sensor_msgs::CameraInfo;

// The same default as in camera_info_manager.
constexpr const char* kDefaultUrl = "file://${ROS_HOME}/camera_info/${NAME}.yaml";
constexpr std::string_view kFileScheme = "file://";
constexpr std::string_view kPackageScheme = "package://";

std::string sizeOf(std::uint32_t width, std::uint32_t height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

std::string sizeOf(const CameraInfo& info) {
  return sizeOf(info.width, info.height);
}

void replaceAll(const std::string& what, const std::string& with, std::string* text) {
  for (std::size_t at = text->find(what); at != std::string::npos; at = text->find(what, at + with.size())) {
    text->replace(at, what.size(), with);
  }
}

bool isIni(const std::string& file) {
  return std::filesystem::path(file).extension() == ".ini";  // the parser goes by the extension
}

CameraInfo load(const std::string& file) {
  CameraInfo info;
  std::string name;
  std::error_code error;
  if (!std::filesystem::exists(file, error)) {
    return {};
  }
  std::string problem = isIni(file) ? "" : problemOfFile(file);
  if (problem.empty() && !camera_calibration_parsers::readCalibration(file, name, info)) {
    problem = "it cannot be read; calibrate again";
  }
  if (problem.empty() && !isEmpty(info)) {
    problem = problemOf(info);
  }
  if (!problem.empty()) {
    ROS_WARN_STREAM_NAMED("camera", "The calibration in " << file << " is left out: " << text::sentence(problem));
    return {};
  }
  return info;
}

/// @param is_wanted true: the user has named the file
void logCalibration(const CameraInfo& info, const std::string& file, bool is_wanted) {
  std::error_code error;
  if (is_wanted && !std::filesystem::exists(file, error)) {
    ROS_WARN_STREAM_NAMED("camera", "Parameter camera_info_url names "
                                        << file
                                        << ", but there is no such file on this computer: camera_info holds the "
                                           "nominal calibration. Is the name right? Calibrating the camera makes the "
                                           "file.");
  } else if (!isEmpty(info)) {
    ROS_INFO_STREAM_NAMED(
        "camera", "The camera's calibration is that in " << file << ", for pictures of " << sizeOf(info) << ".");
  } else {
    ROS_INFO_STREAM_NAMED("camera", "There is no calibration in "
                                        << file
                                        << ": camera_info holds the nominal one, computed from the field of view that "
                                           "Sony gives. docs/calibration.md shows how to calibrate the camera.");
  }
}

}  // namespace

std::string calibrationFile(const std::string& url, const std::string& camera_name) {
  const std::string parameter = "Parameter camera_info_url is '" + url + "', ";
  std::string resolved = url.empty() ? kDefaultUrl : url;
  if (resolved.find("${ROS_HOME}") != std::string::npos) {
    replaceAll("${ROS_HOME}", files::rosHome(), &resolved);
  }
  replaceAll("${NAME}", camera_name, &resolved);
  const bool in_package = resolved.rfind(kPackageScheme, 0) == 0;
  const std::size_t begin = in_package ? kPackageScheme.size() : kFileScheme.size();
  const std::size_t slash = resolved.find('/', begin);
  const std::string ending = std::filesystem::path(resolved).extension();  // the parser goes by the extension
  const bool is_file = slash != std::string::npos && (ending == ".yaml" || ending == ".yml" || isIni(resolved));
  if (!is_file || resolved.find("${") != std::string::npos) {
    throw aibo_client::InvalidArgumentException(
        parameter +
        "which does not name a YAML or INI file; it must be file:///FILE.yaml or "
        "package://PACKAGE/FILE.yaml, which may contain ${ROS_HOME} and ${NAME}, or empty.");
  }
  if (!in_package) {
    return resolved.substr(begin);
  }
  const std::string package = resolved.substr(begin, slash - begin);
  const std::string folder = package.empty() ? "" : ros::package::getPath(package);
  if (folder.empty()) {
    throw aibo_client::InvalidArgumentException(parameter + "but there is no package '" + package +
                                                "' here: is its workspace sourced? Or give file:///FILE.yaml.");
  }
  return folder + resolved.substr(slash);
}

void saveCalibration(const CameraInfo& info, const std::string& camera_name, const std::string& file) {
  std::ostringstream text;
  if (!isIni(file)) {
    camera_calibration_parsers::writeCalibrationYml(text, camera_name, info);
  } else if (!camera_calibration_parsers::writeCalibrationIni(text, camera_name, info)) {
    throw files::FileException(
        "an INI file holds only the distortion model plumb_bob; let camera_info_url name a YAML file");
  }
  std::filesystem::create_directories(std::filesystem::path(file).parent_path());
  files::replaceFile(file, text.str());
}

Calibration::Calibration(const ros::NodeHandle& camera_handle, const std::string& camera_name, const std::string& url,
                         const std::string& design)
    : camera_name_(camera_name), design_(design), file_(calibrationFile(url, camera_name)), stored_(load(file_)) {
  logCalibration(stored_, file_, !url.empty());
  service_ = ros::NodeHandle(camera_handle).advertiseService("set_camera_info", &Calibration::set, this);
}

void Calibration::pictureCame(std::uint32_t width, std::uint32_t height) {
  if (pictureSize() != std::make_pair(width, height)) {
    infoFor(width, height);
  }
}

CameraInfo Calibration::infoFor(std::uint32_t width, std::uint32_t height) {
  const std::lock_guard<std::mutex> lock(mutex_);
  picture_width_ = width;
  picture_height_ = height;
  if (!isEmpty(stored_)) {
    if (const std::optional<CameraInfo> scaled = scaleCalibration(stored_, width, height)) {
      return *scaled;
    }
    if (!misfit_reported_) {
      misfit_reported_ = true;
      ROS_WARN_STREAM_NAMED("camera", "The calibration in "
                                          << file_ << " is for pictures of " << sizeOf(stored_)
                                          << ", but the robot sends " << sizeOf(width, height)
                                          << ": camera_info holds the nominal one. Calibrate the camera again.");
    }
  }
  return nominalCalibration(design_, width, height);
}

std::pair<std::uint32_t, std::uint32_t> Calibration::pictureSize() {
  const std::lock_guard<std::mutex> lock(mutex_);
  return {picture_width_, picture_height_};
}

bool Calibration::set(sensor_msgs::SetCameraInfo::Request& request, sensor_msgs::SetCameraInfo::Response& response) {
  const std::string problem = store(request.camera_info);
  response.success = problem.empty();
  if (!response.success) {
    response.status_message = "The calibration stays as it was: " + text::sentence(problem);
    warnings_.warn("set_camera_info was refused. " + response.status_message);
    return true;
  }
  response.status_message = "The calibration is stored in " + file_ + ".";
  news_.say("A calibration for pictures of " + sizeOf(request.camera_info) + " is stored in " + file_ +
            " and used from now on.");
  return true;
}

// @return why the calibration was not stored; empty if it was
std::string Calibration::store(const CameraInfo& info) {
  if (isEmpty(info)) {
    return "all of K is 0, which means that there is no calibration; delete " + file_ +
           " and start the driver again to go back to the nominal one";
  }
  const std::string problem = problemOf(info);
  if (!problem.empty()) {
    return problem;
  }
  const auto [width, height] = pictureSize();
  if (width > 0 && !scaleCalibration(info, width, height)) {
    return "it is for pictures of " + sizeOf(info) + ", but the robot sends " + sizeOf(width, height);
  }
  try {
    saveCalibration(info, camera_name_, file_);
  } catch (const std::exception& error) {
    return error.what();
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  stored_ = info;
  misfit_reported_ = false;
  return {};
}

}  // namespace aibo_driver::node
