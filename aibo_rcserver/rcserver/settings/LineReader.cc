#include "rcserver/settings/LineReader.h"

#include <ctype.h>
#include <string.h>

namespace {

// Some editors put it in front of a file.
const char BYTE_ORDER_MARK[] = "\xef\xbb\xbf";

}  // namespace

const size_t LineReader::MAX_LINE_SIZE;

bool LineReader::Next() {
  int character = getc(file_);
  if (character == EOF) {
    return false;
  }
  ++number_;
  size_ = 0;
  is_text_ = true;
  bool is_comment = false;
  for (; character != EOF && character != '\n'; character = getc(file_)) {
    is_comment = is_comment || character == '#';
    if (!is_comment) {
      Add(character);
    }
  }
  Trim();
  return true;
}

void LineReader::Add(int character) {
  if (size_ == MAX_LINE_SIZE || character == '\0') {
    is_text_ = false;
    return;
  }
  line_[size_] = static_cast<char>(toupper(character));
  ++size_;
}

void LineReader::Trim() {
  while (size_ > 0 && isspace(static_cast<unsigned char>(line_[size_ - 1]))) {
    --size_;
  }
  line_[size_] = '\0';
  const size_t mark_size = strlen(BYTE_ORDER_MARK);
  const char* begin = number_ == 1 && strncmp(line_, BYTE_ORDER_MARK, mark_size) == 0 ? line_ + mark_size : line_;
  begin += strspn(begin, " \t");
  memmove(line_, begin, strlen(begin) + 1);
}
