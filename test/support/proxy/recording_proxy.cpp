#include "support/proxy/recording_proxy.h"

#include <algorithm>

#include "protocol/version1.h"
#include "protocol/version2.h"

using fault_bench::Bytes;
using fault_bench::Direction;

namespace test_support {
namespace {

struct Frame {
  protocol::version2::FrameHeader header;
  Bytes payload;
};

// The whole frames behind what agreed on version 2.
std::vector<Frame> framesIn(const Bytes& bytes, std::size_t begin) {
  namespace version2 = protocol::version2;
  std::vector<Frame> frames;
  while (begin + version2::FRAME_HEADER_SIZE <= bytes.size()) {
    const version2::FrameHeader header = version2::decodeFrameHeader(bytes.data() + begin);
    begin += version2::FRAME_HEADER_SIZE;
    if (header.payload_size > bytes.size() - begin) {
      break;
    }
    const std::size_t end = begin + header.payload_size;
    frames.push_back({header, Bytes(bytes.begin() + static_cast<std::ptrdiff_t>(begin),
                                    bytes.begin() + static_cast<std::ptrdiff_t>(end))});
    begin = end;
  }
  return frames;
}

std::vector<Bytes> version2Pictures(const Bytes& bytes) {
  std::vector<Bytes> pictures;
  for (const Frame& frame : framesIn(bytes, protocol::VALUE_REPLY_SIZE)) {
    if (frame.header.kind == protocol::version2::PICTURE) {
      pictures.emplace_back(frame.payload.begin() + protocol::version2::IMAGE_HEADER_SIZE, frame.payload.end());
    }
  }
  return pictures;
}

// Of a connection over which nothing but pictures was asked for.
std::vector<Bytes> version1Pictures(const Bytes& bytes) {
  std::vector<Bytes> pictures;
  std::size_t position = 0;
  std::size_t size = 0;
  while (position + protocol::PICTURE_HEADER_SIZE <= bytes.size() &&
         protocol::decodePictureHeader(bytes.data() + position, &size) &&
         position + protocol::PICTURE_HEADER_SIZE + size <= bytes.size()) {
    const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(position + protocol::PICTURE_HEADER_SIZE);
    pictures.emplace_back(begin, begin + static_cast<std::ptrdiff_t>(size));
    position += protocol::PICTURE_HEADER_SIZE + size;
  }
  return pictures;
}

}  // namespace

RecordingProxy::RecordingProxy(int robot_port) : proxy_(options(robot_port)) {}

fault_bench::FaultProxy::Options RecordingProxy::options(int robot_port) {
  fault_bench::FaultProxy::Options options;
  options.target_port = robot_port;
  options.tap = [this](std::size_t connection, Direction direction, const std::uint8_t* data, std::size_t size) {
    record(connection, direction, data, size);
  };
  return options;
}

void RecordingProxy::record(std::size_t connection, Direction direction, const std::uint8_t* data, std::size_t size) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    auto& recorded = direction == Direction::kToClient ? from_robot_ : from_driver_;
    recorded.resize(std::max(recorded.size(), connection + 1));
    recorded[connection].insert(recorded[connection].end(), data, data + size);
  }
  changed_.notify_all();
}

void RecordingProxy::setMute(bool mute) {
  fault_bench::Conditions conditions;
  conditions.paused = mute;
  proxy_.setConditions(conditions);
}

std::vector<Bytes> RecordingProxy::picturesFromRobot() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<Bytes> pictures;
  for (const Bytes& bytes : from_robot_) {
    const bool version2 = !bytes.empty() && bytes.front() == 'x';
    for (const Bytes& picture : version2 ? version2Pictures(bytes) : version1Pictures(bytes)) {
      pictures.push_back(picture);
    }
  }
  return pictures;
}

std::string RecordingProxy::bytesFromDriver() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::string bytes;
  for (const Bytes& sent : from_driver_) {
    bytes.append(sent.begin(), sent.end());
  }
  return bytes;
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
  for (std::size_t i = first_connection; i < from_driver_.size(); ++i) {
    for (const Frame& frame : framesIn(from_driver_[i], protocol::BASIC_COMMAND_SIZE)) {
      if (kinds.find(frame.header.kind) != std::string::npos) {
        found.push_back({frame.header.kind, frame.header.id, frame.payload});
      }
    }
  }
  return found;
}

}  // namespace test_support
