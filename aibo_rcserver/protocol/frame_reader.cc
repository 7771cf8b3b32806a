#include "protocol/frame_reader.h"

#include <string.h>

#include <algorithm>

namespace protocol {
namespace version2 {

FrameReader::FrameReader(unsigned char* buffer, size_t capacity) : buffer_(buffer), capacity_(capacity) {
  reset();
}

void FrameReader::reset() {
  header_bytes_size_ = 0;
  header_ = FrameHeader();
  payload_size_ = 0;
}

FrameReader::Result FrameReader::append(const unsigned char* bytes, size_t size, size_t* taken) {
  if (result() == FRAME_COMPLETE) {
    reset();
  }
  *taken = appendHeader(bytes, size);
  if (result() == FRAME_TOO_LARGE) {
    *taken = size;
    return FRAME_TOO_LARGE;
  }
  *taken += appendPayload(bytes + *taken, size - *taken);
  return result();
}

bool FrameReader::isBetweenFrames() const {
  return header_bytes_size_ == 0 || result() == FRAME_COMPLETE;
}

size_t FrameReader::appendHeader(const unsigned char* bytes, size_t size) {
  if (hasHeader() || size == 0) {
    return 0;
  }
  const size_t taken = std::min(size, FRAME_HEADER_SIZE - header_bytes_size_);
  memcpy(header_bytes_ + header_bytes_size_, bytes, taken);
  header_bytes_size_ += taken;
  if (hasHeader()) {
    header_ = decodeFrameHeader(header_bytes_);
  }
  return taken;
}

size_t FrameReader::appendPayload(const unsigned char* bytes, size_t size) {
  if (!hasHeader()) {
    return 0;
  }
  const size_t taken = std::min(size, header_.payload_size - payload_size_);
  if (taken > 0) {
    memcpy(buffer_ + payload_size_, bytes, taken);
  }
  payload_size_ += taken;
  return taken;
}

FrameReader::Result FrameReader::result() const {
  if (!hasHeader()) {
    return FRAME_INCOMPLETE;
  }
  if (header_.payload_size > capacity_) {
    return FRAME_TOO_LARGE;
  }
  return payload_size_ < header_.payload_size ? FRAME_INCOMPLETE : FRAME_COMPLETE;
}

}  // namespace version2
}  // namespace protocol
