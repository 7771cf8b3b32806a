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

inline bool isReadableWithin(int descriptor, std::chrono::milliseconds time) {
  pollfd polled = {descriptor, POLLIN, 0};
  const int count = ::poll(&polled, 1, static_cast<int>(time.count()));
  check(count >= 0, "poll");
  return count > 0;
}

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
      camera_ += version2_frames::textOf(setting) + ";";
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
    std::size_t sent = 0;
    while (sent < bytes.size()) {
      // The beginning goes alone, as part of a header.
      const std::size_t part = sent == 0 ? std::min<std::size_t>(bytes.size(), 3) : bytes.size() - sent;
      const ssize_t count = ::send(socket_.get(), bytes.data() + sent, part, MSG_NOSIGNAL);
      check(count >= 0, "send");
      sent += static_cast<std::size_t>(count);
    }
  }

  /// Sends header and picture at once.
  void sendPicture(const Bytes& jpeg) { send(test_pictures::makeReply(jpeg)); }

  /// Waits until the client has closed the connection, and discards what it sends until then.
  void waitUntilClosed() {
    std::optional<Bytes> part;
    while ((part = receive(kSafetyNet)) && !part->empty()) {
    }
    if (!part) {
      throw std::runtime_error("the client has not closed the connection");
    }
  }

 private:
  std::string camera_;
};

/// A server on a free port of 127.0.0.1.
class ScriptedServer {
 public:
  enum class Begin { kListening, kAbsent };

  /// @param begin kAbsent: the port is reserved, but connections are refused
  explicit ScriptedServer(Begin begin = Begin::kListening) {
    bind();
    if (begin == Begin::kListening) {
      listen();
    }
  }

  int port() const { return port_; }

  /// Begins to listen, unless it already does.
  /// @param backlog one less than the number of clients that may wait for accept()
  void listen(int backlog = 16) {
    if (!std::exchange(listening_, true)) {
      check(::listen(socket_.get(), backlog) == 0, "listen");
    }
  }

  /// Has the kernel take only few unread bytes from later clients.
  void limitReceiveBuffer() { setOption(socket_, SOL_SOCKET, SO_RCVBUF, 4096); }

  /// Stops listening; the port stays reserved.
  void vanish() {
    socket_.close();
    listening_ = false;
    bind();
  }

  /// Waits for the next client.
  ScriptedPeer accept() {
    if (!isReadableWithin(socket_.get(), kSafetyNet)) {
      throw std::runtime_error("no client has come");
    }
    host_files::FileDescriptor socket(::accept4(socket_.get(), nullptr, nullptr, SOCK_CLOEXEC));
    check(socket.valid(), "accept");
    return ScriptedPeer(std::move(socket));
  }

  /// True if a client comes within this time; its connection is closed.
  bool clientComesWithin(std::chrono::milliseconds time) {
    if (!isReadableWithin(socket_.get(), time)) {
      return false;
    }
    accept();
    return true;
  }

 private:
  void bind() {
    socket_ = makeSocket(0);
    bindSocket(socket_, "127.0.0.1", port_);
    port_ = portOf(socket_);
  }

  host_files::FileDescriptor socket_;
  int port_ = 0;
  bool listening_ = false;
};

}  // namespace test_support

#endif  // TEST_SUPPORT_SCRIPTED_SERVER_H
