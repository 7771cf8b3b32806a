#include "ros/camera/calibration.h"

#include <camera_calibration_parsers/parse.h>
#include <ros/console.h>
#include <ros/package.h>
#include <ros/service_manager.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <exception>

#include "aibo_driver/exceptions.h"
#include "aibo_driver/jpeg_inspector.h"

namespace aibo_driver::node {
namespace {

constexpr const char* kService = "set_camera_info";
constexpr const char* kDefaultUrl = "file://${ROS_HOME}/camera_info/${NAME}.yaml";  // camera_info_manager's

constexpr std::size_t kMostCoefficients = 14;  // OpenCV has no model with more

template <typename Numbers>
bool allFinite(const Numbers& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double number) { return std::isfinite(number); });
}

bool isKnownModel(const std::string& model) {
  return model.empty() || model == "plumb_bob" || model == "rational_polynomial" || model == "equidistant";
}

// The file of a resolved URL that camera_info_manager considers valid.
std::string fileOf(const std::string& url) {
  const std::size_t begin = url.find("//") + 2;
  if (url.front() == 'f' || url.front() == 'F') {
    return url.substr(begin);
  }
  const std::size_t slash = url.find('/', begin);
  return ros::package::getPath(url.substr(begin, slash - begin)) + url.substr(slash);
}

}  // namespace

std::string problemOf(const sensor_msgs::CameraInfo& info) {
  if (info.width == 0 || info.height == 0 || info.width > kLargestPictureWidth || info.height > kLargestPictureHeight) {
    return "the camera has no pictures of " + std::to_string(info.width) + "x" + std::to_string(info.height);
  }
  if (!isKnownModel(info.distortion_model)) {
    return "the distortion model is not plumb_bob, rational_polynomial or equidistant";
  }
  if (info.D.size() > kMostCoefficients) {
    return "no distortion model has " + std::to_string(info.D.size()) + " coefficients";
  }
  if (!allFinite(info.D) || !allFinite(info.K) || !allFinite(info.R) || !allFinite(info.P)) {
    return "a number in it is not finite";
  }
  return {};
}

Calibration::Calibration(const ros::NodeHandle& camera_handle, const std::string& camera_name, const std::string& url)
    : camera_name_(camera_name), manager_(camera_handle, camera_name) {
  ros::NodeHandle handle(camera_handle);
  ros::ServiceManager::instance()->unadvertiseService(handle.resolveName(kService));
  if (!manager_.validateURL(url)) {
    throw InvalidArgumentException("Parameter camera_info_url is '" + url +
                                   "', which cannot be resolved; allowed is file:///FILE.yaml, "
                                   "package://PACKAGE/FILE.yaml of an installed package, or empty.");
  }
  file_ = fileOf(manager_.resolveURL(url.empty() ? kDefaultUrl : url, camera_name));
  manager_.loadCameraInfo(url);
  const std::string problem = isCalibrated() ? problemOf(cameraInfo()) : "";
  if (!problem.empty()) {
    ROS_WARN_STREAM_NAMED("camera", "The calibration in " << file_ << " is left out: " << problem << ".");
    manager_.setCameraInfo(sensor_msgs::CameraInfo());
  }
  service_ = handle.advertiseService(kService, &Calibration::set, this);
}

bool Calibration::set(sensor_msgs::SetCameraInfo::Request& request, sensor_msgs::SetCameraInfo::Response& response) {
  std::string problem = problemOf(request.camera_info);
  try {
    if (problem.empty() && !camera_calibration_parsers::writeCalibration(file_, camera_name_, request.camera_info)) {
      problem = file_ + " cannot be written";
    }
  } catch (const std::exception& error) {
    problem = error.what();
  }
  response.success = problem.empty();
  if (response.success) {
    manager_.setCameraInfo(request.camera_info);
  } else {
    response.status_message = "The calibration stays as it was: " + problem + ".";
  }
  return true;
}

}  // namespace aibo_driver::node
