/// @file reply_parser.h
#ifndef AIBO_DRIVER_CLIENT_REPLY_PARSER_H
#define AIBO_DRIVER_CLIENT_REPLY_PARSER_H

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "protocol/version1.h"

namespace aibo_client {

/// Splits the byte stream of a version 1 server into pictures and value replies, wherever TCP has cut it.
///
/// The parser holds at most one picture, of at most protocol::MAX_PICTURE_SIZE. After an error in the stream, the
/// stream cannot be used any more, because nothing says where in a JPEG the next reply would begin.
class ReplyParser {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;
  using Bytes = std::vector<std::uint8_t>;

  /// What the bytes have completed.
  enum class Result { kNothing, kPicture, kValue };

  /// Consumes bytes, but not beyond the end of a reply.
  /// @param size at least 1
  /// @param arrival when these bytes were read
  /// @param[out] taken how many bytes were consumed, at least 1
  /// @throw ProtocolException the reply has an unknown kind, or the picture has an impossible size
  Result append(const std::uint8_t* data, std::size_t size, TimePoint arrival, std::size_t* taken);

  /// True unless a reply is half received.
  bool betweenReplies() const { return header_size_ == 0; }

  // These functions describe the complete reply until the next append():

  Bytes takeJpeg() { return std::exchange(jpeg_, {}); }
  protocol::ValueReply value() const { return protocol::decodeValueReply(header_.data()); }
  /// When the reply's first byte was read.
  TimePoint firstByteTime() const { return first_byte_time_; }

 private:
  Result appendHeader(const std::uint8_t* data, std::size_t size, TimePoint arrival, std::size_t* taken);
  Result appendJpeg(const std::uint8_t* data, std::size_t size, std::size_t* taken);

  std::array<unsigned char, protocol::PICTURE_HEADER_SIZE> header_{};
  std::size_t header_size_ = 0;  // how many bytes of the present reply's header have come
  std::size_t missing_ = 0;      // how many bytes of the present picture are still to come
  TimePoint first_byte_time_;    // when the first byte of the present reply was read
  Bytes jpeg_;
};

}  // namespace aibo_client

#endif  // AIBO_DRIVER_CLIENT_REPLY_PARSER_H
