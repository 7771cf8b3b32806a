#include "mtn/motion.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

namespace mtn {

namespace {

const char LOCATOR_BEGINNING[] = "PRM:";

unsigned decode16(const unsigned char* in) {
  return static_cast<unsigned>(in[0]) | (static_cast<unsigned>(in[1]) << 8);
}

unsigned decode32(const unsigned char* in) {
  return decode16(in) | (decode16(in + 2) << 16);
}

int decodeSigned32(const unsigned char* in) {
  return static_cast<int>(decode32(in));
}

// True if the text has only visible characters. This is required because locators go into messages and to the robot.
bool isPlain(const char* text) {
  for (; *text != '\0'; ++text) {
    if (*text <= ' ' || *text > '~') {
      return false;
    }
  }
  return true;
}

}  // namespace

const size_t Motion::MAX_PROBLEM_SIZE;

/// The unread part of a section.
struct Motion::Section {
  unsigned number;
  const unsigned char* bytes;
  size_t size;

  bool has(size_t wanted) const { return wanted <= size; }
  const unsigned char* take(size_t taken) {
    const unsigned char* const begin = bytes;
    bytes += taken;
    size -= taken;
    return begin;
  }
};

Motion::Motion() {
  problem_[0] = '\0';
  clear();
}

bool Motion::read(const unsigned char* bytes, size_t size) {
  problem_[0] = '\0';
  if (readAll(bytes, size)) {
    return true;
  }
  clear();
  return false;
}

int Motion::position(int key_frame, int joint) const {
  return decodeSigned32(keyFrame(key_frame) + static_cast<size_t>(VALUES_OF_BODY + joint) * VALUE_SIZE);
}

int Motion::milliseconds(int key_frame) const {
  if (key_frame == 0) {
    return 0;
  }
  const unsigned interpolated = decode32(keyFrame(key_frame) - VALUE_SIZE);
  return static_cast<int>(interpolated + 1) * frame_milliseconds_;
}

void Motion::clear() {
  name_[0] = '\0';
  creator_[0] = '\0';
  design_[0] = '\0';
  frame_milliseconds_ = 0;
  number_of_joints_ = 0;
  number_of_key_frames_ = 0;
  key_frames_ = NULL;
}

bool Motion::readAll(const unsigned char* bytes, size_t size) {
  if (size > MAX_FILE_SIZE) {
    return fail("it has %lu bytes, and at most %lu are allowed", static_cast<unsigned long>(size),
                static_cast<unsigned long>(MAX_FILE_SIZE));
  }
  if (size > 1 && bytes[0] == 0x1f && bytes[1] == 0x8b) {
    return fail("it is gzipped; gzip -d unpacks it, and so do aibo upload and upload_motion");
  }
  if (size < MAGIC_SIZE || memcmp(bytes, MAGIC, MAGIC_SIZE) != 0) {
    return fail("it does not begin with %s", MAGIC);
  }
  bytes += MAGIC_SIZE;
  size -= MAGIC_SIZE;
  Section section;
  const bool is_read = openSection(0, &bytes, &size, &section) && readGeneral(&section) &&
                       openSection(1, &bytes, &size, &section) && readTexts(&section) &&
                       openSection(2, &bytes, &size, &section) && readLocators(&section) &&
                       openSection(3, &bytes, &size, &section) && readKeyFrames(&section);
  if (!is_read) {
    return false;
  }
  return size == 0 || fail("%lu bytes follow the last section", static_cast<unsigned long>(size));
}

// Checks the header of the first section, and removes this section from the bytes.
bool Motion::openSection(unsigned number, const unsigned char** bytes, size_t* size, Section* section) {
  if (*size < SECTION_HEADER_SIZE) {
    return fail("it ends before section %u", number);
  }
  const unsigned found = decode32(*bytes);
  if (found != number) {
    return fail("section %u is expected, but the file has section %u", number, found);
  }
  const size_t section_size = decode32(*bytes + 4);
  if (section_size < SECTION_HEADER_SIZE) {
    return fail("section %u claims to have %lu bytes", number, static_cast<unsigned long>(section_size));
  }
  if (section_size > *size) {
    return fail("section %u is cut off: %lu bytes of %lu are there", number, static_cast<unsigned long>(*size),
                static_cast<unsigned long>(section_size));
  }
  section->number = number;
  section->bytes = *bytes;
  section->size = section_size;
  section->take(SECTION_HEADER_SIZE);
  *bytes += section_size;
  *size -= section_size;
  return true;
}

bool Motion::readGeneral(Section* section) {
  if (!section->has(FIRST_SECTION_SIZE - SECTION_HEADER_SIZE)) {
    return fail("section 0 is shorter than %lu bytes", static_cast<unsigned long>(FIRST_SECTION_SIZE));
  }
  const unsigned sections = decode32(section->take(4));
  const unsigned major_version = decode16(section->take(2));
  const unsigned minor_version = decode16(section->take(2));
  const unsigned key_frames = decode16(section->take(2));
  const int milliseconds = static_cast<int>(decode16(section->take(2)));
  if (sections != NUMBER_OF_SECTIONS) {
    return fail("it claims to have %u sections, not %u", sections, NUMBER_OF_SECTIONS);
  }
  if (major_version != MAJOR_VERSION) {
    return fail("its format is version %u.%u, but only version %u is supported", major_version, minor_version,
                MAJOR_VERSION);
  }
  if (key_frames == 0) {
    return fail("it has no key frames");
  }
  if (milliseconds < MIN_FRAME_MILLISECONDS || milliseconds > MAX_FRAME_MILLISECONDS) {
    return fail("a frame of %d ms is outside %d..%d ms", milliseconds, MIN_FRAME_MILLISECONDS, MAX_FRAME_MILLISECONDS);
  }
  number_of_key_frames_ = static_cast<int>(key_frames);
  frame_milliseconds_ = milliseconds;
  return true;
}

bool Motion::readTexts(Section* section) {
  return takeText(section, "the motion's name", MAX_TEXT_SIZE, name_) &&
         takeText(section, "the creator's name", MAX_TEXT_SIZE, creator_) &&
         takeText(section, "the robot's design", MAX_TEXT_SIZE, design_);
}

bool Motion::readLocators(Section* section) {
  if (!section->has(2)) {
    return fail("section 2 has no number of joints");
  }
  const int count = static_cast<int>(decode16(section->take(2)));
  if (count == 0 || count > MAX_JOINTS) {
    return fail("%d joints are outside 1..%d", count, MAX_JOINTS);
  }
  for (int i = 0; i < count; ++i) {
    if (!readLocator(section, i)) {
      return false;
    }
  }
  number_of_joints_ = count;
  return true;
}

bool Motion::readLocator(Section* section, int joint) {
  char* const locator = locators_[joint];
  if (!takeText(section, "a joint's locator", MAX_LOCATOR_SIZE, locator)) {
    return false;
  }
  if (!isPlain(locator) || strncmp(locator, LOCATOR_BEGINNING, strlen(LOCATOR_BEGINNING)) != 0) {
    return fail("joint %d has no locator that begins with %s", joint, LOCATOR_BEGINNING);
  }
  for (int i = 0; i < joint; ++i) {
    if (strcmp(locators_[i], locator) == 0) {
      return fail("joints %d and %d are both %s", i, joint, locator);
    }
  }
  return true;
}

bool Motion::readKeyFrames(Section* section) {
  if (!section->has(4)) {
    return fail("section 3 has no type of data");
  }
  const unsigned type = decode32(section->take(4));
  if (type != 0) {
    return fail("section 3 holds data of type %u, but only type 0 is supported", type);
  }
  const size_t expected = static_cast<size_t>(number_of_key_frames_) * keyFrameSize() - VALUE_SIZE;
  if (section->size != expected) {
    return fail("section 3 holds %lu bytes of key frames, but %d key frames of %d joints have %lu",
                static_cast<unsigned long>(section->size), number_of_key_frames_, number_of_joints_,
                static_cast<unsigned long>(expected));
  }
  key_frames_ = section->bytes;
  for (int i = 0; i < number_of_key_frames_; ++i) {
    if (!checkKeyFrame(i)) {
      return false;
    }
  }
  return true;
}

bool Motion::checkKeyFrame(int key_frame) {
  const unsigned most_interpolated = static_cast<unsigned>(MAX_STEP_MILLISECONDS / frame_milliseconds_ - 1);
  const unsigned interpolated = key_frame > 0 ? decode32(keyFrame(key_frame) - VALUE_SIZE) : 0;
  if (interpolated > most_interpolated) {
    return fail("%u frames to key frame %d are more than %d s", interpolated, key_frame, MAX_STEP_MILLISECONDS / 1000);
  }
  for (int joint = 0; joint < number_of_joints_; ++joint) {
    const int at = position(key_frame, joint);
    if (at < -MAX_POSITION || at > MAX_POSITION) {
      return fail("in key frame %d, %s is at %d microradians, more than a turn", key_frame, locators_[joint], at);
    }
  }
  return true;
}

// Takes a text. Some programs end a text with a zero byte, which is not part of the text.
bool Motion::takeText(Section* section, const char* what, size_t max_size, char* text) {
  if (!section->has(1)) {
    return fail("section %u ends before %s", section->number, what);
  }
  const size_t size = *section->take(1);
  if (!section->has(size)) {
    return fail("section %u ends within %s", section->number, what);
  }
  if (size > max_size) {
    return fail("%s has %lu characters, more than %lu", what, static_cast<unsigned long>(size),
                static_cast<unsigned long>(max_size));
  }
  memcpy(text, section->take(size), size);
  text[size] = '\0';
  return true;
}

bool Motion::fail(const char* format, ...) {
  va_list values;
  va_start(values, format);
  vsprintf(problem_, format, values);
  va_end(values);
  return false;
}

// The size of a key frame with the number of interpolated frames before it, which the first key frame lacks.
size_t Motion::keyFrameSize() const {
  return (static_cast<size_t>(VALUES_OF_BODY + number_of_joints_) + 1) * VALUE_SIZE;
}

const unsigned char* Motion::keyFrame(int key_frame) const {
  return key_frames_ + static_cast<size_t>(key_frame) * keyFrameSize();
}

}  // namespace mtn
