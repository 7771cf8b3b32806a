#include "wlan/plain_stream.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "host_files/file_descriptor.h"
#include "radio/network_host.h"
#include "radio/radio_link.h"

namespace wlan_benchmark {
namespace {

using fault_bench::NetworkHost;
using host_files::FileDescriptor;
using std::chrono::steady_clock;

constexpr char kRobotAddress[] = "10.77.0.1";
constexpr char kComputerAddress[] = "10.77.0.2";
constexpr std::uint16_t kPort = 54321;
/// Like the pictures of the simulated robot at quality 85.
constexpr std::size_t kPictureSize = 5900;
constexpr std::chrono::microseconds kPeriod{33333};

[[noreturn]] void throwError(const std::string& what) {
  throw std::system_error(errno, std::generic_category(), what);
}

sockaddr_in robotAddress() {
  sockaddr_in address = {};
  address.sin_family = AF_INET;
  address.sin_port = htons(kPort);
  ::inet_pton(AF_INET, kRobotAddress, &address.sin_addr);
  return address;
}

FileDescriptor openSocket() {
  FileDescriptor socket(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  if (!socket.valid()) {
    throwError("socket");
  }
  const int on = 1;
  ::setsockopt(socket.get(), IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  return socket;
}

/// A server for one client. It begins to send each picture when it is due, or when the previous pictures have been
/// sent.
class Server {
 public:
  explicit Server(const NetworkHost& host) {
    std::thread([&] {
      host.enter();
      listener_ = openSocket();
      const sockaddr_in address = robotAddress();
      if (::bind(listener_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
          ::listen(listener_.get(), 1) != 0) {
        problem_ = errno;
      }
    }).join();
    if (problem_ != 0) {
      errno = problem_;
      throwError("the server's port");
    }
    thread_ = std::thread([this] { run(); });
  }
  ~Server() {
    stopping_ = true;
    ::shutdown(listener_.get(), SHUT_RDWR);
    thread_.join();
  }

  Server(const Server&) = delete;
  Server& operator=(const Server&) = delete;

 private:
  void run() {
    const FileDescriptor client(::accept4(listener_.get(), nullptr, nullptr, SOCK_CLOEXEC));
    const timeval patience = {0, 10000};  // until it checks whether it has to stop
    ::setsockopt(client.get(), SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
    std::vector<std::uint8_t> picture(kPictureSize);
    for (auto due = steady_clock::now(); client.valid(); due += kPeriod) {
      std::this_thread::sleep_until(due);
      const std::int64_t taken = due.time_since_epoch().count();
      std::memcpy(picture.data(), &taken, sizeof taken);
      if (!sendAll(client.get(), picture)) {
        return;
      }
    }
  }

  /// @return false if the connection has ended, or the server has to stop
  bool sendAll(int socket, const std::vector<std::uint8_t>& bytes) const {
    std::size_t sent = 0;
    while (sent < bytes.size()) {
      const ssize_t count = ::send(socket, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
      if (stopping_ || (count < 0 && errno != EAGAIN && errno != EINTR)) {
        return false;
      }
      sent += static_cast<std::size_t>(std::max<ssize_t>(count, 0));
    }
    return true;
  }

  FileDescriptor listener_;
  std::atomic<bool> stopping_{false};
  int problem_ = 0;
  std::thread thread_;
};

/// Reads pictures until the end.
std::vector<fault_bench::Result::Delivery> read(int socket, steady_clock::time_point begin,
                                                steady_clock::time_point end) {
  std::vector<fault_bench::Result::Delivery> deliveries;
  std::vector<std::uint8_t> picture(kPictureSize);
  std::size_t received = 0;
  while (steady_clock::now() < end) {
    const ssize_t count = ::recv(socket, picture.data() + received, picture.size() - received, 0);
    if (count < 0 && (errno == EAGAIN || errno == EINTR)) {
      continue;
    }
    if (count <= 0) {
      break;
    }
    received += static_cast<std::size_t>(count);
    if (received == picture.size()) {
      const auto now = steady_clock::now();
      std::int64_t taken = 0;
      std::memcpy(&taken, picture.data(), sizeof taken);
      const steady_clock::duration age = now.time_since_epoch() - steady_clock::duration(taken);
      deliveries.push_back(
          {std::chrono::duration<double>(now - begin).count(), std::chrono::duration<double, std::milli>(age).count()});
      received = 0;
    }
  }
  return deliveries;
}

}  // namespace

fault_bench::Result runPlainStream(const fault_bench::Trial& trial) {
  const NetworkHost robot(kRobotAddress);
  const NetworkHost computer(kComputerAddress);
  const Server server(robot);
  fault_bench::Result result;
  std::thread([&] {
    computer.enter();
    const fault_bench::RadioLink link(robot, computer, trial.radio);
    const FileDescriptor socket = openSocket();
    const timeval patience = {0, 10000};
    ::setsockopt(socket.get(), SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    const sockaddr_in address = robotAddress();
    if (::connect(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) {
      result.deliveries = read(socket.get(), link.begin(), link.begin() + trial.length);
    }
  }).join();
  fault_bench::summarize(trial, result);
  return result;
}

}  // namespace wlan_benchmark
