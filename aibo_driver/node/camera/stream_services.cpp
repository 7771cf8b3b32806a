#include "node/camera/stream_services.h"

#include <algorithm>
#include <optional>
#include <utility>

#include "aibo_client/exceptions.h"
#include "files/files.h"
#include "node/camera/camera_options.h"
#include "node/connection_publisher.h"
#include "node/service_answer.h"
#include "text/plain_text.h"

namespace aibo_driver::node {
namespace {

std::string describePicture(const aibo_client::Picture& picture, int asked_quality, int stream_quality) {
  std::string text = "Took a picture of " + std::to_string(picture.width) + "x" + std::to_string(picture.height) +
                     " pixels, " + std::to_string(picture.jpeg.size()) + " bytes, at quality ";
  if (stream_quality == 0) {
    return text + std::to_string(asked_quality) + ".";
  }
  text += std::to_string(stream_quality) + ", from the running stream";
  if (asked_quality != stream_quality) {
    text += "; quality " + std::to_string(asked_quality) +
            " would need the stream to be off, because this robot takes no other pictures while it streams";
  }
  return text + ".";
}

}  // namespace

StreamServices::StreamServices(const DriverParameters& parameters, aibo_client::RcServerClient& client,
                               StreamPolicy& policy, std::function<int()> default_quality, ToMessage to_message)
    : parameters_(parameters),
      picture_folder_(files::pictureFolder(parameters.picture_folder)),
      client_(client),
      policy_(policy),
      default_quality_(std::move(default_quality)),
      to_message_(std::move(to_message)) {}

void StreamServices::advertise(const ros::NodeHandle& handle, const ros::NodeHandle& picture_handle) {
  ros::NodeHandle services(handle);
  servers_.push_back(services.advertiseService("set_streaming", &StreamServices::setStreaming, this));
  servers_.push_back(services.advertiseService("toggle_streaming", &StreamServices::toggleStreaming, this));
  services = picture_handle;
  servers_.push_back(services.advertiseService("take_picture", &StreamServices::takePicture, this));
}

bool StreamServices::takePicture(TakePicture::Request& request, TakePicture::Response& response) {
  const int quality = request.quality == 0 ? default_quality_() : std::min<int>(request.quality, kMaxQuality);
  const std::optional<aibo_client::Resolution> resolution = resolutionOf(request.resolution);
  std::string failure = "There is no picture";
  return answer(response, failure, [&] {
    if (!resolution && !request.resolution.empty()) {
      throw aibo_client::InvalidArgumentException("the resolution '" + text::plainLine(request.resolution) +
                                                  "' is not one of " + kResolutionNames +
                                                  "; empty means the stream's.");
    }
    int stream_quality = 0;
    const aibo_client::PicturePtr picture =
        client_.takePicture(quality, parameters_.take_picture_timeout, &stream_quality, resolution);
    response.image = to_message_(*picture);
    const std::string taken = describePicture(*picture, quality, stream_quality);
    if (request.save_to.empty()) {
      return taken;
    }
    failure = taken + " It was not saved";
    return taken + " Saved to '" + files::saveJpeg(picture_folder_, request.save_to, picture->jpeg) + "'.";
  });
}

bool StreamServices::setStreaming(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response) {
  policy_.setWanted(request.data);
  return answerStreaming(request.data, response);
}

bool StreamServices::toggleStreaming(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  return answerStreaming(policy_.toggleWanted(), response);
}

// Success means that the stream is as wanted, or that it will be without the caller's help.
template <typename Response>
bool StreamServices::answerStreaming(bool wanted, Response& response) const {
  const aibo_client::ConnectionStatus status = client_.status();
  response.success = !wanted || status.state == aibo_client::ConnectionState::kConnected;
  if (!wanted) {
    response.message = "The stream is off.";
  } else if (!response.success) {
    response.message =
        "The stream is on for the driver, but the robot does not answer yet; pictures come as soon as it does: " +
        describeConnection(status, parameters_.client) + ".";
  } else if (policy_.waitsForSubscriber()) {
    response.message = "The stream is on, on demand: pictures come as soon as a camera topic has a subscriber.";
  } else {
    response.message = "The stream is on.";
  }
  return true;
}

}  // namespace aibo_driver::node
