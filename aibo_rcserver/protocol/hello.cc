#include "protocol/hello.h"

#include <limits.h>
#include <stdio.h>
#include <string.h>

#include "protocol/text.h"

namespace protocol {
namespace version2 {

namespace {

enum Key { KEY_ROBOT, KEY_SERVER, KEY_FRAME_NUMBER, KEY_CAPABILITIES, KEY_LIMITS, KEY_WALK_LIMITS, KEY_COUNT };

const int REQUIRED_KEYS = KEY_WALK_LIMITS;  // all keys before this one

const char* const KEY_NAMES[KEY_COUNT] = {"robot", "server", "frame_number", "capabilities", "limits", "walk_limits"};

// A part of the payload, without a zero byte at its end.
struct Text {
  const char* begin;
  const char* end;

  size_t size() const { return static_cast<size_t>(end - begin); }
  bool isEmpty() const { return begin == end; }
  bool operator==(const char* other) const { return size() == strlen(other) && memcmp(begin, other, size()) == 0; }
};

// Removes the text up to the first `separator`, or all of it if there is none, and returns it without the separator.
Text takeUntil(char separator, Text* text) {
  const void* found = text->isEmpty() ? NULL : memchr(text->begin, separator, text->size());
  Text taken = *text;
  if (found == NULL) {
    text->begin = text->end;
  } else {
    taken.end = static_cast<const char*>(found);
    text->begin = taken.end + 1;
  }
  return taken;
}

// Parses all of `text` as a decimal number up to `limit`.
bool parseUnsigned(const Text& text, unsigned limit, unsigned* value) {
  unsigned sum = 0;
  for (const char* digit = text.begin; digit != text.end; ++digit) {
    if (*digit < '0' || *digit > '9') {
      return false;
    }
    const unsigned next = static_cast<unsigned>(*digit - '0');
    if (sum > (limit - next) / 10) {
      return false;
    }
    sum = sum * 10 + next;
  }
  *value = sum;
  return !text.isEmpty();
}

bool parseSigned(const Text& text, int* value) {
  Text digits = text;
  const bool is_negative = !text.isEmpty() && *text.begin == '-';
  if (is_negative) {
    ++digits.begin;
  }
  unsigned magnitude = 0;
  if (!parseUnsigned(digits, INT_MAX, &magnitude)) {
    return false;
  }
  *value = is_negative ? -static_cast<int>(magnitude) : static_cast<int>(magnitude);
  return true;
}

const char* decodeText(const Text& value, char* out) {
  if (value.size() > MAX_HELLO_TEXT_SIZE) {
    return "a text in the hello is longer than 127 bytes";
  }
  memcpy(out, value.begin, value.size());
  out[value.size()] = '\0';
  return NULL;
}

bool decodeJointLimits(Text text, JointLimits* joint) {
  unsigned id = 0;
  const bool is_read = parseUnsigned(takeUntil(':', &text), UCHAR_MAX, &id) &&
                       parseSigned(takeUntil(':', &text), &joint->lower) &&
                       parseSigned(takeUntil(':', &text), &joint->upper) && parseSigned(text, &joint->speed);
  joint->id = static_cast<unsigned char>(id);
  return is_read && joint->lower <= joint->upper && joint->speed >= 0;
}

bool hasJoint(const Hello& hello, unsigned char id) {
  for (size_t i = 0; i < hello.joint_count; ++i) {
    if (hello.joints[i].id == id) {
      return true;
    }
  }
  return false;
}

const char* decodeLimits(Text value, Hello* hello) {
  while (!value.isEmpty()) {
    JointLimits joint;
    if (!decodeJointLimits(takeUntil(' ', &value), &joint)) {
      return "the limits of a joint are not id:lower:upper:speed";
    }
    if (hasJoint(*hello, joint.id)) {
      return "the hello gives a joint's limits twice";
    }
    if (hello->joint_count == MAX_JOINTS) {
      return "more joints than any robot has";
    }
    hello->joints[hello->joint_count++] = joint;
  }
  return NULL;
}

bool parseThousandths(const Text& text, double* value) {
  unsigned number = 0;
  const bool is_read = parseUnsigned(text, SHRT_MAX, &number);
  *value = number * 1e-3;
  return is_read;
}

int thousandths(double value) {
  return static_cast<int>(value * 1000 + 0.5);
}

const char* decodeWalkLimits(Text value, WalkLimits* walk) {
  const bool is_read = parseThousandths(takeUntil(':', &value), &walk->forward) &&
                       parseThousandths(takeUntil(':', &value), &walk->back) &&
                       parseThousandths(takeUntil(':', &value), &walk->left) && parseThousandths(value, &walk->turn);
  return is_read ? NULL : "the limits of the walk are not forward:back:left:turn";
}

const char* decodeValue(Key key, const Text& value, Hello* hello) {
  switch (key) {
    case KEY_ROBOT:
      return decodeText(value, hello->robot);
    case KEY_SERVER:
      return decodeText(value, hello->server);
    case KEY_FRAME_NUMBER:
      return parseUnsigned(value, UINT_MAX, &hello->frame_number) ? NULL : "the frame number is not a number";
    case KEY_CAPABILITIES:
      return decodeText(value, hello->capabilities);
    case KEY_LIMITS:
      return decodeLimits(value, hello);
    case KEY_WALK_LIMITS:
      return decodeWalkLimits(value, &hello->walk);
    default:
      return NULL;
  }
}

Key keyOf(const Text& name) {
  int key = 0;
  while (key < KEY_COUNT && !(name == KEY_NAMES[key])) {
    ++key;
  }
  return static_cast<Key>(key);
}

const char* decodeLine(Text line, bool* is_there, Hello* hello) {
  if (!isPlainText(line.begin, line.size())) {
    return "the hello is not UTF-8 or holds control characters";
  }
  const Text name = takeUntil('=', &line);
  if (name.isEmpty() || name.end == line.end) {
    return "a line of the hello is not key=value";
  }
  const Key key = keyOf(name);
  if (key == KEY_COUNT) {
    return NULL;
  }
  if (is_there[key]) {
    return "the hello has a key twice";
  }
  is_there[key] = true;
  return decodeValue(key, line, hello);
}

}  // namespace

size_t encodeHello(const Hello& hello, unsigned char* out) {
  char* const begin = reinterpret_cast<char*>(out);
  char* end = begin;
  end += sprintf(end, "robot=%s\nserver=%s\nframe_number=%u\ncapabilities=%s\nlimits=", hello.robot, hello.server,
                 hello.frame_number, hello.capabilities);
  for (size_t i = 0; i < hello.joint_count; ++i) {
    const JointLimits& joint = hello.joints[i];
    end += sprintf(end, "%s%d:%d:%d:%d", i > 0 ? " " : "", joint.id, joint.lower, joint.upper, joint.speed);
  }
  end += sprintf(end, "\n");
  const WalkLimits& walk = hello.walk;
  if (walk.forward > 0 || walk.back > 0 || walk.left > 0 || walk.turn > 0) {
    end += sprintf(end, "walk_limits=%d:%d:%d:%d\n", thousandths(walk.forward), thousandths(walk.back),
                   thousandths(walk.left), thousandths(walk.turn));
  }
  return static_cast<size_t>(end - begin);
}

const char* decodeHello(const unsigned char* payload, size_t size, Hello* hello) {
  const char* const begin = reinterpret_cast<const char*>(payload);
  Text text = {begin, begin + size};
  if (size == 0 || text.end[-1] != '\n') {
    return "the hello does not end with a whole line";
  }
  bool is_there[KEY_COUNT] = {};
  *hello = Hello();
  while (!text.isEmpty()) {
    if (const char* problem = decodeLine(takeUntil('\n', &text), is_there, hello)) {
      return problem;
    }
  }
  for (int key = 0; key < REQUIRED_KEYS; ++key) {
    if (!is_there[key]) {
      return "the hello lacks robot, server, frame_number, capabilities or limits";
    }
  }
  return NULL;
}

}  // namespace version2
}  // namespace protocol
