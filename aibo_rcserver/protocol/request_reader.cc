#include "protocol/request_reader.h"

#include <string.h>

#include <algorithm>

namespace protocol {

namespace {

bool isOneOf(const char* letters, char letter) {
  return letter != '\0' && strchr(letters, letter) != NULL;
}

bool hasTwoSizes(char letter) {
  return isOneOf("JSVA", letter);
}

bool isFollowedByContent(char letter) {
  return isOneOf("UC", letter);
}

// The size of requests with this letter, or 0.
size_t sizeOf(char letter) {
  if (isOneOf("FWX", letter)) {
    return BASIC_COMMAND_SIZE;
  }
  if (isOneOf("LYKQR", letter)) {
    return VALUE_REQUEST_SIZE;
  }
  return isOneOf("UDPC", letter) ? FILE_REQUEST_SIZE : 0;
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
