#include "node/camera/stick_picture_services.h"

#include <algorithm>
#include <utility>

#include "aibo_client/exceptions.h"
#include "files/files.h"
#include "node/camera/camera_options.h"
#include "node/camera/camera_publisher.h"
#include "node/service_answer.h"

namespace aibo_driver::node {
namespace {

/// @throw InvalidArgumentException the name is empty
std::string nameOf(const std::string& asked) {
  if (asked.empty()) {
    throw aibo_client::InvalidArgumentException("give the name of a picture. list_pictures lists them.");
  }
  return files::pictureFileName(asked);
}

}  // namespace

StickPictureServices::StickPictureServices(const DriverParameters& parameters, aibo_client::RcServerClient& client)
    : picture_folder_(files::pictureFolder(parameters.picture_folder)),
      frame_id_(parameters.frame(parameters.frame_id)),
      client_(client) {}

void StickPictureServices::advertise(const ros::NodeHandle& handle) {
  ros::NodeHandle services(handle);
  servers_.push_back(services.advertiseService("take_picture_on_robot", &StickPictureServices::takePicture, this));
  servers_.push_back(services.advertiseService("list_pictures", &StickPictureServices::listPictures, this));
  servers_.push_back(services.advertiseService("fetch_picture", &StickPictureServices::fetchPicture, this));
  servers_.push_back(services.advertiseService("delete_picture", &StickPictureServices::deletePicture, this));
}

bool StickPictureServices::takePicture(TakePictureOnRobot::Request& request, TakePictureOnRobot::Response& response) {
  return answer(response, "There is no picture", [&] {
    const int quality = request.quality == 0 ? client_.jpegQuality() : std::min<int>(request.quality, kMaxQuality);
    response.name = client_.takePictureOnRobot(quality, kTimeout);
    return response.name + " is on the robot's memory stick, at quality " + std::to_string(quality) +
           ". fetch_picture gets it.";
  });
}

bool StickPictureServices::listPictures(ListPictures::Request&, ListPictures::Response& response) {
  return answer(response, "The pictures could not be listed", [&] {
    response.names = client_.listPictures(kTimeout);
    return "Pictures on the robot: " + std::to_string(response.names.size()) + ".";
  });
}

bool StickPictureServices::fetchPicture(FetchPicture::Request& request, FetchPicture::Response& response) {
  answer(response, "There is no picture", [&] {
    const std::string name = nameOf(request.name);
    response.image.data = client_.fetchPicture(name, kTimeout);
    response.image.format = CameraPublisher::kFormat;
    response.image.header.frame_id = frame_id_;
    return "Got " + name + ", " + std::to_string(response.image.data.size()) + " bytes.";
  });
  if (!response.success || request.save_to.empty()) {
    return true;
  }
  const std::string got = response.message;
  response.success = false;
  return answer(response, got + " It was not saved", [&] {
    return got + " Saved to '" + files::saveJpeg(picture_folder_, request.save_to, response.image.data) + "'.";
  });
}

bool StickPictureServices::deletePicture(DeletePicture::Request& request, DeletePicture::Response& response) {
  return answer(response, "Nothing was deleted", [&] {
    const std::string name = nameOf(request.name);
    client_.deletePicture(name, kTimeout);
    return name + " was deleted from the robot.";
  });
}

}  // namespace aibo_driver::node
