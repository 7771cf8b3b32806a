#include "support/proxy/recording_proxy.h"

namespace test_support {

RecordingProxy::RecordingProxy(int robot_port) : proxy_(options(robot_port)) {}

FaultProxy::Options RecordingProxy::options(int robot_port) {
  FaultProxy::Options options;
  options.target_port = robot_port;
  options.tap = [this](std::size_t connection, Direction direction, const std::uint8_t* data, std::size_t size) {
    record(connection, direction, data, size);
  };
  return options;
}

void RecordingProxy::record(std::size_t number, Direction direction, const std::uint8_t* data, std::size_t size) {
  const std::lock_guard<std::mutex> lock(mutex_);
  while (connections_.size() <= number) {
    connections_.emplace_back(&pictures_);
  }
  Connection& connection = connections_[number];
  if (direction == Direction::kToClient) {
    connection.replies.feed(data, size);
    return;
  }
  for (Request& request : connection.request_scanner.feed(data, size)) {
    if (request.version2) {
      connection.requests.push_back(std::move(request));
    }
  }
  changed_.notify_all();
}

void RecordingProxy::setMute(bool mute) {
  Conditions conditions;
  conditions.paused = mute;
  proxy_.setConditions(conditions);
}

std::vector<Bytes> RecordingProxy::picturesFromRobot() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return pictures_;
}

std::vector<Request> RecordingProxy::requestsFromDriver(const std::string& kinds, std::size_t first_connection) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return requests(kinds, first_connection);
}

bool RecordingProxy::waitForRequest(const std::string& kinds, std::chrono::seconds timeout) {
  std::unique_lock<std::mutex> lock(mutex_);
  return changed_.wait_for(lock, timeout, [&] { return !requests(kinds, 0).empty(); });
}

std::vector<Request> RecordingProxy::requests(const std::string& kinds, std::size_t first_connection) const {
  std::vector<Request> found;
  for (std::size_t i = first_connection; i < connections_.size(); ++i) {
    for (const Request& request : connections_[i].requests) {
      if (kinds.find(request.kind) != std::string::npos) {
        found.push_back(request);
      }
    }
  }
  return found;
}

}  // namespace test_support
