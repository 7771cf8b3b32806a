#include "request_tap.h"

#include "protocol/version2.h"

namespace soak {
namespace {

// A fault may still be under way over these.
constexpr std::size_t kConnectionsKept = 16;

}  // namespace

void RequestTap::hear(std::size_t connection, const std::uint8_t* data, std::size_t size) {
  const std::lock_guard<std::mutex> lock(mutex_);
  Connection& known = connections_[connection];
  for (const test_support::Request& request : known.scanner.feed(data, size)) {
    known.joint_requests += request.version2 && request.kind == protocol::version2::REQUEST_JOINTS ? 1 : 0;
  }
  if (connections_.size() > kConnectionsKept) {
    connections_.erase(connections_.begin());
  }
}

std::size_t RequestTap::jointRequestsFrom(std::size_t connection) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::size_t sum = 0;
  for (auto each = connections_.lower_bound(connection); each != connections_.end(); ++each) {
    sum += each->second.joint_requests;
  }
  return sum;
}

std::size_t RequestTap::connections() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return connections_.empty() ? 0 : connections_.rbegin()->first + 1;
}

}  // namespace soak
