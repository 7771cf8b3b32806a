#include "ros/body/motion_file_services.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "mtn/layout.h"
#include "ros/body/file_loader.h"
#include "ros/body/motion_name.h"
#include "ros/service_answer.h"

namespace aibo_driver::node {
namespace {

std::vector<std::uint8_t> contentOf(const UploadMotion::Request& request) {
  if (request.file.empty() == request.data.empty()) {
    throw LoadException(request.file.empty() ? "give a file or data" : "give a file or data, not both");
  }
  return request.file.empty() ? request.data : loadFile(request.file, mtn::MAX_FILE_SIZE);
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
  return answerService(response, "The motions are not known", [&] {
    response.names = client_.listMotions(kTimeout);
    return "Motions on the robot: " + std::to_string(response.names.size()) + ".";
  });
}

bool MotionFileServices::uploadMotion(UploadMotion::Request& request, UploadMotion::Response& response) {
  return answerService(response, "Nothing was uploaded", [&] {
    const std::vector<std::uint8_t> content = contentOf(request);
    const std::string name = nameOf(request);
    client_.uploadMotion(name, content, kUploadTimeout);
    return name + " is on the robot, " + std::to_string(content.size()) + " bytes.";
  });
}

bool MotionFileServices::deleteMotion(DeleteMotion::Request& request, DeleteMotion::Response& response) {
  return answerService(response, "Nothing was deleted", [&] {
    const std::string name = motionFileName(request.name);
    client_.deleteMotion(name, kTimeout);
    return name + " was deleted from the robot.";
  });
}

}  // namespace aibo_driver::node
