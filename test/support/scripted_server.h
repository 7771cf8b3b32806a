/// @file scripted_server.h
/// A server that does nothing by itself. The test accepts, reads, sends and closes step by step.
#ifndef TEST_SUPPORT_SCRIPTED_SERVER_H
#define TEST_SUPPORT_SCRIPTED_SERVER_H

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "host_files/file_descriptor.h"
#include "protocol/version1.h"
#include "support/version2_frames.h"

namespace test_support {

/// The server's end of one connection. Calls that wait throw std::runtime_error after a generous timeout.
class ScriptedPeer {
 public:
  using Bytes = std::vector<std::uint8_t>;

  explicit ScriptedPeer(host_files::FileDescriptor socket) : socket_(std::move(socket)) {}

  /// Waits for the client's next command.
  protocol::BasicGetCommand readCommand();

  /// Waits for the client's next frame (version 2 of the protocol).
  version2_frames::Frame readFrame();

  /// Waits for the next frame that is not a heartbeat, and answers heartbeats.
  version2_frames::Frame readRequest();

  /// Agrees to version 2 of the protocol, and says hello. Then the client sets the camera.
  void agreeToVersion2(const std::string& capabilities = "F W J V T");

  /// How the client has set the camera, as in "G 1 3;G 2 2;".
  const std::string& camera() const { return camera_; }

  /// Waits for this many bytes.
  Bytes read(std::size_t size);

  void send(const Bytes& bytes);

  /// Sends header and picture at once.
  void sendPicture(const Bytes& jpeg);

  /// Closes the connection (FIN).
  void close() { socket_.close(); }

  /// Resets the connection (RST).
  void reset();

  /// Waits until the client has closed the connection, and discards what it sends until then.
  void waitUntilClosed();

 private:
  host_files::FileDescriptor socket_;
  std::string camera_;
};

/// A server on a free port of 127.0.0.1.
class ScriptedServer {
 public:
  enum class Begin { kListening, kAbsent };

  /// @param begin kAbsent: the port is reserved, but connections are refused
  explicit ScriptedServer(Begin begin = Begin::kListening);

  int port() const { return port_; }

  /// Begins to listen, unless it already does.
  /// @param backlog one less than the number of clients that may wait for accept()
  void listen(int backlog = 16);

  /// Has the kernel take only few unread bytes from later clients.
  void limitReceiveBuffer();

  /// Stops listening; the port stays reserved.
  void vanish();

  /// Waits for the next client.
  ScriptedPeer accept();

  /// True if a client comes within this time; its connection is closed.
  bool clientComesWithin(std::chrono::milliseconds time);

 private:
  void bind();

  host_files::FileDescriptor socket_;
  int port_ = 0;
  bool listening_ = false;
};

}  // namespace test_support

#endif  // TEST_SUPPORT_SCRIPTED_SERVER_H
