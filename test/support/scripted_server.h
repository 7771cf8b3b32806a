/// @file scripted_server.h
/// A server for tests: it does nothing by itself. The test accepts, reads, sends and closes, step by step.
#ifndef TEST_SUPPORT_SCRIPTED_SERVER_H
#define TEST_SUPPORT_SCRIPTED_SERVER_H

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "client/file_descriptor.h"
#include "protocol/version1.h"
#include "support/version2_frames.h"

/// The server's end of one connection. Calls that wait throw std::runtime_error after a generous time.
class ScriptedPeer {
 public:
  using Bytes = std::vector<std::uint8_t>;

  explicit ScriptedPeer(aibo_driver::FileDescriptor socket) : socket_(std::move(socket)) {}

  /// Waits for the client's next command.
  protocol::BasicGetCommand readCommand();

  /// The client's next command if it comes within this time; nothing if it does not.
  std::optional<protocol::BasicGetCommand> readCommandWithin(std::chrono::milliseconds time);

  /// Waits for the client's next frame (version 2 of the protocol).
  version2_frames::Frame readFrame();

  /// Waits for the next frame that is no heartbeat, and answers heartbeats.
  version2_frames::Frame readRequest();

  /// Agrees to version 2 of the protocol, and says hello.
  void agreeToVersion2(const std::string& capabilities = "F W J V T O");

  /// Waits for so many bytes.
  Bytes read(std::size_t size);

  void send(const Bytes& bytes);

  /// Header and picture at once.
  void sendPicture(const Bytes& jpeg);

  /// The connection ends orderly (FIN).
  void close() { socket_.close(); }

  /// The connection ends abruptly (RST).
  void reset();

  /// Waits until the client has closed the connection, and throws away what it sends until then.
  void waitUntilClosed();

 private:
  aibo_driver::FileDescriptor socket_;
};

/// Owns a free port of 127.0.0.1.
class ScriptedServer {
 public:
  enum class Begin { kListening, kAbsent };

  /// @param begin kAbsent: the port is reserved, but who connects to it is refused
  explicit ScriptedServer(Begin begin = Begin::kListening);

  int port() const { return port_; }

  /// The server appears. Does nothing if it is there.
  /// @param backlog how many clients may wait for accept(), less one
  void listen(int backlog = 16);

  /// The kernel takes few bytes from clients that come from now on, as long as nobody reads them.
  void limitReceiveBuffer();

  /// The server goes away; its port stays reserved.
  void vanish();

  /// Waits for the next client.
  ScriptedPeer accept();

  /// True if a client comes within this time; it is let go.
  bool clientComesWithin(std::chrono::milliseconds time);

 private:
  void bind();

  aibo_driver::FileDescriptor socket_;
  int port_ = 0;
  bool listening_ = false;
};

#endif  // TEST_SUPPORT_SCRIPTED_SERVER_H
