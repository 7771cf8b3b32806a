/// @file raw_client.h
#ifndef TEST_SUPPORT_RAW_CLIENT_H
#define TEST_SUPPORT_RAW_CLIENT_H

#include <chrono>
#include <optional>
#include <string>

#include "client/file_descriptor.h"
#include "support/proxy/fault.h"

namespace test_support {

/// A client that does what no client does.
class RawClient {
 public:
  /// Connects to a port of 127.0.0.1. The kernel holds little for it, as for the driver.
  /// @throw std::system_error
  explicit RawClient(int port);

  /// Sends what the kernel takes now.
  /// @return false if the connection is over
  bool send(const std::string& bytes);

  /// Reads what is there, waiting for the first byte.
  /// @param most so many bytes at most
  /// @return nothing if none came in time; no bytes if the connection is over
  std::optional<Bytes> receive(std::chrono::milliseconds timeout, std::size_t most = 65536);

  /// Reads so many bytes.
  /// @return fewer if the connection is over, or if they did not come in time
  Bytes read(std::size_t size, std::chrono::milliseconds timeout);

  /// Ends the connection orderly.
  void close() { socket_.close(); }

  /// Ends the connection abruptly.
  void reset();

 private:
  aibo_driver::FileDescriptor socket_;
};

}  // namespace test_support

#endif  // TEST_SUPPORT_RAW_CLIENT_H
