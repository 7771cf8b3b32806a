#include "protocol/text.h"

#include <string.h>

namespace protocol {

namespace {

const unsigned LAST_CODE_POINT = 0x10ffff;

const size_t ENDING_SIZE = 4;
const size_t MAX_STEM_SIZE = MAX_FILE_NAME_SIZE - ENDING_SIZE;

bool isContinuation(unsigned char byte) {
  return (byte & 0xc0) == 0x80;
}

// The size of the UTF-8 character that begins with this byte; 0 if none does.
size_t characterSize(unsigned char first) {
  if (first < 0x80) {
    return 1;
  }
  if ((first & 0xe0) == 0xc0) {
    return 2;
  }
  if ((first & 0xf0) == 0xe0) {
    return 3;
  }
  return (first & 0xf8) == 0xf0 ? 4 : 0;
}

struct Range {
  unsigned first;
  unsigned last;
};

// Unicode's formatting characters (category Cf), line ends (Zl, Zp) and variation selectors. Arabic and other scripts
// use some of them, but a robot's messages do not.
const Range FORMAT_CHARACTERS[] = {{0xad, 0xad},     {0x61c, 0x61c},     {0x180b, 0x180e},  {0x200b, 0x200f},
                                   {0x2028, 0x202e}, {0x2060, 0x206f},   {0xfe00, 0xfe0f},  {0xfeff, 0xfeff},
                                   {0xfff9, 0xfffb}, {0x1d173, 0x1d17a}, {0xe0000, 0xe0fff}};
const size_t NUMBER_OF_FORMAT_RANGES = sizeof(FORMAT_CHARACTERS) / sizeof(FORMAT_CHARACTERS[0]);

bool formatsOthers(unsigned code_point) {
  for (size_t i = 0; i < NUMBER_OF_FORMAT_RANGES; ++i) {
    if (code_point >= FORMAT_CHARACTERS[i].first && code_point <= FORMAT_CHARACTERS[i].last) {
      return true;
    }
  }
  return false;
}

bool isPlainCharacter(unsigned code_point, size_t size) {
  static const unsigned SMALLEST_OF_SIZE[] = {0, 0x20, 0xa0, 0x800, 0x10000};
  const bool is_surrogate = code_point >= 0xd800 && code_point <= 0xdfff;
  return code_point >= SMALLEST_OF_SIZE[size] && code_point != 0x7f && !is_surrogate && !formatsOthers(code_point) &&
         code_point <= LAST_CODE_POINT;
}

// The size of the first character; 0 if it is malformed or a control character.
size_t plainCharacterAt(const char* bytes, size_t size) {
  static const unsigned char FIRST_BYTE_MASK[] = {0, 0x7f, 0x1f, 0x0f, 0x07};
  const unsigned char first = static_cast<unsigned char>(bytes[0]);
  const size_t character_size = characterSize(first);
  if (character_size == 0 || character_size > size) {
    return 0;
  }
  unsigned code_point = first & FIRST_BYTE_MASK[character_size];
  for (size_t i = 1; i < character_size; ++i) {
    const unsigned char byte = static_cast<unsigned char>(bytes[i]);
    if (!isContinuation(byte)) {
      return 0;
    }
    code_point = (code_point << 6) | (byte & 0x3fU);
  }
  return isPlainCharacter(code_point, character_size) ? character_size : 0;
}

// The character as a capital. Unlike toupper(), this function does not depend on the locale.
char capital(char character) {
  return character >= 'a' && character <= 'z' ? static_cast<char>(character - 'a' + 'A') : character;
}

bool isAllowedInName(char character) {
  return character != '\0' && strchr("ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789!#$%&'()-@^_`{}~", character) != NULL;
}

bool isAllowedInName(const char* stem, size_t size) {
  for (size_t i = 0; i < size; ++i) {
    if (!isAllowedInName(capital(stem[i]))) {
      return false;
    }
  }
  return true;
}

// True if Windows takes the name for a device, whatever its ending is.
bool isDevice(const char* name, size_t stem_size) {
  static const char* const DEVICES[] = {"CON", "PRN", "AUX", "NUL", "CLOCK$"};
  for (size_t i = 0; i < sizeof(DEVICES) / sizeof(DEVICES[0]); ++i) {
    if (stem_size == strlen(DEVICES[i]) && strncmp(name, DEVICES[i], stem_size) == 0) {
      return true;
    }
  }
  const bool is_port = strncmp(name, "COM", 3) == 0 || strncmp(name, "LPT", 3) == 0;
  return is_port && stem_size == 4 && name[3] >= '0' && name[3] <= '9';
}

// True if Windows may use the name as the short form of a longer one, such as "WAG~1".
bool standsForLongName(const char* name, size_t stem_size) {
  size_t digits = 0;
  while (digits < stem_size && name[stem_size - 1 - digits] >= '0' && name[stem_size - 1 - digits] <= '9') {
    ++digits;
  }
  return digits > 0 && digits < stem_size && name[stem_size - 1 - digits] == '~';
}

bool endsIn(const char (&ending)[ENDING_SIZE + 1], const char* text, size_t size) {
  for (size_t i = 0; size >= ENDING_SIZE && i < ENDING_SIZE; ++i) {
    if (capital(text[size - ENDING_SIZE + i]) != ending[i]) {
      return false;
    }
  }
  return size >= ENDING_SIZE;
}

// Reads a name whose ending is right.
const char* readFileName(const char* text, size_t size, FileName& name) {
  const size_t stem_size = size - ENDING_SIZE;
  if (stem_size == 0) {
    return "the name has nothing before its ending";
  }
  if (stem_size > MAX_STEM_SIZE) {
    return "the name has more than 8 characters before its ending";
  }
  if (!isAllowedInName(text, stem_size)) {
    return "the name has characters other than A to Z, 0 to 9 and !#$%&'()-@^_`{}~ before its ending";
  }
  for (size_t i = 0; i < size; ++i) {
    name[i] = capital(text[i]);
  }
  name[size] = '\0';
  return NULL;
}

}  // namespace

bool isPlainText(const char* bytes, size_t size) {
  while (size > 0) {
    const size_t character_size = plainCharacterAt(bytes, size);
    if (character_size == 0) {
      return false;
    }
    bytes += character_size;
    size -= character_size;
  }
  return true;
}

size_t sizeOfWholeCharacters(const char* bytes, size_t size, size_t limit) {
  if (size <= limit) {
    return size;
  }
  while (limit > 0 && isContinuation(static_cast<unsigned char>(bytes[limit]))) {
    --limit;
  }
  return limit;
}

Text textInFile(const char* bytes, size_t size) {
  static const char BYTE_ORDER_MARK[] = {'\xef', '\xbb', '\xbf'};
  Text text = {bytes, size};
  if (size >= sizeof(BYTE_ORDER_MARK) && memcmp(bytes, BYTE_ORDER_MARK, sizeof(BYTE_ORDER_MARK)) == 0) {
    text.begin += sizeof(BYTE_ORDER_MARK);
    text.size -= sizeof(BYTE_ORDER_MARK);
  }
  while (text.size > 0 && memchr(" \t\r\n\x1a", text.begin[text.size - 1], 5) != NULL) {
    --text.size;
  }
  return text;
}

const char* readMotionName(const char* text, size_t size, MotionName& name) {
  return endsIn(".MTN", text, size) ? readFileName(text, size, name) : "the name of the motion does not end in .MTN";
}

const char* readPictureName(const char* text, size_t size, PictureName& name) {
  return endsIn(".JPG", text, size) ? readFileName(text, size, name) : "the name of the picture does not end in .JPG";
}

const char* problemOfNewMotionName(const MotionName& name) {
  const size_t stem_size = strlen(name) - ENDING_SIZE;
  if (isDevice(name, stem_size)) {
    return "the name of the motion is that of a device on Windows, where it could not be read; choose another one";
  }
  if (standsForLongName(name, stem_size)) {
    return "the name of the motion ends in ~ and digits, and could stand for another file; choose another one";
  }
  return NULL;
}

}  // namespace protocol
