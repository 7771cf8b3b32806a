/// @file mjpeg_server.h
#ifndef BENCHMARK_DRIVER_MJPEG_SERVER_H
#define BENCHMARK_DRIVER_MJPEG_SERVER_H

#include <atomic>
#include <chrono>
#include <cstdint>
#include <list>
#include <mutex>
#include <thread>
#include <vector>

#include "host_files/file_descriptor.h"

namespace driver_benchmark {

/// A camera as other drivers know it: an HTTP server on 127.0.0.1 that sends JPEGs, each as a part of one endless reply
/// (multipart/x-mixed-replace). Pictures are numbered (test_pictures::makeNamed) over all clients.
///
/// Every function may be called from any thread.
class MjpegServer {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;

  /// @param period from one picture to the next
  explicit MjpegServer(std::chrono::microseconds period);
  ~MjpegServer();

  MjpegServer(const MjpegServer&) = delete;
  MjpegServer& operator=(const MjpegServer&) = delete;

  int port() const { return port_; }

  /// Number of the picture that was sent last.
  std::uint64_t lastNumber() const { return number_; }

  /// When a picture was sent. Only the last 4096 pictures are known.
  TimePoint timeOf(std::uint64_t number) const;

 private:
  void accept();
  void serve(const host_files::FileDescriptor& client);

  const std::chrono::microseconds period_;
  host_files::FileDescriptor listener_;
  int port_ = 0;
  std::atomic<std::uint64_t> number_{0};
  std::atomic<bool> stopping_{false};
  mutable std::mutex mutex_;  // guards the times
  std::vector<TimePoint> times_;
  std::list<std::thread> clients_;  // used by the accepting thread alone
  std::thread thread_;
};

}  // namespace driver_benchmark

#endif  // BENCHMARK_DRIVER_MJPEG_SERVER_H
