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

namespace aibo_driver {

/// Splits the byte stream of a version 1 server into pictures and value replies, however TCP has cut it.
///
/// It holds at most one picture, of at most protocol::MAX_PICTURE_SIZE. A stream that has once been wrong is of no
/// further use: nothing says where in a JPEG the next reply would begin.
class ReplyParser {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;
  using Bytes = std::vector<std::uint8_t>;

  /// What the bytes taken have completed.
  enum class Result { kNothing, kPicture, kValue };

  /// Takes bytes up to the end of a reply at most.
  /// @param size at least 1
  /// @param arrival when these bytes were read
  /// @param[out] taken bytes, at least 1
  /// @throw ProtocolException a reply of no known kind, or a picture of an impossible size
  Result append(const std::uint8_t* data, std::size_t size, TimePoint arrival, std::size_t* taken);

  /// True if no reply is half-received.
  bool betweenReplies() const { return header_size_ == 0; }

  // Of the reply that is complete, until the next append():

  Bytes takeJpeg() { return std::exchange(jpeg_, {}); }
  protocol::ValueReply value() const { return protocol::decodeValueReply(header_.data()); }
  /// When its first byte was read.
  TimePoint firstByteTime() const { return first_byte_time_; }

 private:
  Result appendHeader(const std::uint8_t* data, std::size_t size, TimePoint arrival, std::size_t* taken);
  Result appendJpeg(const std::uint8_t* data, std::size_t size, std::size_t* taken);

  std::array<unsigned char, protocol::PICTURE_HEADER_SIZE> header_{};
  std::size_t header_size_ = 0;  // bytes of the present reply's header that are there
  std::size_t missing_ = 0;      // bytes of the present picture that are still to come
  TimePoint first_byte_time_;    // of the present reply
  Bytes jpeg_;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_REPLY_PARSER_H
