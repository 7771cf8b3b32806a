/// @file scanner.h
#ifndef TEST_SUPPORT_PROXY_SCANNER_H
#define TEST_SUPPORT_PROXY_SCANNER_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "protocol/version1.h"
#include "protocol/version2.h"
#include "support/proxy/faults.h"
#include "support/sockets.h"

namespace test_support {

/// A request, reply or push of either version of the protocol.
struct Message {
  char kind = 0;
  int id = 0;       ///< quality of `F` and `W`
  int number = 0;   ///< of the request; 0 in version 1
  Bytes payload{};  ///< of a picture: its JPEG
  bool version2 = false;
};

/// Finds the messages in one direction of a connection, however TCP has cut them. A client's requests of version 1 are
/// commands of two bytes.
class Scanner {
 public:
  /// @param knows_version2 whether the server agrees to version 2
  explicit Scanner(Direction direction, bool knows_version2 = true)
      : is_server_(direction == Direction::kToClient), knows_version2_(knows_version2) {}

  /// Takes the stream's next byte.
  /// @return the message that it completes
  std::optional<Message> take(std::uint8_t byte) {
    if (bytes_.size() == size_) {
      bytes_.clear();
      size_ = 0;
    }
    bytes_.push_back(byte);
    if (bytes_.size() == headerSize()) {
      size_ = headerSize() + payloadSize();
    }
    return bytes_.size() == size_ && !is_lost_ ? std::optional(message()) : std::nullopt;
  }

  /// The index of the last byte in its picture, counted from the header; nothing if it is not of a picture.
  std::optional<std::size_t> indexInPicture() const {
    return is_lost_ || !isPicture() ? std::nullopt : std::optional(bytes_.size() - 1);
  }

 private:
  bool isPicture() const {
    return is_server_ && !bytes_.empty() && static_cast<char>(bytes_.front()) == protocol::REPLY_PICTURE;
  }

  std::size_t headerSize() const {
    return version2_     ? protocol::version2::FRAME_HEADER_SIZE
           : !is_server_ ? protocol::BASIC_COMMAND_SIZE
           : isPicture() ? protocol::PICTURE_HEADER_SIZE
                         : protocol::VALUE_REPLY_SIZE;
  }

  std::size_t payloadSize() {
    std::size_t size = 0;
    if (version2_) {
      size = protocol::version2::decodeFrameHeader(bytes_.data()).payload_size;
    } else if (isPicture()) {
      is_lost_ = !protocol::decodePictureHeader(bytes_.data(), &size);
    } else {
      is_lost_ = is_server_ && !protocol::isValueReply(static_cast<char>(bytes_.front()));
    }
    return size;
  }

  Message message() {
    const bool has_image_header = version2_ && isPicture();
    const std::size_t skipped =
        headerSize() + (has_image_header ? std::size_t{protocol::version2::IMAGE_HEADER_SIZE} : 0);
    Message message{static_cast<char>(bytes_[0]), bytes_[1], 0, {}, version2_};
    message.payload.assign(bytes_.begin() + static_cast<std::ptrdiff_t>(std::min(skipped, size_)), bytes_.end());
    if (version2_) {
      message.number = protocol::version2::decodeFrameHeader(bytes_.data()).request_number;
    } else if (is_server_) {
      version2_ = !isPicture() && protocol::version2::agreesToVersion2(protocol::decodeValueReply(bytes_.data()));
    } else {
      version2_ = knows_version2_ && message.kind == protocol::REQUEST_NEWER_VERSION;
    }
    return message;
  }

  const bool is_server_;
  const bool knows_version2_;
  bool version2_ = false;
  bool is_lost_ = false;  // something that is not a reply has come: the next one cannot be found
  Bytes bytes_;           // of the message, as far as it has come
  std::size_t size_ = 0;  // of the whole message; 0 until its header has come
};

}  // namespace test_support

#endif  // TEST_SUPPORT_PROXY_SCANNER_H
