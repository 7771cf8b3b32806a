#include "client/reply_parser.h"

#include <algorithm>
#include <string>
#include <utility>

#include "aibo_driver/exceptions.h"

namespace aibo_driver {
namespace {

std::size_t headerSizeOf(std::uint8_t letter) {
  if (static_cast<char>(letter) == protocol::REPLY_PICTURE) {
    return protocol::PICTURE_HEADER_SIZE;
  }
  if (protocol::isValueReply(static_cast<char>(letter))) {
    return protocol::VALUE_REPLY_SIZE;
  }
  throw ProtocolException("a reply that begins with byte " + std::to_string(letter));
}

}  // namespace

void ReplyParser::feed(const std::uint8_t* data, std::size_t size, TimePoint arrival, ReplyHandler& handler) {
  while (size > 0) {
    const std::size_t taken =
        missing_ > 0 ? takePicture(data, size, handler) : takeHeader(data, size, arrival, handler);
    data += taken;
    size -= taken;
  }
}

std::size_t ReplyParser::takeHeader(const std::uint8_t* data, std::size_t size, TimePoint arrival,
                                    ReplyHandler& handler) {
  if (header_size_ == 0) {
    first_byte_time_ = arrival;
    header_[0] = data[0];
  }
  const std::size_t whole = headerSizeOf(header_[0]);
  const std::size_t taken = std::min(whole - header_size_, size);
  std::copy_n(data, taken, header_.begin() + header_size_);
  header_size_ += taken;
  if (header_size_ < whole) {
    return taken;
  }
  if (whole == protocol::VALUE_REPLY_SIZE) {
    header_size_ = 0;
    handler.onValueReply(protocol::decodeValueReply(header_.data()), first_byte_time_);
  } else if (protocol::decodePictureHeader(header_.data(), &missing_)) {
    jpeg_.reserve(missing_);
  } else {
    throw ProtocolException("a picture of " + std::to_string(missing_) + " bytes; 1 to " +
                            std::to_string(protocol::MAX_PICTURE_SIZE) + " are possible");
  }
  return taken;
}

std::size_t ReplyParser::takePicture(const std::uint8_t* data, std::size_t size, ReplyHandler& handler) {
  const std::size_t taken = std::min(missing_, size);
  jpeg_.insert(jpeg_.end(), data, data + taken);
  missing_ -= taken;
  if (missing_ == 0) {
    header_size_ = 0;
    handler.onPicture(std::exchange(jpeg_, {}), first_byte_time_);
  }
  return taken;
}

}  // namespace aibo_driver
