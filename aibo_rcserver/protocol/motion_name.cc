#include "protocol/motion_name.h"

#include <string.h>

namespace protocol {

namespace {

const char ENDING[] = ".MTN";
const size_t ENDING_SIZE = 4;
const size_t MAX_STEM_SIZE = MAX_MOTION_NAME_SIZE - ENDING_SIZE;

// Whatever the locale.
char capital(char character) {
  return character >= 'a' && character <= 'z' ? static_cast<char>(character - 'a' + 'A') : character;
}

bool isAllowed(char character) {
  return character != '\0' && strchr("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789!#$%&'()-@^_`{}~", character) != NULL;
}

bool isAllowed(const char* stem, size_t size) {
  for (size_t i = 0; i < size; ++i) {
    if (!isAllowed(capital(stem[i]))) {
      return false;
    }
  }
  return true;
}

bool hasEnding(const char* text, size_t size) {
  for (size_t i = 0; size >= ENDING_SIZE && i < ENDING_SIZE; ++i) {
    if (capital(text[size - ENDING_SIZE + i]) != ENDING[i]) {
      return false;
    }
  }
  return size >= ENDING_SIZE;
}

}  // namespace

const char* readMotionName(const char* text, size_t size, MotionName& name) {
  if (!hasEnding(text, size)) {
    return "the name of the motion does not end in .MTN";
  }
  const size_t stem_size = size - ENDING_SIZE;
  if (stem_size == 0) {
    return "the name of the motion has nothing before .MTN";
  }
  if (stem_size > MAX_STEM_SIZE) {
    return "the name of the motion has more than 8 characters before .MTN";
  }
  if (!isAllowed(text, stem_size)) {
    return "the name of the motion has other characters before .MTN than A to Z, 0 to 9 and !#$%&'()-@^_`{}~";
  }
  for (size_t i = 0; i < size; ++i) {
    name[i] = capital(text[i]);
  }
  name[size] = '\0';
  return NULL;
}

}  // namespace protocol
