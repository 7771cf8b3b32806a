#include "protocol/introduction.h"

#include <string.h>

namespace protocol {
namespace version2 {
namespace {

const char KEY[] = "token=";
const size_t TOKEN_OFFSET = INTRODUCTION_SIZE - TOKEN_SIZE;

}  // namespace

size_t encodeIntroduction(const char* token, unsigned char* out) {
  encodeCommand(versionRequest(), out);
  const FrameHeader header = {REQUEST_HELLO, 0, INTRODUCTION_NUMBER, MAX_HELLO_REQUEST_SIZE};
  encodeFrameHeader(header, out + BASIC_COMMAND_SIZE);
  memcpy(out + BASIC_COMMAND_SIZE + FRAME_HEADER_SIZE, KEY, strlen(KEY));
  memcpy(out + TOKEN_OFFSET, token, TOKEN_SIZE);
  return INTRODUCTION_SIZE;
}

bool decodeIntroduction(const unsigned char* bytes, size_t size, char (&token)[TOKEN_SIZE + 1]) {
  if (size < INTRODUCTION_SIZE) {
    return false;
  }
  memcpy(token, bytes + TOKEN_OFFSET, TOKEN_SIZE);
  token[TOKEN_SIZE] = '\0';
  unsigned char expected[INTRODUCTION_SIZE];
  encodeIntroduction(token, expected);
  return memcmp(bytes, expected, INTRODUCTION_SIZE) == 0;
}

}  // namespace version2
}  // namespace protocol
