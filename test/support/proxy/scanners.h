/// @file scanners.h
/// What goes over a connection between a client and a server, however TCP has cut it.
#ifndef TEST_SUPPORT_PROXY_SCANNERS_H
#define TEST_SUPPORT_PROXY_SCANNERS_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "protocol/frame_reader.h"
#include "protocol/version1.h"
#include "protocol/version2.h"
#include "support/sockets.h"

namespace test_support {

/// Called with a whole reply or push; the payload of a picture is its JPEG.
using OnReply = std::function<void(char kind, const Bytes& payload)>;

/// Finds pictures and other replies in what a server sends over one connection, in either version of the protocol.
class ReplyScanner {
 public:
  explicit ReplyScanner(OnReply on_reply = nullptr) : on_reply_(std::move(on_reply)) {}

  /// Takes the stream's next byte.
  void take(std::uint8_t byte) {
    if (reply_.size() == size_) {
      reply_.clear();
      size_ = 0;
    }
    reply_.push_back(byte);
    if (reply_.size() == headerSize()) {
      size_ = reply_.size() + payloadSize();
    }
    if (reply_.size() == size_ && !is_lost_) {
      tell();
    }
  }

  /// The index of the last byte in its picture, counted from the header; nothing if it is not of a picture.
  std::optional<std::size_t> indexInPicture() const {
    return is_lost_ || !isPicture() ? std::nullopt : std::optional(reply_.size() - 1);
  }

 private:
  bool isPicture() const { return !reply_.empty() && static_cast<char>(reply_.front()) == protocol::REPLY_PICTURE; }

  std::size_t headerSize() const {
    return is_version2_  ? protocol::version2::FRAME_HEADER_SIZE
           : isPicture() ? protocol::PICTURE_HEADER_SIZE
                         : protocol::VALUE_REPLY_SIZE;
  }

  std::size_t payloadSize() {
    std::size_t size = 0;
    if (is_version2_) {
      size = protocol::version2::decodeFrameHeader(reply_.data()).payload_size;
    } else if (isPicture()) {
      is_lost_ = !protocol::decodePictureHeader(reply_.data(), &size);
    } else {
      is_lost_ = !protocol::isValueReply(static_cast<char>(reply_.front()));
    }
    return size;
  }

  void tell() {
    const std::size_t skipped =
        headerSize() + (is_version2_ && isPicture() ? std::size_t{protocol::version2::IMAGE_HEADER_SIZE} : 0);
    if (on_reply_) {
      const auto begin = reply_.begin() + static_cast<std::ptrdiff_t>(std::min(skipped, reply_.size()));
      on_reply_(static_cast<char>(reply_.front()), Bytes(begin, reply_.end()));
    }
    is_version2_ = is_version2_ ||
                   (!isPicture() && protocol::version2::agreesToVersion2(protocol::decodeValueReply(reply_.data())));
  }

  const OnReply on_reply_;
  bool is_version2_ = false;
  bool is_lost_ = false;  // something that is not a reply has come: the next one cannot be found
  Bytes reply_;           // as far as it has come
  std::size_t size_ = 0;  // of the whole reply; 0 until its header has come
};

/// A request of either version of the protocol.
struct Request {
  char kind = 0;
  int id = 0;      ///< quality of `F` and `W`
  int number = 0;  ///< of the request; 0 in version 1
  Bytes payload{};
  bool version2 = false;
};

/// Finds the requests in what a client sends over one connection: commands of two bytes, and frames once it has asked
/// for version 2.
class RequestScanner {
 public:
  /// @param knows_version2 whether the server agrees to version 2
  explicit RequestScanner(bool knows_version2 = true) : knows_version2_(knows_version2) {}

  /// Takes the stream's next bytes.
  /// @return the requests that they complete
  std::vector<Request> feed(const std::uint8_t* data, std::size_t size) {
    std::vector<Request> requests;
    for (std::size_t begin = 0, taken = 0; begin < size; begin += taken) {
      if (!version2_) {
        taken = 1;
        command_.push_back(data[begin]);
        if (command_.size() == protocol::BASIC_COMMAND_SIZE) {
          const protocol::BasicGetCommand command = protocol::decodeCommand(command_.data());
          requests.push_back({command.command, command.identifier});
          version2_ = knows_version2_ && command.command == protocol::REQUEST_NEWER_VERSION;
          command_.clear();
        }
      } else if (frames_.append(data + begin, size - begin, &taken) ==
                 protocol::version2::FrameReader::FRAME_COMPLETE) {
        const protocol::version2::FrameHeader& header = frames_.header();
        const std::uint8_t* const payload = frames_.payload();
        requests.push_back(
            {header.kind, header.id, header.request_number, Bytes(payload, payload + header.payload_size), true});
      }
    }
    return requests;
  }

 private:
  const bool knows_version2_;
  bool version2_ = false;
  Bytes command_;  // of version 1, as far as it has come
  Bytes payload_ = Bytes(protocol::version2::MAX_PAYLOAD_TOWARDS_ROBOT);
  protocol::version2::FrameReader frames_{payload_.data(), payload_.size()};
};

}  // namespace test_support

#endif  // TEST_SUPPORT_PROXY_SCANNERS_H
