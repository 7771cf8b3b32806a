/// @file test_client.h
/// A TCP client that never waits, for tests that run the server on the same thread.
#ifndef TEST_SUPPORT_TEST_CLIENT_H
#define TEST_SUPPORT_TEST_CLIENT_H

#include <arpa/inet.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "host_files/file_descriptor.h"
#include "protocol/version1.h"
#include "protocol/version2.h"

namespace test_support {

/// What a server sent in version 1: a picture or a reply of four bytes.
struct Reply {
  char letter = '\0';
  std::vector<uint8_t> jpeg;     ///< of a picture
  protocol::ValueReply value{};  ///< of any other reply
};

/// A frame that a server sent in version 2.
struct Frame {
  protocol::version2::FrameHeader header{};
  std::vector<uint8_t> payload;
};

/// Each look at this client reads everything from the kernel; RawClient leaves bytes there.
class TestClient {
 public:
  /// @param receive_buffer bytes that the kernel may hold for this client; 0 = the kernel's default
  /// @param from this client's own address; Linux has all of 127.0.0.0/8
  /// @throw std::system_error if the server refuses
  explicit TestClient(uint16_t port, int receive_buffer = 0, const char* from = "127.0.0.1")
      : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    if (receive_buffer > 0) {
      setOption(SOL_SOCKET, SO_RCVBUF, receive_buffer);
    }
    setOption(IPPROTO_TCP, TCP_NODELAY, 1);  // a request must not wait for the acknowledgement of the one before it
    sockaddr_in address{};
    address.sin_family = AF_INET;
    ::inet_pton(AF_INET, from, &address.sin_addr);
    ::bind(socket_.get(), reinterpret_cast<sockaddr*>(&address), sizeof(address));
    address.sin_port = htons(port);
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    // The kernel connects by itself as long as there is room in the listener's backlog.
    if (::connect(socket_.get(), reinterpret_cast<sockaddr*>(&address), sizeof(address)) != 0) {
      throw std::system_error(errno, std::generic_category(), "connect");
    }
  }

  /// This client's own port.
  uint16_t port() const {
    sockaddr_in address{};
    socklen_t size = sizeof(address);
    ::getsockname(socket_.get(), reinterpret_cast<sockaddr*>(&address), &size);
    return ntohs(address.sin_port);
  }

  /// Sends as much as the kernel takes now.
  /// @return bytes sent
  size_t send(const std::string& bytes) {
    const ssize_t sent = ::send(socket_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    return sent > 0 ? static_cast<size_t>(sent) : 0;
  }

  /// All that has come so far, except what next(), nextFrame() and take() have returned.
  const std::string& received() {
    receive();
    return received_;
  }

  /// The next whole reply, if it is here already.
  std::optional<Reply> next() {
    receive();
    const bool is_picture = !received_.empty() && received_[0] == protocol::REPLY_PICTURE;
    const size_t header = is_picture ? protocol::PICTURE_HEADER_SIZE : protocol::VALUE_REPLY_SIZE;
    if (received_.size() < header) {
      return std::nullopt;
    }
    size_t size = 0;
    if (is_picture && !protocol::decodePictureHeader(bytes(), &size)) {
      throw std::runtime_error("a picture of " + std::to_string(size) + " bytes");
    }
    if (received_.size() < header + size) {
      return std::nullopt;
    }
    Reply reply;
    reply.letter = received_[0];
    if (!is_picture) {
      reply.value = protocol::decodeValueReply(bytes());
    }
    consume(header);
    reply.jpeg = consume(size);
    return reply;
  }

  /// The next `size` bytes; nothing unless they are all here.
  std::vector<uint8_t> take(size_t size) {
    receive();
    return received_.size() < size ? std::vector<uint8_t>() : consume(size);
  }

  /// The next frame of version 2, if it has arrived completely.
  std::optional<Frame> nextFrame() {
    using protocol::version2::FRAME_HEADER_SIZE;
    receive();
    if (received_.size() < FRAME_HEADER_SIZE) {
      return std::nullopt;
    }
    Frame frame;
    frame.header = protocol::version2::decodeFrameHeader(bytes());
    if (received_.size() < FRAME_HEADER_SIZE + frame.header.payload_size) {
      return std::nullopt;
    }
    consume(FRAME_HEADER_SIZE);
    frame.payload = consume(frame.header.payload_size);
    return frame;
  }

  /// True if the server has closed or reset the connection; next() may still find what it sent before.
  bool ended() {
    receive();
    return ended_;
  }

  /// True if the server has closed the connection in an orderly way, so that all it sent is here.
  bool isAtEnd() { return ended() && !was_reset_; }

  /// True if the server has reset the connection, which loses what was on its way.
  bool wasReset() {
    receive();
    int error = 0;  // from a reset after an orderly end
    socklen_t size = sizeof(error);
    ::getsockopt(socket_.get(), SOL_SOCKET, SO_ERROR, &error, &size);
    return was_reset_ || error != 0;
  }

  void close() { socket_.close(); }

  /// Closes so that the server sees a reset.
  void reset() {
    const linger abort{1, 0};
    ::setsockopt(socket_.get(), SOL_SOCKET, SO_LINGER, &abort, sizeof(abort));
    close();
  }

 private:
  void setOption(int level, int name, int value) { ::setsockopt(socket_.get(), level, name, &value, sizeof(value)); }

  void receive() {
    char bytes[65536];
    while (!ended_) {
      const ssize_t size = ::recv(socket_.get(), bytes, sizeof(bytes), MSG_DONTWAIT);
      if (size > 0) {
        received_.append(bytes, static_cast<size_t>(size));
      } else if (size < 0 && (errno == EAGAIN || errno == EINTR)) {
        return;
      } else {
        ended_ = true;
        was_reset_ = size < 0;
      }
    }
  }

  const uint8_t* bytes() const { return reinterpret_cast<const uint8_t*>(received_.data()); }

  std::vector<uint8_t> consume(size_t size) {
    std::vector<uint8_t> taken(bytes(), bytes() + size);
    received_.erase(0, size);
    return taken;
  }

  host_files::FileDescriptor socket_;
  std::string received_;
  bool ended_ = false;
  bool was_reset_ = false;
};

}  // namespace test_support

#endif  // TEST_SUPPORT_TEST_CLIENT_H
