#include "client/reply_parser.h"

#include <algorithm>
#include <string>

#include "client/fault.h"

namespace aibo_client {
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

ReplyParser::Result ReplyParser::append(const std::uint8_t* data, std::size_t size, TimePoint arrival,
                                        std::size_t* taken) {
  return missing_ > 0 ? appendJpeg(data, size, taken) : appendHeader(data, size, arrival, taken);
}

ReplyParser::Result ReplyParser::appendHeader(const std::uint8_t* data, std::size_t size, TimePoint arrival,
                                              std::size_t* taken) {
  if (header_size_ == 0) {
    first_byte_time_ = arrival;
    header_[0] = data[0];
  }
  const std::size_t whole = headerSizeOf(header_[0]);
  *taken = std::min(whole - header_size_, size);
  std::copy_n(data, *taken, header_.begin() + header_size_);
  header_size_ += *taken;
  if (header_size_ < whole) {
    return Result::kNothing;
  }
  if (whole == protocol::VALUE_REPLY_SIZE) {
    header_size_ = 0;
    return Result::kValue;
  }
  if (!protocol::decodePictureHeader(header_.data(), &missing_)) {
    throw ProtocolException("a picture of " + std::to_string(missing_) + " bytes; 1 to " +
                            std::to_string(protocol::MAX_PICTURE_SIZE) + " are possible");
  }
  jpeg_.reserve(missing_);
  return Result::kNothing;
}

ReplyParser::Result ReplyParser::appendJpeg(const std::uint8_t* data, std::size_t size, std::size_t* taken) {
  *taken = std::min(missing_, size);
  jpeg_.insert(jpeg_.end(), data, data + *taken);
  missing_ -= *taken;
  if (missing_ > 0) {
    return Result::kNothing;
  }
  header_size_ = 0;
  return Result::kPicture;
}

}  // namespace aibo_client
