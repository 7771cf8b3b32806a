/// @file raw_client.h
/// TCP clients of 127.0.0.1 that send and read exactly what a test asks for.
#ifndef TEST_SUPPORT_RAW_CLIENT_H
#define TEST_SUPPORT_RAW_CLIENT_H

#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "protocol/version1.h"
#include "protocol/version2.h"
#include "support/sockets.h"
#include "support/version2_frames.h"

namespace test_support {

using version2_frames::Frame;

/// One end of a connection. What is not read stays in the kernel.
class RawConnection {
 public:
  using milliseconds = std::chrono::milliseconds;

  explicit RawConnection(host_files::FileDescriptor socket) : socket_(std::move(socket)) {}

  /// Sends as much as the kernel takes now.
  /// @return bytes sent; below 0 if the connection has ended
  ssize_t send(const std::string& bytes) {
    const ssize_t sent = ::send(socket_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
    return sent < 0 && errno == EAGAIN ? 0 : sent;
  }

  /// Reads the bytes that are there, and waits for the first one.
  /// @param most most bytes to read
  /// @return nothing if none came in time; no bytes if the connection has ended
  std::optional<Bytes> receive(milliseconds timeout, std::size_t most = 65536) {
    if (!isReady(socket_, POLLIN, timeout)) {
      return std::nullopt;
    }
    Bytes bytes(most);
    const ssize_t count = ::recv(socket_.get(), bytes.data(), bytes.size(), 0);
    was_reset_ = was_reset_ || count < 0;
    bytes.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
    return bytes;
  }

  /// Reads this many bytes.
  /// @return fewer if the connection has ended, or if they did not come in time
  Bytes read(std::size_t size, milliseconds timeout) {
    Bytes bytes;
    for (std::optional<Bytes> part; bytes.size() < size && (part = receive(timeout, size - bytes.size()));) {
      if (part->empty()) {
        break;
      }
      bytes.insert(bytes.end(), part->begin(), part->end());
    }
    return bytes;
  }

  void close() { socket_.close(); }

  /// Closes so that the other end sees a reset.
  void reset() {
    resetWhenClosed(socket_);
    close();
  }

 protected:
  /// The socket's error since the last call; 0 if there is none.
  int error() const {
    int error = 0;
    socklen_t size = sizeof error;
    ::getsockopt(socket_.get(), SOL_SOCKET, SO_ERROR, &error, &size);
    return error;
  }

  host_files::FileDescriptor socket_;
  bool was_reset_ = false;
};

class RawClient : public RawConnection {
 public:
  /// @param buffer_size bytes that the kernel may hold for it in each direction; 0 = the kernel's default
  /// @param from this client's own address; Linux has all of 127.0.0.0/8
  /// @throw std::system_error if the server refuses
  explicit RawClient(int port, int buffer_size = kSmallBuffer, const std::string& from = "")
      : RawConnection(beginConnecting("127.0.0.1", port, buffer_size, from)) {
    isReady(socket_, POLLOUT, milliseconds(5000));
    errno = error();
    check(errno == 0 || errno == ECONNRESET, "connect");  // a reset may already have come
  }

  /// This client's own port.
  int port() const { return portOf(socket_); }
};

/// What a server sent in version 1: a picture or a reply of four bytes.
struct Reply {
  char letter = '\0';
  Bytes jpeg;                    ///< of a picture
  protocol::ValueReply value{};  ///< of any other reply
};

/// A client that never waits, for tests that run the server on the same thread. Each look at it reads everything.
class TestClient : public RawClient {
 public:
  /// @param receive_buffer and `from` as for RawClient
  explicit TestClient(int port, int receive_buffer = 0, const std::string& from = "")
      : RawClient(port, receive_buffer, from) {}

  /// All that has come so far, except what next(), nextFrame() and take() have returned.
  const std::string& received() {
    for (std::optional<Bytes> part; !ended_ && (part = receive(milliseconds(0)));) {
      received_.append(part->begin(), part->end());
      ended_ = part->empty();
    }
    return received_;
  }

  /// The next whole reply, if it is here already.
  std::optional<Reply> next() {
    const bool is_picture = !received().empty() && received_[0] == protocol::REPLY_PICTURE;
    const size_t header = is_picture ? protocol::PICTURE_HEADER_SIZE : protocol::VALUE_REPLY_SIZE;
    if (received_.size() < header) {
      return std::nullopt;
    }
    Reply reply;
    reply.letter = received_[0];
    size_t size = 0;
    if (!is_picture) {
      reply.value = protocol::decodeValueReply(bytes());
    } else if (!protocol::decodePictureHeader(bytes(), &size)) {
      throw std::runtime_error("a picture of " + std::to_string(size) + " bytes");
    }
    const Bytes whole = take(header + size);
    reply.jpeg.assign(whole.begin() + static_cast<std::ptrdiff_t>(std::min(header, whole.size())), whole.end());
    return whole.empty() ? std::nullopt : std::optional(reply);
  }

  /// The next `size` bytes; nothing unless they are all here.
  Bytes take(size_t size) {
    if (received().size() < size) {
      return {};
    }
    const Bytes taken(bytes(), bytes() + size);
    received_.erase(0, size);
    return taken;
  }

  /// The next frame of version 2, if it has arrived completely.
  std::optional<Frame> nextFrame() {
    using protocol::version2::FRAME_HEADER_SIZE;
    if (received().size() < FRAME_HEADER_SIZE) {
      return std::nullopt;
    }
    const Bytes frame = take(FRAME_HEADER_SIZE + protocol::version2::decodeFrameHeader(bytes()).payload_size);
    return frame.empty() ? std::nullopt : std::optional(version2_frames::split(frame));
  }

  /// True if the server has closed or reset the connection; next() may still find what it sent before.
  bool ended() {
    received();
    return ended_;
  }

  /// True if the server has closed the connection in an orderly way, so that all it sent is here.
  bool isAtEnd() { return ended() && !was_reset_; }

  /// True if the server has reset the connection, which loses what was on its way.
  bool wasReset() {
    received();
    return was_reset_ || error() != 0;  // from a reset after an orderly end
  }

 private:
  const uint8_t* bytes() const { return reinterpret_cast<const uint8_t*>(received_.data()); }

  std::string received_;
  bool ended_ = false;
};

}  // namespace test_support

#endif  // TEST_SUPPORT_RAW_CLIENT_H
