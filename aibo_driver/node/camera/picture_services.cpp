#include <aibo_driver/DeletePicture.h>
#include <aibo_driver/FetchPicture.h>
#include <aibo_driver/ListPictures.h>
#include <aibo_driver/TakePicture.h>
#include <aibo_driver/TakePictureOnRobot.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "aibo_client/exceptions.h"
#include "camera/camera_options.h"
#include "files/files.h"
#include "node/camera/camera_publisher.h"
#include "node/connection_message.h"
#include "node/service.h"
#include "node/services.h"
#include "text/plain_text.h"

namespace aibo_driver::node {
namespace {

// How long a call waits for a picture on the memory stick, which is slow.
constexpr std::chrono::milliseconds kStickTimeout{15000};

std::string describePicture(const aibo_client::Picture& picture, int asked_quality, int protocol_version) {
  std::string text = "Took a picture of " + std::to_string(picture.width) + "x" + std::to_string(picture.height) +
                     " pixels, " + std::to_string(picture.jpeg.size()) + " bytes, at quality " +
                     std::to_string(picture.quality);
  if (asked_quality != picture.quality) {
    const std::string quality = std::to_string(asked_quality);
    text += protocol_version == 1
                ? "; it is a picture of the stream, and quality " + quality + " would need the stream to be off"
                : "; at quality " + quality + " it would have been too large";
  }
  return text + ".";
}

/// Counts a call while it waits for a picture.
class PictureCall {
 public:
  /// @throw CommandException kMostPictureCalls are waiting already
  explicit PictureCall(std::atomic<int>& calls) : calls_(calls) {
    if (++calls_ > kMostPictureCalls) {
      --calls_;
      throw aibo_client::CommandException(std::to_string(kMostPictureCalls) +
                                          " calls already wait for a picture. Call again when one has been answered.");
    }
  }
  ~PictureCall() { --calls_; }
  PictureCall(const PictureCall&) = delete;
  PictureCall& operator=(const PictureCall&) = delete;

 private:
  std::atomic<int>& calls_;
};

std::optional<aibo_client::Resolution> resolutionIn(const TakePicture::Request& request) {
  const std::optional<aibo_client::Resolution> resolution = camera::resolutionOf(request.resolution);
  if (!resolution && !request.resolution.empty()) {
    throw aibo_client::InvalidArgumentException("the resolution '" + text::plainLine(request.resolution) +
                                                "' is not one of " + camera::kResolutionNames +
                                                "; empty means the stream's.");
  }
  return resolution;
}

/// @param asked the quality in the request; 0 means the default
int qualityOf(int asked, const std::function<int()>& default_quality) {
  return asked == 0 ? default_quality() : std::min(asked, camera::kMaxQuality);
}

/// Saves a picture if the caller wants that.
/// @param got a sentence that says which picture the answer has
template <typename Service>
std::string save(const std::vector<std::uint8_t>& jpeg, const std::string& folder, const std::string& got,
                 ServiceCall<Service>* call) {
  if (call->request.save_to.empty()) {
    return got;
  }
  call->failure = got + " It was not saved";
  return got + " Saved to '" + files::saveJpeg(folder, call->request.save_to, jpeg) + "'.";
}

/// @throw InvalidArgumentException the name is empty
std::string pictureNamed(const std::string& name) {
  if (name.empty()) {
    throw aibo_client::InvalidArgumentException("give the name of a picture. list_pictures lists them.");
  }
  return files::pictureFileName(name);
}

/// Answers a caller who wants the stream on or off. Success means that the stream is as wanted, or soon will be.
template <typename Response>
std::string answerWish(bool wanted, const camera::StreamPolicy& policy, const DriverParameters& parameters,
                       const aibo_client::RcServerClient& client, Response* response) {
  if (!wanted) {
    return "The stream is off: the robot is asked for no pictures.";
  }
  const aibo_client::ConnectionStatus status = client.status();
  if (status.state != aibo_client::ConnectionState::kConnected) {
    response->success = false;
    return "The stream is on for the driver, but the robot does not answer yet; pictures come as soon as it does: " +
           describeConnection(status, parameters.client) + ".";
  }
  return policy.waitsForSubscriber()
             ? "The stream is on, on demand: pictures come as soon as a camera topic has a subscriber."
             : "The stream is on: the robot is asked for pictures.";
}

}  // namespace

Services takePictureServices(
    const DriverParameters& parameters, aibo_client::RcServerClient& client,
    const std::function<int()>& default_quality,
    const std::function<sensor_msgs::CompressedImage(const aibo_client::Picture&)>& to_message) {
  const auto calls = std::make_shared<std::atomic<int>>(0);
  const auto take = [&client, default_quality, to_message, calls, timeout = parameters.take_picture_timeout,
                     folder = files::pictureFolder(parameters.picture_folder)](ServiceCall<TakePicture>& call) {
    const PictureCall counted(*calls);
    const int quality = qualityOf(call.request.quality, default_quality);
    const aibo_client::PicturePtr picture = client.takePicture(quality, timeout, resolutionIn(call.request));
    call.response.image = to_message(*picture);
    return save(picture->jpeg, folder, describePicture(*picture, quality, client.status().protocol_version), &call);
  };
  return {service<TakePicture>("take_picture", "There is no picture", take)};
}

Services stickPictureServices(const DriverParameters& parameters, aibo_client::RcServerClient& client,
                              const std::function<int()>& default_quality) {
  const auto take = [&client, default_quality](ServiceCall<TakePictureOnRobot>& call) {
    const int quality = qualityOf(call.request.quality, default_quality);
    call.response.name = client.takePictureOnRobot(quality, kStickTimeout);
    return call.response.name + " is on the robot's memory stick. fetch_picture gets it.";
  };
  const auto fetch = [&client, folder = files::pictureFolder(parameters.picture_folder),
                      frame_id = parameters.frame(parameters.frame_id)](ServiceCall<FetchPicture>& call) {
    const std::string name = pictureNamed(call.request.name);
    sensor_msgs::CompressedImage& image = call.response.image;
    image.data = client.fetchPicture(name, kStickTimeout);
    image.format = CameraPublisher::kFormat;
    image.header.frame_id = frame_id;
    return save(image.data, folder, "Got " + name + ", " + std::to_string(image.data.size()) + " bytes.", &call);
  };
  return {
      service<TakePictureOnRobot>("take_picture_on_robot", "There is no picture", take),
      service<ListPictures>("list_pictures", "The pictures could not be listed",
                            [&client](auto& call) {
                              call.response.names = client.listPictures(kStickTimeout);
                              return "Pictures on the robot: " + std::to_string(call.response.names.size()) + ".";
                            }),
      service<FetchPicture>("fetch_picture", "There is no picture", fetch),
      service<DeletePicture>("delete_picture", "Nothing was deleted",
                             [&client](auto& call) {
                               const std::string name = pictureNamed(call.request.name);
                               client.deletePicture(name, kStickTimeout);
                               return name + " was deleted from the robot.";
                             }),
  };
}

Services streamServices(const DriverParameters& parameters, const aibo_client::RcServerClient& client,
                        camera::StreamPolicy& policy) {
  const auto want = [&](bool wanted, auto& call) {
    policy.setWanted(wanted);
    return answerWish(wanted, policy, parameters, client, &call.response);
  };
  return {
      service<std_srvs::SetBool>("set_streaming", "The stream is as before",
                                 [want](auto& call) { return want(call.request.data != 0, call); }),
      service<std_srvs::Trigger>("toggle_streaming", "The stream is as before",
                                 [want, &policy](auto& call) { return want(!policy.wanted(), call); }),
  };
}

}  // namespace aibo_driver::node
