#include "camera/camera_options.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace aibo_driver::camera {

using aibo_client::PictureTransport;
using aibo_client::Resolution;

std::optional<Resolution> resolutionOf(const std::string& name) {
  static const std::pair<const char*, Resolution> kResolutions[] = {{"52x40", Resolution::kLow},
                                                                    {"104x80", Resolution::kMiddle},
                                                                    {"208x160", Resolution::kHigh},
                                                                    {"416x320", Resolution::kDouble}};
  for (const auto& resolution : kResolutions) {
    if (name == resolution.first) {
      return resolution.second;
    }
  }
  return std::nullopt;
}

std::optional<PictureTransport> transportOf(const std::string& name) {
  for (const PictureTransport transport : {PictureTransport::kTcp, PictureTransport::kUdp}) {
    if (name == nameOf(transport)) {
      return transport;
    }
  }
  return std::nullopt;
}

const char* nameOf(PictureTransport transport) {
  return transport == PictureTransport::kUdp ? "udp" : "tcp";
}

std::string transportReason(const aibo_client::ConnectionStatus& status) {
  if (status.state != aibo_client::ConnectionState::kConnected) {
    return "";
  }
  if (!status.transport_problem.empty()) {
    return status.transport_problem;
  }
  if (status.transport == PictureTransport::kUdp) {
    return "datagrams from the robot get through";
  }
  return status.wanted_transport == PictureTransport::kTcp ? "~transport is tcp" : "UDP has not been tried yet";
}

int everyNthImageOf(double rate) {
  return static_cast<int>(std::lround(kCameraRate / std::clamp(rate, kLowestFrameRate, kCameraRate)));
}

double frameRateOf(int every_nth_image) {
  return kCameraRate / every_nth_image;
}

}  // namespace aibo_driver::camera
