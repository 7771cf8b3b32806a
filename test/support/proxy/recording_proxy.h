/// @file recording_proxy.h
#ifndef TEST_SUPPORT_PROXY_RECORDING_PROXY_H
#define TEST_SUPPORT_PROXY_RECORDING_PROXY_H

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <vector>

#include "support/proxy/fault_proxy.h"

namespace test_support {

/// A request of version 2 of the protocol.
struct Request {
  char kind = 0;
  int id = 0;  ///< quality of `F` and `W`
  fault_bench::Bytes payload;
};

/// Stands between driver and robot on a free port, passes every byte on, and remembers it.
class RecordingProxy {
 public:
  /// @param robot_port where the robot listens, on 127.0.0.1
  explicit RecordingProxy(int robot_port);

  int port() const { return proxy_.port(); }

  /// Ends the present connection, if there is one.
  void cut() { proxy_.endConnections(fault_bench::Action::kClose); }

  /// From now on the driver hears nothing from the robot, though connections stay and are accepted; or it does again.
  void setMute(bool mute);

  /// The JPEGs that the robot has sent since the proxy began, in this order.
  std::vector<fault_bench::Bytes> picturesFromRobot() const;

  /// What the driver has sent since the proxy began.
  std::string bytesFromDriver() const;

  /// How many connections there have been.
  std::size_t connections() const { return proxy_.connections(); }

  /// What the driver has requested of a version 2 server, in this order.
  /// @param kinds only requests of these kinds
  /// @param first_connection leave out the connections before this one; the first is 0
  std::vector<Request> requestsFromDriver(const std::string& kinds, std::size_t first_connection = 0) const;

  /// Waits until the driver has made a request of one of these kinds.
  /// @return false if it did not come in time
  bool waitForRequest(const std::string& kinds, std::chrono::seconds timeout);

 private:
  fault_bench::FaultProxy::Options options(int robot_port);
  void record(std::size_t connection, fault_bench::Direction direction, const std::uint8_t* data, std::size_t size);
  std::vector<Request> requests(const std::string& kinds, std::size_t first_connection) const;

  mutable std::mutex mutex_;  // guards what follows, down to the proxy
  std::condition_variable changed_;
  std::vector<fault_bench::Bytes> from_robot_;   ///< one entry for each connection
  std::vector<fault_bench::Bytes> from_driver_;  ///< likewise
  fault_bench::FaultProxy proxy_;
};

}  // namespace test_support

#endif  // TEST_SUPPORT_PROXY_RECORDING_PROXY_H
