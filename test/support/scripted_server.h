/// @file scripted_server.h
/// A server that does nothing by itself. The test accepts, reads, sends and closes step by step.
#ifndef TEST_SUPPORT_SCRIPTED_SERVER_H
#define TEST_SUPPORT_SCRIPTED_SERVER_H

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "host_files/file_descriptor.h"
#include "protocol/version1.h"
#include "support/raw_client.h"
#include "support/safety_net.h"
#include "support/sockets.h"
#include "support/test_pictures.h"
#include "support/version2_frames.h"

namespace test_support {

/// The server's end of one connection. Calls that wait throw std::runtime_error after a generous timeout.
class ScriptedPeer : public RawConnection {
 public:
  using RawConnection::RawConnection;

  /// Waits for the client's next command.
  protocol::BasicGetCommand readCommand() { return protocol::decodeCommand(read(protocol::BASIC_COMMAND_SIZE).data()); }

  /// Waits for the client's next frame (version 2 of the protocol).
  version2_frames::Frame readFrame() {
    const Bytes header = read(protocol::version2::FRAME_HEADER_SIZE);
    version2_frames::Frame frame = {protocol::version2::decodeFrameHeader(header.data()), {}};
    frame.payload = read(frame.header.payload_size);
    return frame;
  }

  /// Waits for the next frame that is not a heartbeat, and answers heartbeats.
  version2_frames::Frame readRequest() {
    const auto end = std::chrono::steady_clock::now() + kSafetyNet;
    while (std::chrono::steady_clock::now() < end) {
      version2_frames::Frame frame = readFrame();
      if (frame.header.kind != protocol::version2::REQUEST_HELLO) {
        return frame;
      }
      send(version2_frames::makeFrame('h', frame.header.request_number, version2_frames::makeHello()));
    }
    throw std::runtime_error("the client has sent nothing but heartbeats");
  }

  /// Agrees to version 2 of the protocol, and says hello. Then the client sets the camera.
  void agreeToVersion2(const std::string& capabilities = "F W J V T", const Bytes& report = {}) {
    const protocol::BasicGetCommand question = readCommand();
    if (question.command != protocol::REQUEST_NEWER_VERSION) {
      throw std::runtime_error("the client has not asked for version 2, but sent " + std::string(1, question.command));
    }
    send({'x', 2, 0, 0});
    const int number = readFrame().header.request_number;
    send(version2_frames::makeFrame('h', number, version2_frames::makeHello(capabilities)));
    send(report);
    for (int i = 0; i < protocol::version2::NUMBER_OF_CAMERA_SETTINGS; ++i) {
      const version2_frames::Frame setting = readFrame();
      camera_ += version2_frames::describe(setting) + ";";
      Bytes reply = version2_frames::makeFrame('g', setting.header.request_number, setting.payload);
      reply[1] = setting.header.id;
      send(reply);
    }
  }

  /// How the client has set the camera, as in "G 1 3;G 2 2;".
  const std::string& camera() const { return camera_; }

  /// Waits for this many bytes.
  Bytes read(std::size_t size) {
    const Bytes bytes = RawConnection::read(size, kSafetyNet);
    if (bytes.size() < size) {
      throw std::runtime_error("the client has sent nothing, or has closed the connection");
    }
    return bytes;
  }

  void send(const Bytes& bytes) {
    const std::size_t first = std::min<std::size_t>(bytes.size(), 3);  // goes alone, as part of a header
    const auto may_wait = [] { return true; };
    check(sendAll(socket_, bytes.data(), first, may_wait) &&
              sendAll(socket_, bytes.data() + first, bytes.size() - first, may_wait),
          "send");
  }

  /// Sends header and picture at once.
  void sendPicture(const Bytes& jpeg) { send(test_pictures::makeReply(jpeg)); }

  /// Waits until the client has closed the connection, and discards what it sends until then.
  void waitUntilClosed() {
    while (const std::optional<Bytes> part = receive(kSafetyNet)) {
      if (part->empty()) {
        return;
      }
    }
    throw std::runtime_error("the client has not closed the connection");
  }

 private:
  std::string camera_;
};

/// A server on a free port of 127.0.0.1.
class ScriptedServer {
 public:
  ScriptedServer() { listen(); }

  int port() const { return port_; }

  /// Begins to listen again.
  /// @param backlog one less than the number of clients that may wait for accept()
  void listen(int backlog = 16) { check(::listen(socket_.get(), backlog) == 0, "listen"); }

  /// Has the kernel take only few unread bytes from later clients.
  void limitReceiveBuffer() { setOption(socket_, SOL_SOCKET, SO_RCVBUF, 4096); }

  /// Stops listening; the port stays reserved, and connections are refused.
  void vanish() {
    socket_.close();
    socket_ = bindTo("127.0.0.1", port_, 0);
  }

  /// Waits for the next client.
  ScriptedPeer accept() {
    isReady(socket_, POLLIN, kSafetyNet);
    host_files::FileDescriptor client = acceptFrom(socket_);
    check(client.valid(), "no client has come");
    return ScriptedPeer(std::move(client));
  }

  /// True if a client comes within this time; its connection is closed.
  bool clientComesWithin(std::chrono::milliseconds time) {
    return isReady(socket_, POLLIN, time) && acceptFrom(socket_).valid();
  }

 private:
  host_files::FileDescriptor socket_ = bindTo("127.0.0.1", 0, 0);
  const int port_ = portOf(socket_);
};

}  // namespace test_support

#endif  // TEST_SUPPORT_SCRIPTED_SERVER_H
