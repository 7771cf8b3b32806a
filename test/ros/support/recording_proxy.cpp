#include "recording_proxy.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <stdexcept>

#include "protocol/version1.h"

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
          from_driver_.append(buffer.begin(), buffer.begin() + count);
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
    std::size_t position = 0;
    std::size_t size = 0;
    while (position + protocol::PICTURE_HEADER_SIZE <= bytes.size() &&
           protocol::decodePictureHeader(bytes.data() + position, &size) &&
           position + protocol::PICTURE_HEADER_SIZE + size <= bytes.size()) {
      const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(position + protocol::PICTURE_HEADER_SIZE);
      pictures.emplace_back(begin, begin + static_cast<std::ptrdiff_t>(size));
      position += protocol::PICTURE_HEADER_SIZE + size;
    }
  }
  return pictures;
}

std::string RecordingProxy::bytesFromDriver() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return from_driver_;
}

bool RecordingProxy::waitForDriver(const std::string& text, std::chrono::seconds timeout) {
  std::unique_lock<std::mutex> lock(mutex_);
  return changed_.wait_for(lock, timeout, [&] { return from_driver_.find(text) != std::string::npos; });
}

}  // namespace test_support
