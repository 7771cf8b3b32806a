#include <aibo_driver/DeletePicture.h>
#include <aibo_driver/FetchPicture.h>
#include <aibo_driver/ListPictures.h>
#include <aibo_driver/TakePictureOnRobot.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <string>

#include "aibo_client/exceptions.h"
#include "camera/camera_options.h"
#include "files/files.h"
#include "node/camera/camera_publisher.h"
#include "node/service.h"
#include "node/services.h"

namespace aibo_driver::node {
namespace {

// How long a call waits. The time is long because a memory stick is slow.
constexpr std::chrono::milliseconds kTimeout{15000};

/// @throw InvalidArgumentException the name is empty
std::string nameOf(const std::string& asked) {
  if (asked.empty()) {
    throw aibo_client::InvalidArgumentException("give the name of a picture. list_pictures lists them.");
  }
  return files::pictureFileName(asked);
}

/// @param folder the folder in which save_to may write
std::string fetch(aibo_client::RcServerClient* client, const std::string& folder, const std::string& frame_id,
                  ServiceCall<FetchPicture>* call) {
  const std::string name = nameOf(call->request.name);
  sensor_msgs::CompressedImage& image = call->response.image;
  image.data = client->fetchPicture(name, kTimeout);
  image.format = CameraPublisher::kFormat;
  image.header.frame_id = frame_id;
  const std::string got = "Got " + name + ", " + std::to_string(image.data.size()) + " bytes.";
  if (call->request.save_to.empty()) {
    return got;
  }
  call->failure = got + " It was not saved";
  return got + " Saved to '" + files::saveJpeg(folder, call->request.save_to, image.data) + "'.";
}

}  // namespace

Services stickPictureServices(const DriverParameters& parameters, aibo_client::RcServerClient& client,
                              const std::function<int()>& default_quality) {
  const std::string folder = files::pictureFolder(parameters.picture_folder);
  const std::string frame_id = parameters.frame(parameters.frame_id);
  return {
      service<TakePictureOnRobot>("take_picture_on_robot", "There is no picture",
                                  [&client, default_quality](auto& call) {
                                    const int asked = call.request.quality;
                                    const int quality =
                                        asked == 0 ? default_quality() : std::min(asked, camera::kMaxQuality);
                                    call.response.name = client.takePictureOnRobot(quality, kTimeout);
                                    return call.response.name + " is on the robot's memory stick, at quality " +
                                           std::to_string(quality) + ". fetch_picture gets it.";
                                  }),
      service<ListPictures>("list_pictures", "The pictures could not be listed",
                            [&client](auto& call) {
                              call.response.names = client.listPictures(kTimeout);
                              return "Pictures on the robot: " + std::to_string(call.response.names.size()) + ".";
                            }),
      service<FetchPicture>(
          "fetch_picture", "There is no picture",
          [&client, folder, frame_id](auto& call) { return fetch(&client, folder, frame_id, &call); }),
      service<DeletePicture>("delete_picture", "Nothing was deleted",
                             [&client](auto& call) {
                               const std::string name = nameOf(call.request.name);
                               client.deletePicture(name, kTimeout);
                               return name + " was deleted from the robot.";
                             }),
  };
}

}  // namespace aibo_driver::node
