/// @file recording_proxy.h
#ifndef AIBO_DRIVER_TEST_RECORDING_PROXY_H
#define AIBO_DRIVER_TEST_RECORDING_PROXY_H

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

namespace test_support {

/// A request of version 2 of the protocol.
struct Request {
  char kind = 0;
  int id = 0;  ///< quality of `F` and `W`
  std::vector<std::uint8_t> payload;
};

/// Stands between driver and robot on a free port, passes every byte on, and remembers it. One connection at a time.
class RecordingProxy {
 public:
  /// @param robot_port where the robot listens, on 127.0.0.1
  explicit RecordingProxy(int robot_port);
  ~RecordingProxy();

  RecordingProxy(const RecordingProxy&) = delete;
  RecordingProxy& operator=(const RecordingProxy&) = delete;

  int port() const { return port_; }

  /// Breaks the present connection, if there is one.
  void cut() { cut_ = true; }

  /// From now on the driver hears nothing from the robot, though connections stay and are accepted; or it does again.
  void setMute(bool mute) { mute_ = mute; }

  /// The JPEGs that the robot has sent since the proxy began, in this order.
  std::vector<std::vector<std::uint8_t>> picturesFromRobot() const;

  /// What the driver has sent since the proxy began.
  std::string bytesFromDriver() const;

  /// How many connections there have been.
  std::size_t connections() const;

  /// What the driver has requested of a version 2 server, in this order.
  /// @param kinds only requests of these kinds
  /// @param first_connection leave out the connections before this one; the first is 0
  std::vector<Request> requestsFromDriver(const std::string& kinds, std::size_t first_connection = 0) const;

  /// Waits until the driver has made a request of one of these kinds.
  /// @return false if it did not come in time
  bool waitForRequest(const std::string& kinds, std::chrono::seconds timeout);

 private:
  void run();
  void serve(int driver);
  std::vector<Request> requests(const std::string& kinds, std::size_t first_connection) const;

  const int robot_port_;
  int listener_ = -1;
  int port_ = 0;
  std::atomic<bool> stopping_{false};
  std::atomic<bool> cut_{false};
  std::atomic<bool> mute_{false};
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::vector<std::uint8_t>> from_robot_;  ///< one entry for each connection
  std::vector<std::string> from_driver_;               ///< likewise
  std::thread thread_;
};

}  // namespace test_support

#endif  // AIBO_DRIVER_TEST_RECORDING_PROXY_H
