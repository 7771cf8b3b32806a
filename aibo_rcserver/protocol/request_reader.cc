#include "protocol/request_reader.h"

#include <string.h>

#include <algorithm>

namespace protocol {

namespace {

bool hasTwoSizes(char letter) {
  return letter == REQUEST_JOINT || letter == REQUEST_SENSOR || letter == REQUEST_MAX_VELOCITY ||
         letter == REQUEST_MAX_ACCELERATION;
}

bool isFollowedByContent(char letter) {
  return letter == REQUEST_UPLOAD_MOTION || letter == REQUEST_UPLOAD_OBJECT;
}

// The size of requests with this letter, or 0.
size_t sizeOf(char letter) {
  switch (letter) {
    case REQUEST_PICTURE:
    case REQUEST_STREAM_TOGGLE:
    case REQUEST_NEWER_VERSION:
      return BASIC_COMMAND_SIZE;
    case REQUEST_LED:
    case REQUEST_FACE_LEDS:
    case REQUEST_EARS:
    case REQUEST_SHUT_DOWN:
    case REQUEST_REBOOT:
      return VALUE_REQUEST_SIZE;
    case REQUEST_UPLOAD_MOTION:
    case REQUEST_DELETE_MOTION:
    case REQUEST_PLAY_MOTION:
    case REQUEST_UPLOAD_OBJECT:
      return FILE_REQUEST_SIZE;
    default:
      return 0;
  }
}

}  // namespace

const size_t RequestReader::MAX_APPENDED;
const size_t RequestReader::MAX_WAITING;

RequestReader::RequestReader() : waiting_size_(0), content_left_(0) {}

bool RequestReader::isLetter(char letter) {
  return hasTwoSizes(letter) || sizeOf(letter) != 0;
}

size_t RequestReader::append(const unsigned char* bytes, size_t size) {
  const size_t taken = std::min(size, sizeof(waiting_) - waiting_size_);
  memcpy(waiting_ + waiting_size_, bytes, taken);
  waiting_size_ += taken;
  return taken;
}

bool RequestReader::next(Request* request) {
  skipContent();
  const size_t size = frontSize(waiting_, waiting_size_);
  if (size == 0) {
    return false;
  }
  request->basic = decodeCommand(waiting_);
  const char letter = request->basic.command;
  request->valid = hasTwoSizes(letter) ? size <= VALUE_REQUEST_SIZE : sizeOf(letter) != 0;
  request->payload_size = request->valid ? size - BASIC_COMMAND_SIZE : 0;
  memcpy(request->payload, waiting_ + BASIC_COMMAND_SIZE, request->payload_size);
  if (isFollowedByContent(letter)) {
    content_left_ = contentSize(decodeFileRequest(request->payload));
  }
  take(size);
  return true;
}

size_t RequestReader::takeContent(unsigned char* out, size_t capacity) {
  const size_t taken = std::min(capacity, std::min(content_left_, waiting_size_));
  memcpy(out, waiting_, taken);
  content_left_ -= taken;
  take(taken);
  return taken;
}

void RequestReader::take(size_t size) {
  waiting_size_ -= size;
  memmove(waiting_, waiting_ + size, waiting_size_);
}

void RequestReader::skipContent() {
  const size_t skipped = std::min(content_left_, waiting_size_);
  content_left_ -= skipped;
  take(skipped);
}

// The size of the first request in these bytes; 0 if it is incomplete.
size_t RequestReader::frontSize(const unsigned char* bytes, size_t size) {
  if (size < BASIC_COMMAND_SIZE) {
    return 0;
  }
  const char letter = static_cast<char>(bytes[0]);
  if (hasTwoSizes(letter)) {
    return size == VALUE_REQUEST_SIZE - 1 ? 0 : size;
  }
  // The size of an unknown request is unknown, but it has at least two bytes.
  const size_t wanted = sizeOf(letter) != 0 ? sizeOf(letter) : BASIC_COMMAND_SIZE;
  return size < wanted ? 0 : wanted;
}

}  // namespace protocol
