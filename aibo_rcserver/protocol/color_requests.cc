#include "protocol/color_requests.h"

#include <string.h>

namespace protocol {
namespace version2 {
namespace {

const size_t LONGEST_PACKED_RUN = 128;
const unsigned char NOT_USED = 128;

// How many bytes at the beginning are the same.
size_t runAt(const unsigned char* bytes, size_t size) {
  size_t run = 1;
  while (run < size && run < LONGEST_PACKED_RUN && bytes[run] == bytes[0]) {
    ++run;
  }
  return run;
}

// How many bytes come before the next run that is worth packing, that is, of three bytes or more.
size_t literalsAt(const unsigned char* bytes, size_t size) {
  size_t count = 1;
  while (count < size && count < LONGEST_PACKED_RUN && runAt(bytes + count, size - count) < 3) {
    ++count;
  }
  return count;
}

}  // namespace

bool isEmpty(const ColorSegment& segment) {
  return memcmp(&segment, &EMPTY_COLOR_SEGMENT, sizeof(segment)) == 0;
}

size_t packColorPlane(const unsigned char* plane, size_t pixels, unsigned char* out) {
  const unsigned char* const begin = out;
  for (size_t at = 0; at < pixels;) {
    const size_t run = runAt(plane + at, pixels - at);
    if (run >= 3) {
      *out++ = static_cast<unsigned char>(257 - run);
      *out++ = plane[at];
      at += run;
    } else {
      const size_t literals = literalsAt(plane + at, pixels - at);
      *out++ = static_cast<unsigned char>(literals - 1);
      memcpy(out, plane + at, literals);
      out += literals;
      at += literals;
    }
  }
  return static_cast<size_t>(out - begin);
}

const char* unpackColorPlane(const unsigned char* packed, size_t size, size_t pixels, unsigned char* plane) {
  size_t written = 0;
  for (size_t at = 0; at < size;) {
    const unsigned char code = packed[at++];
    const bool is_run = code > NOT_USED;
    const size_t count = is_run ? 257U - code : code + 1U;
    const size_t bytes = is_run ? 1 : count;
    if (code == NOT_USED || bytes > size - at || count > pixels - written) {
      return "the packed plane has a wrong size";
    }
    if (is_run) {
      memset(plane + written, packed[at], count);
    } else {
      memcpy(plane + written, packed + at, count);
    }
    at += bytes;
    written += count;
  }
  return written == pixels ? NULL : "the packed plane is too short";
}

}  // namespace version2
}  // namespace protocol
