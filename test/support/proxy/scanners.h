/// @file scanners.h
/// What goes over a connection between a client and a server, however TCP has cut it.
#ifndef TEST_SUPPORT_PROXY_SCANNERS_H
#define TEST_SUPPORT_PROXY_SCANNERS_H

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "protocol/frame_reader.h"
#include "protocol/version1.h"
#include "protocol/version2.h"
#include "support/sockets.h"

namespace test_support {

/// Finds pictures and other replies in what a server sends over one connection, in either version of the protocol.
class ReplyScanner {
 public:
  using OnReply = std::function<void(char kind, const Bytes& payload)>;

  /// @param kinds of the replies and pushes with a payload that are wanted
  /// @param on_reply called with each of them that is complete; the payload of a picture is its JPEG
  explicit ReplyScanner(std::string kinds = "", OnReply on_reply = nullptr)
      : kinds_(std::move(kinds)), on_reply_(std::move(on_reply)) {}

  /// Takes the stream's next bytes.
  /// @return where in the stream pictures begin whose header's first byte is among them: offsets, ascending
  std::vector<std::uint64_t> feed(const std::uint8_t* data, std::size_t size) {
    std::vector<std::uint64_t> begins;
    const std::uint8_t* const end = data + size;
    while (data < end && !lost_) {
      std::size_t taken = 1;
      if (payload_left_ > 0) {
        taken = static_cast<std::size_t>(std::min<std::uint64_t>(payload_left_, static_cast<std::size_t>(end - data)));
        takePayload(data, taken);
      } else {
        if (header_.empty() && static_cast<char>(*data) == protocol::REPLY_PICTURE) {
          begins.push_back(offset_);
        }
        header_.push_back(*data);
        if (header_.size() == headerSize()) {
          takeHeader();
        }
      }
      data += taken;
      offset_ += taken;
    }
    return begins;
  }

 private:
  std::size_t headerSize() const {
    if (version2_) {
      return protocol::version2::FRAME_HEADER_SIZE;
    }
    const bool picture = static_cast<char>(header_.front()) == protocol::REPLY_PICTURE;
    return picture ? protocol::PICTURE_HEADER_SIZE : protocol::VALUE_REPLY_SIZE;
  }

  void takeHeader() {
    kind_ = static_cast<char>(header_.front());
    if (version2_) {
      payload_left_ = protocol::version2::decodeFrameHeader(header_.data()).payload_size;
    } else if (kind_ == protocol::REPLY_PICTURE) {
      std::size_t size = 0;
      lost_ = !protocol::decodePictureHeader(header_.data(), &size);
      payload_left_ = size;
    } else {
      lost_ = !protocol::isValueReply(kind_);
      version2_ = protocol::version2::agreesToVersion2(protocol::decodeValueReply(header_.data()));
    }
    header_.clear();
  }

  void takePayload(const std::uint8_t* data, std::size_t size) {
    payload_left_ -= size;
    if (kinds_.find(kind_) == std::string::npos) {
      return;
    }
    payload_.insert(payload_.end(), data, data + size);
    if (payload_left_ == 0) {
      const bool has_header = version2_ && kind_ == protocol::version2::PICTURE;
      const std::size_t skipped = std::min(has_header ? protocol::version2::IMAGE_HEADER_SIZE : 0, payload_.size());
      on_reply_(kind_, Bytes(payload_.begin() + static_cast<std::ptrdiff_t>(skipped), payload_.end()));
      payload_.clear();
    }
  }

  const std::string kinds_;
  const OnReply on_reply_;
  std::uint64_t offset_ = 0;  // of the next byte
  bool version2_ = false;
  bool lost_ = false;  // something that is not a reply has come: the next one cannot be found
  Bytes header_;
  std::uint64_t payload_left_ = 0;  // bytes of the present reply that are still to come
  char kind_ = '\0';
  Bytes payload_;  // of the present reply, if somebody wants it
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
