#include "protocol/opening.h"

#include <string.h>

namespace protocol {

namespace {

// The methods of RFC 9110, section 9.3, and RFC 5789, and TLS's header of a handshake (RFC 8446, section 5.1).
const char* const BROWSER_OPENINGS[] = {"GET ",    "POST ",    "PUT ",   "HEAD ",  "OPTIONS ",
                                        "DELETE ", "CONNECT ", "TRACE ", "PATCH ", "\x16\x03"};
const size_t NUMBER_OF_OPENINGS = sizeof(BROWSER_OPENINGS) / sizeof(BROWSER_OPENINGS[0]);

}  // namespace

const size_t Opening::LONGEST;

Opening::Verdict Opening::add(const unsigned char* bytes, size_t size) {
  if (verdict_ == UNCLEAR) {
    const size_t room = LONGEST - size_;
    const size_t taken = size < room ? size : room;
    memcpy(bytes_ + size_, bytes, taken);
    size_ += taken;
    verdict_ = judge();
  }
  return verdict_;
}

Opening::Verdict Opening::judge() const {
  for (size_t i = 0; i < NUMBER_OF_OPENINGS; ++i) {
    const size_t whole = strlen(BROWSER_OPENINGS[i]);
    if (memcmp(bytes_, BROWSER_OPENINGS[i], size_ < whole ? size_ : whole) == 0) {
      return size_ < whole ? UNCLEAR : BROWSER;
    }
  }
  return CLIENT;
}

}  // namespace protocol
