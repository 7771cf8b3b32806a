#include "motion_file_services.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "aibo_driver/exceptions.h"
#include "file_loader.h"
#include "motion_name.h"

namespace aibo_driver {
namespace {

constexpr std::size_t kLongestMotion = 65523;  // RcServerClient::uploadMotion()

std::vector<std::uint8_t> contentOf(const UploadMotion::Request& request) {
  if (request.file.empty() == request.data.empty()) {
    throw LoadException(request.file.empty() ? "give a file or data" : "give a file or data, not both");
  }
  return request.file.empty() ? request.data : loadFile(request.file, kLongestMotion);
}

std::string nameOf(const UploadMotion::Request& request) {
  return motionFileName(request.name.empty() ? std::filesystem::path(request.file).filename().string() : request.name);
}

}  // namespace

MotionFileServices::MotionFileServices(const ros::NodeHandle& handle, RcServerClient& client) : client_(client) {
  ros::NodeHandle services(handle);
  list_server_ = services.advertiseService("list_motions", &MotionFileServices::listMotions, this);
  upload_server_ = services.advertiseService("upload_motion", &MotionFileServices::uploadMotion, this);
  delete_server_ = services.advertiseService("delete_motion", &MotionFileServices::deleteMotion, this);
}

bool MotionFileServices::listMotions(ListMotions::Request&, ListMotions::Response& response) {
  try {
    response.names = client_.listMotions(kTimeout);
    response.message = "Motions on the robot: " + std::to_string(response.names.size()) + ".";
    response.success = true;
  } catch (const Exception& error) {
    response.message = std::string("The motions are not known: ") + error.what();
  }
  return true;
}

bool MotionFileServices::uploadMotion(UploadMotion::Request& request, UploadMotion::Response& response) {
  try {
    const std::vector<std::uint8_t> content = contentOf(request);
    const std::string name = nameOf(request);
    client_.uploadMotion(name, content, kUploadTimeout);
    response.message = name + " is on the robot, " + std::to_string(content.size()) + " bytes.";
    response.success = true;
  } catch (const Exception& error) {
    response.message = std::string("Nothing was uploaded: ") + error.what();
  }
  return true;
}

bool MotionFileServices::deleteMotion(DeleteMotion::Request& request, DeleteMotion::Response& response) {
  const std::string name = motionFileName(request.name);
  try {
    client_.deleteMotion(name, kTimeout);
    response.message = name + " was deleted from the robot.";
    response.success = true;
  } catch (const Exception& error) {
    response.message = std::string("Nothing was deleted: ") + error.what();
  }
  return true;
}

}  // namespace aibo_driver
