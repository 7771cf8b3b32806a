#include "recording_proxy.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <numeric>
#include <stdexcept>

#include "protocol/version1.h"
#include "protocol/version2.h"

namespace test_support {
namespace {

constexpr int kPollMilliseconds = 5;  // how soon cut() and the destructor are noticed

sockaddr_in loopback(int port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(port));
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

int makeSocket() {
  const int descriptor = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const int on = 1;
  ::setsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on));
  return descriptor;
}

bool sendAll(int descriptor, const std::uint8_t* data, std::size_t size) {
  while (size > 0) {
    const ssize_t count = ::send(descriptor, data, size, MSG_NOSIGNAL);
    if (count <= 0) {
      return false;
    }
    data += count;
    size -= static_cast<std::size_t>(count);
  }
  return true;
}

bool isReadable(int descriptor, int timeout) {
  pollfd poll_descriptor{descriptor, POLLIN, 0};
  return ::poll(&poll_descriptor, 1, timeout) > 0;
}

struct Frame {
  protocol::version2::FrameHeader header;
  std::vector<std::uint8_t> payload;
};

// The whole frames behind what agreed on version 2.
std::vector<Frame> framesIn(const std::vector<std::uint8_t>& bytes, std::size_t begin) {
  namespace version2 = protocol::version2;
  std::vector<Frame> frames;
  while (begin + version2::FRAME_HEADER_SIZE <= bytes.size()) {
    const version2::FrameHeader header = version2::decodeFrameHeader(bytes.data() + begin);
    begin += version2::FRAME_HEADER_SIZE;
    if (header.payload_size > bytes.size() - begin) {
      break;
    }
    const std::size_t end = begin + header.payload_size;
    frames.push_back({header, std::vector<std::uint8_t>(bytes.begin() + static_cast<std::ptrdiff_t>(begin),
                                                        bytes.begin() + static_cast<std::ptrdiff_t>(end))});
    begin = end;
  }
  return frames;
}

std::vector<std::vector<std::uint8_t>> version2Pictures(const std::vector<std::uint8_t>& bytes) {
  std::vector<std::vector<std::uint8_t>> pictures;
  for (const Frame& frame : framesIn(bytes, protocol::VALUE_REPLY_SIZE)) {
    if (frame.header.kind == protocol::version2::PICTURE) {
      pictures.emplace_back(frame.payload.begin() + protocol::version2::IMAGE_HEADER_SIZE, frame.payload.end());
    }
  }
  return pictures;
}

// Of a connection over which nothing but pictures was asked for.
std::vector<std::vector<std::uint8_t>> version1Pictures(const std::vector<std::uint8_t>& bytes) {
  std::vector<std::vector<std::uint8_t>> pictures;
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

RecordingProxy::RecordingProxy(int robot_port) : robot_port_(robot_port), listener_(makeSocket()) {
  sockaddr_in address = loopback(0);
  socklen_t size = sizeof(address);
  if (::bind(listener_, reinterpret_cast<sockaddr*>(&address), size) != 0 || ::listen(listener_, 1) != 0 ||
      ::getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size) != 0) {
    throw std::runtime_error("the proxy cannot listen");
  }
  port_ = ntohs(address.sin_port);
  thread_ = std::thread(&RecordingProxy::run, this);
}

RecordingProxy::~RecordingProxy() {
  stopping_ = true;
  thread_.join();
  ::close(listener_);
}

void RecordingProxy::run() {
  while (!stopping_) {
    if (!isReadable(listener_, kPollMilliseconds)) {
      continue;
    }
    const int driver = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
    if (driver >= 0) {
      cut_ = false;
      serve(driver);
      ::close(driver);
    }
  }
}

void RecordingProxy::serve(int driver) {
  const int on = 1;
  ::setsockopt(driver, IPPROTO_TCP, TCP_NODELAY, &on, sizeof(on));
  const int robot = makeSocket();
  const sockaddr_in address = loopback(robot_port_);
  bool connected = ::connect(robot, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
  if (connected) {
    const std::lock_guard<std::mutex> lock(mutex_);
    from_robot_.emplace_back();
    from_driver_.emplace_back();
  }
  std::array<std::uint8_t, 65536> buffer{};
  while (connected && !stopping_ && !cut_) {
    // poll() leaves out a negative descriptor.
    std::array<pollfd, 2> ends{{{driver, POLLIN, 0}, {mute_ ? -1 : robot, POLLIN, 0}}};
    ::poll(ends.data(), ends.size(), kPollMilliseconds);
    for (const pollfd& end : ends) {
      if (end.revents == 0) {
        continue;
      }
      const ssize_t count = ::recv(end.fd, buffer.data(), buffer.size(), 0);
      if (count <= 0) {
        connected = false;
        break;
      }
      const auto bytes = static_cast<std::size_t>(count);
      {
        const std::lock_guard<std::mutex> lock(mutex_);
        if (end.fd == robot) {
          from_robot_.back().insert(from_robot_.back().end(), buffer.begin(), buffer.begin() + count);
        } else {
          from_driver_.back().append(buffer.begin(), buffer.begin() + count);
        }
      }
      changed_.notify_all();
      connected = connected && sendAll(end.fd == robot ? driver : robot, buffer.data(), bytes);
    }
  }
  ::close(robot);
}

std::vector<std::vector<std::uint8_t>> RecordingProxy::picturesFromRobot() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<std::vector<std::uint8_t>> pictures;
  for (const std::vector<std::uint8_t>& bytes : from_robot_) {
    const bool version2 = !bytes.empty() && bytes.front() == 'x';
    for (const std::vector<std::uint8_t>& picture : version2 ? version2Pictures(bytes) : version1Pictures(bytes)) {
      pictures.push_back(picture);
    }
  }
  return pictures;
}

std::string RecordingProxy::bytesFromDriver() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::accumulate(from_driver_.begin(), from_driver_.end(), std::string());
}

std::size_t RecordingProxy::connections() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return from_driver_.size();
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
    const std::vector<std::uint8_t> bytes(from_driver_[i].begin(), from_driver_[i].end());
    for (const Frame& frame : framesIn(bytes, protocol::BASIC_COMMAND_SIZE)) {
      if (kinds.find(frame.header.kind) != std::string::npos) {
        found.push_back({frame.header.kind, frame.header.id, frame.payload});
      }
    }
  }
  return found;
}

}  // namespace test_support
