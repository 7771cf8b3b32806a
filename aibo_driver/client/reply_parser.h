/// @file reply_parser.h
#ifndef AIBO_DRIVER_CLIENT_REPLY_PARSER_H
#define AIBO_DRIVER_CLIENT_REPLY_PARSER_H

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "protocol/version1.h"

namespace aibo_driver {

/// Takes what ReplyParser finds.
class ReplyHandler {
 public:
  using TimePoint = std::chrono::steady_clock::time_point;

  virtual void onPicture(std::vector<std::uint8_t> jpeg, TimePoint first_byte_time) = 0;
  virtual void onValueReply(const protocol::ValueReply& reply, TimePoint first_byte_time) = 0;

 protected:
  ~ReplyHandler() = default;
};

/// Splits the byte stream of a version 1 server into pictures and value replies, however TCP has cut it.
///
/// It holds at most one picture, of at most protocol::MAX_PICTURE_SIZE. A stream that has once been wrong is of no
/// further use: nothing tells where in a JPEG the next reply would begin.
class ReplyParser {
 public:
  using TimePoint = ReplyHandler::TimePoint;

  /// @param arrival when these bytes were read
  /// @throw ProtocolException a reply of no known kind, or a picture of an impossible size
  void feed(const std::uint8_t* data, std::size_t size, TimePoint arrival, ReplyHandler& handler);

  /// True if no reply is half-received.
  bool betweenReplies() const { return header_size_ == 0; }

 private:
  std::size_t takeHeader(const std::uint8_t* data, std::size_t size, TimePoint arrival, ReplyHandler& handler);
  std::size_t takePicture(const std::uint8_t* data, std::size_t size, ReplyHandler& handler);

  std::array<unsigned char, protocol::PICTURE_HEADER_SIZE> header_{};
  std::size_t header_size_ = 0;  // bytes of the present reply's header that are there
  std::size_t missing_ = 0;      // bytes of the present picture that are still to come
  TimePoint first_byte_time_;    // of the present reply
  std::vector<std::uint8_t> jpeg_;
};

}  // namespace aibo_driver

#endif  // AIBO_DRIVER_CLIENT_REPLY_PARSER_H
