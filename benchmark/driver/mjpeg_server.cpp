#include "driver/mjpeg_server.h"

#include <poll.h>
#include <sys/socket.h>

#include <string>
#include <utility>

#include "support/sockets.h"
#include "support/test_pictures.h"

namespace driver_benchmark {
namespace {

using test_pictures::Bytes;

constexpr std::size_t kRemembered = 4096;
constexpr int kStopCheck = 100;  // ms

bool sendAll(const host_files::FileDescriptor& client, const std::string& bytes) {
  const auto* const begin = reinterpret_cast<const std::uint8_t*>(bytes.data());
  return test_support::sendAll(client, begin, bytes.size(), [] { return true; });
}

// Waits for the end of the client's request.
void receiveRequest(const host_files::FileDescriptor& client) {
  std::string request;
  pollfd polled{client.get(), POLLIN, 0};
  while (request.find("\r\n\r\n") == std::string::npos && ::poll(&polled, 1, 10 * kStopCheck) > 0) {
    char buffer[1024];
    const ssize_t size = ::recv(client.get(), buffer, sizeof buffer, 0);
    if (size <= 0) {
      return;
    }
    request.append(buffer, static_cast<std::size_t>(size));
  }
}

std::string partOf(const Bytes& jpeg) {
  std::string part =
      "--picture\r\nContent-Type: image/jpeg\r\nContent-Length: " + std::to_string(jpeg.size()) + "\r\n\r\n";
  part.append(jpeg.begin(), jpeg.end());
  return part + "\r\n";
}

}  // namespace

MjpegServer::MjpegServer(std::chrono::microseconds period)
    : period_(period), listener_(test_support::bindTo("127.0.0.1", 0)), times_(kRemembered) {
  test_support::check(::listen(listener_.get(), 4) == 0, "listening");
  port_ = test_support::portOf(listener_);
  thread_ = std::thread([this] { accept(); });
}

MjpegServer::~MjpegServer() {
  stopping_ = true;
  thread_.join();
}

MjpegServer::TimePoint MjpegServer::timeOf(std::uint64_t number) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return times_[number % kRemembered];
}

void MjpegServer::accept() {
  while (!stopping_) {
    pollfd polled{listener_.get(), POLLIN, 0};
    if (::poll(&polled, 1, kStopCheck) > 0) {
      clients_.emplace_back([this, client = test_support::acceptFrom(listener_)] { serve(client); });
    }
  }
  for (std::thread& client : clients_) {
    client.join();
  }
}

void MjpegServer::serve(const host_files::FileDescriptor& client) {
  receiveRequest(client);
  bool there = sendAll(client, "HTTP/1.0 200 OK\r\nContent-Type: multipart/x-mixed-replace; boundary=picture\r\n\r\n");
  TimePoint next = std::chrono::steady_clock::now();
  while (there && !stopping_) {
    std::this_thread::sleep_until(next);
    next += period_;
    const std::uint64_t number = number_ + 1;
    const std::string part = partOf(test_pictures::makeNamed({1, number}));
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      times_[number % kRemembered] = std::chrono::steady_clock::now();
    }
    number_ = number;
    there = sendAll(client, part);
  }
}

}  // namespace driver_benchmark
