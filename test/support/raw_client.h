/// @file raw_client.h
#ifndef TEST_SUPPORT_RAW_CLIENT_H
#define TEST_SUPPORT_RAW_CLIENT_H

#include <chrono>
#include <optional>
#include <string>

#include "client/file_descriptor.h"
#include "support/proxy/fault.h"

namespace test_support {

/// A client that sends and reads exactly what a test asks for. What it does not read stays in the kernel; see
/// TestClient for one that always reads everything.
class RawClient {
 public:
  /// Connects to a port of 127.0.0.1, with small buffers, like the driver.
  /// @throw std::system_error
  explicit RawClient(int port);

  /// Sends as much as the kernel takes now.
  /// @return false if the connection has ended
  bool send(const std::string& bytes);

  /// Reads the bytes that are there, and waits for the first one.
  /// @param most most bytes to read
  /// @return nothing if none came in time; no bytes if the connection has ended
  std::optional<Bytes> receive(std::chrono::milliseconds timeout, std::size_t most = 65536);

  /// Reads this many bytes.
  /// @return fewer if the connection has ended, or if they did not come in time
  Bytes read(std::size_t size, std::chrono::milliseconds timeout);

  /// Closes the connection (FIN).
  void close() { socket_.close(); }

  /// Resets the connection (RST).
  void reset();

 private:
  aibo_client::FileDescriptor socket_;
};

}  // namespace test_support

#endif  // TEST_SUPPORT_RAW_CLIENT_H
