#include "node/camera/camera_state_publisher.h"

#include <cstdint>
#include <tuple>

#include "node/publish_latched.h"

namespace aibo_driver::node {
namespace {

auto stateIn(const CameraState& state) {
  return std::make_tuple(state.width, state.height, state.white_balance, state.gain, state.shutter_speed,
                         state.auto_exposure, state.auto_white_balance);
}

}  // namespace

CameraState cameraStateOf(const aibo_client::Picture& picture, const std_msgs::Header& header) {
  CameraState state;
  state.header = header;
  state.frame_number = picture.frame_number.value_or(0);
  state.image_count = picture.image_count.value_or(0);
  state.width = static_cast<std::uint16_t>(picture.width);
  state.height = static_cast<std::uint16_t>(picture.height);
  if (picture.settings) {
    state.white_balance = static_cast<std::uint8_t>(picture.settings->white_balance);
    state.gain = static_cast<std::uint8_t>(picture.settings->gain);
    state.shutter_speed = static_cast<std::uint8_t>(picture.settings->shutter_speed);
    state.auto_exposure = static_cast<std::uint8_t>(picture.settings->auto_exposure);
    state.auto_white_balance = static_cast<std::uint8_t>(picture.settings->auto_white_balance);
  }
  return state;
}

bool isSameState(const CameraState& one, const CameraState& other) {
  return stateIn(one) == stateIn(other);
}

CameraStatePublisher::CameraStatePublisher(const ros::NodeHandle& camera_handle)
    : publisher_(ros::NodeHandle(camera_handle).advertise<CameraState>("state", 10, true)) {}

void CameraStatePublisher::update(const aibo_client::Picture& picture, const ros::Time& stamp,
                                  const std::string& frame_id) {
  CameraState state = cameraStateOf(picture, {});
  if (last_ && connection_ == picture.connection_number && isSameState(*last_, state)) {
    return;
  }
  connection_ = picture.connection_number;
  state.header.stamp = stamp;
  state.header.frame_id = frame_id;
  last_ = state;
  publishLatched(publisher_, state);
}

}  // namespace aibo_driver::node
