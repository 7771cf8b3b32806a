#include "protocol/opening.h"

#include <ctype.h>
#include <string.h>

#include "protocol/request_reader.h"

namespace protocol {

namespace {

const char LETTERS_OF_PAIRS[] = "FWXJSVA";  // requests that can have two bytes

// True for the characters of RFC 9110, section 5.6.2. With isalnum() alone, the result would depend on the locale.
bool isOfToken(unsigned char byte) {
  return byte < 0x80 && (isalnum(byte) || (byte != '\0' && strchr("!#$%&'*+-.^_`|~", byte) != NULL));
}

// The target of an HTTP request line is a path, an address with its scheme, or "*".
bool beginsTarget(unsigned char byte) {
  return byte == '/' || byte == '*' || (byte >= 'a' && byte <= 'z');
}

}  // namespace

void Opening::add(const unsigned char* bytes, size_t size) {
  for (size_t i = 0; i < size && !is_decided_; ++i) {
    take(bytes[i]);
  }
}

Opening::Verdict Opening::verdict() const {
  if (is_decided_) {
    return is_stranger_ ? STRANGER : CLIENT;
  }
  return is_of_letters_ || ends_with_space_ || size_ > FILE_REQUEST_SIZE ? UNCLEAR : CLIENT;
}

bool Opening::isStrangers(const unsigned char* bytes, size_t size) {
  Opening opening;
  opening.add(bytes, size);
  return opening.verdict() == STRANGER;
}

// A space as the second byte of a request proves nothing: "F " asks for a picture of quality 32.
void Opening::take(unsigned char byte) {
  const bool is_second = size_ % 2 == 1;
  if (size_ == 0 && !RequestReader::isLetter(static_cast<char>(byte))) {
    decide(true);
  } else if (ends_with_space_) {
    decide(beginsTarget(byte));
  } else if (byte == ' ') {
    ends_with_space_ = size_ == 1 || (is_of_pairs_ && is_second);
    is_decided_ = is_stranger_ = !ends_with_space_;
  } else if (!isOfToken(byte)) {
    decide(false);
  }
  is_of_letters_ = is_of_letters_ && isalpha(byte);
  is_of_pairs_ = is_of_pairs_ && (is_second || strchr(LETTERS_OF_PAIRS, byte) != NULL);
  ++size_;
}

void Opening::decide(bool is_stranger) {
  is_decided_ = true;
  is_stranger_ = is_stranger;
}

}  // namespace protocol
