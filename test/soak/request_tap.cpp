#include "request_tap.h"

#include <algorithm>

namespace soak {
namespace {

namespace version2 = protocol::version2;

// Those over which a fault may still be under way.
constexpr std::size_t kConnectionsKept = 16;

// Before the first frame, the client asks for version 2.
constexpr std::size_t kBytesOfVersion1 = 2;

}  // namespace

void RequestTap::hear(std::size_t connection, const std::uint8_t* data, std::size_t size) {
  const std::lock_guard<std::mutex> lock(mutex_);
  auto& known = connections_[connection];
  if (!known) {
    known = std::make_unique<Connection>();
  }
  hear(known.get(), data, size);
  if (connections_.size() > kConnectionsKept) {
    connections_.erase(connections_.begin());
  }
}

void RequestTap::hear(Connection* connection, const std::uint8_t* data, std::size_t size) {
  const std::size_t skipped = std::min(kBytesOfVersion1 - std::min(kBytesOfVersion1, connection->bytes), size);
  connection->bytes += size;
  data += skipped;
  size -= skipped;
  while (size > 0) {
    std::size_t taken = 0;
    if (connection->frames.append(data, size, &taken) == version2::FrameReader::FRAME_COMPLETE &&
        connection->frames.header().kind == version2::REQUEST_JOINTS) {
      ++connection->joint_requests;
    }
    data += taken;
    size -= taken;
  }
}

std::size_t RequestTap::jointRequestsFrom(std::size_t connection) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::size_t sum = 0;
  for (auto each = connections_.lower_bound(connection); each != connections_.end(); ++each) {
    sum += each->second->joint_requests;
  }
  return sum;
}

std::size_t RequestTap::connections() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return connections_.empty() ? 0 : connections_.rbegin()->first + 1;
}

}  // namespace soak
