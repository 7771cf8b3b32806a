#include "ros/camera/stream_services.h"

#include <std_msgs/Bool.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include "aibo_driver/exceptions.h"
#include "ros/camera/file_saver.h"
#include "ros/connection_publisher.h"

namespace aibo_driver::node {
namespace {

// So many callers may wait for a picture at the same time; the next one waits for one of them.
constexpr std::uint32_t kTakePictureThreads = 4;

constexpr std::uint8_t kMaxQuality = 100;  // report, section 3.3.6

std::string describePicture(const Picture& picture, int asked_quality, int stream_quality) {
  std::string text = "Took a picture of " + std::to_string(picture.width) + "x" + std::to_string(picture.height) +
                     " pixels, " + std::to_string(picture.jpeg.size()) + " bytes, at quality ";
  if (stream_quality == 0) {
    return text + std::to_string(asked_quality) + ".";
  }
  text += std::to_string(stream_quality) + ", from the running stream";
  if (asked_quality != stream_quality) {
    text += "; quality " + std::to_string(asked_quality) +
            " would need the stream to be off, because the robot takes no other pictures while it streams";
  }
  return text + ".";
}

}  // namespace

StreamServices::StreamServices(const ros::NodeHandle& handle, const DriverParameters& parameters,
                               RcServerClient& client, StreamPolicy& policy, ToMessage to_message)
    : parameters_(parameters),
      client_(client),
      policy_(policy),
      to_message_(std::move(to_message)),
      take_picture_threads_(kTakePictureThreads, &take_picture_queue_) {
  ros::NodeHandle services(handle);
  streaming_publisher_ = services.advertise<std_msgs::Bool>("streaming", 1, true);
  publishStreaming(false);
  set_streaming_server_ = services.advertiseService("set_streaming", &StreamServices::setStreaming, this);
  toggle_streaming_server_ = services.advertiseService("toggle_streaming", &StreamServices::toggleStreaming, this);
  services.setCallbackQueue(&take_picture_queue_);
  take_picture_server_ = services.advertiseService("take_picture", &StreamServices::takePicture, this);
  take_picture_threads_.start();
}

StreamServices::~StreamServices() {
  take_picture_threads_.stop();
}

void StreamServices::publishStreaming(bool streaming) {
  std_msgs::Bool message;
  message.data = streaming;
  streaming_publisher_.publish(message);
}

bool StreamServices::takePicture(TakePicture::Request& request, TakePicture::Response& response) {
  const int quality = request.quality == 0 ? client_.jpegQuality() : std::min<int>(request.quality, kMaxQuality);
  try {
    int stream_quality = 0;
    const PicturePtr picture = client_.takePicture(quality, parameters_.take_picture_timeout, &stream_quality);
    response.image = to_message_(*picture);
    response.message = describePicture(*picture, quality, stream_quality);
    if (!request.save_to.empty()) {
      response.message += " Saved to " + saveJpeg(request.save_to, picture->jpeg) + ".";
    }
    response.success = true;
  } catch (const SaveException& error) {
    response.message += std::string(" It was not saved: ") + error.what() + ".";
  } catch (const std::exception& error) {
    response.message = std::string("There is no picture: ") + error.what();
  }
  return true;
}

bool StreamServices::setStreaming(std_srvs::SetBool::Request& request, std_srvs::SetBool::Response& response) {
  policy_.setWanted(request.data);
  response.success = describeStream(request.data, &response.message);
  return true;
}

bool StreamServices::toggleStreaming(std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) {
  response.success = describeStream(policy_.toggleWanted(), &response.message);
  return true;
}

bool StreamServices::describeStream(bool wanted, std::string* message) const {
  if (!wanted) {
    *message = "The stream is off.";
    return true;
  }
  const ConnectionStatus status = client_.status();
  if (status.state != ConnectionState::kConnected) {
    *message =
        "The stream is on for the driver, but the robot does not answer yet; pictures come as soon as it does: " +
        describeConnection(status, parameters_.client) + ".";
    return false;
  }
  *message = policy_.waitsForSubscriber()
                 ? "The stream is on, on demand: pictures come as soon as a camera topic has a subscriber."
                 : "The stream is on.";
  return true;
}

}  // namespace aibo_driver::node
