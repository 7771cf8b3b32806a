#include "radio/robot_on_radio.h"

#include <functional>
#include <string_view>

using test_support::RobotThread;

namespace fault_bench {
namespace {

std::size_t hash(std::string_view bytes) {
  return std::hash<std::string_view>()(bytes);
}

}  // namespace

RobotOnRadio::RobotOnRadio(const NetworkHost& host)
    : thread_(robot_, machineOptions(host), [&host] { host.enter(); }) {}

openr_host::MachineOptions RobotOnRadio::machineOptions(const NetworkHost& host) {
  openr_host::MachineOptions options = RobotThread::defaultOptions();
  options.bind_address = host.address();
  options.ports = {{RobotThread::kRobotPort, RobotThread::kRobotPort}};
  options.on_camera_image = [this] { cameraImageTaken(); };
  options.on_send = [this](const void* data, std::size_t size) { aboutToSend(data, size); };
  return options;
}

void RobotOnRadio::cameraImageTaken() {
  const std::lock_guard<std::mutex> lock(mutex_);
  image_at_ = std::chrono::steady_clock::now();
}

void RobotOnRadio::aboutToSend(const void* data, std::size_t size) {
  const std::lock_guard<std::mutex> lock(mutex_);
  if (pictures_.add(data, size)) {
    picture_at_ = image_at_;
  }
  if (pictures_.isComplete()) {
    sent_[hash(pictures_.jpeg())] = {sent_.size() + 1, picture_at_};
  }
}

std::optional<RobotOnRadio::Sent> RobotOnRadio::find(const std::vector<std::uint8_t>& jpeg) const {
  const std::size_t wanted = hash({reinterpret_cast<const char*>(jpeg.data()), jpeg.size()});
  const std::lock_guard<std::mutex> lock(mutex_);
  const auto found = sent_.find(wanted);
  return found == sent_.end() ? std::nullopt : std::optional<Sent>(found->second);
}

}  // namespace fault_bench
