#include "protocol/file_list.h"

#include <string.h>

namespace protocol {
namespace version2 {

namespace {

const char SEPARATOR = '\n';

// Bytes up to the next separator, or all bytes if there is none.
size_t sizeOfLine(const unsigned char* bytes, size_t size) {
  const void* const separator = memchr(bytes, SEPARATOR, size);
  return separator == NULL ? size : static_cast<size_t>(static_cast<const unsigned char*>(separator) - bytes);
}

}  // namespace

size_t encodeFileList(const FileList& list, unsigned char* out) {
  size_t size = 0;
  for (size_t i = 0; i < list.count; ++i) {
    if (i > 0) {
      out[size++] = SEPARATOR;
    }
    const size_t name_size = strlen(list.names[i]);
    memcpy(out + size, list.names[i], name_size);
    size += name_size;
  }
  return size;
}

const char* decodeFileList(ReadFileName read, const unsigned char* payload, size_t size, FileList* list) {
  list->count = 0;
  // A name follows every separator, so a list must not end with one.
  for (size_t begin = 0; size > 0 && begin <= size; ++list->count) {
    if (list->count == MAX_LISTED_FILES) {
      return "more than 256 names";
    }
    const size_t line_size = sizeOfLine(payload + begin, size - begin);
    if (const char* problem =
            read(reinterpret_cast<const char*>(payload + begin), line_size, list->names[list->count])) {
      return problem;
    }
    begin += line_size + 1;
  }
  return NULL;
}

}  // namespace version2
}  // namespace protocol
