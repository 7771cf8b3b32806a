#include <cstddef>
#include <stdexcept>

#include "motion_tool/motion_tool.h"
#include "mtn/layout.h"

namespace motion_tool {
namespace {

// Appends the lowest bytes of a number.
void append(std::string& bytes, std::size_t value, int size) {
  for (int i = 0; i < size; ++i) {
    bytes.push_back(static_cast<char>(value >> (8 * i)));
  }
}

void appendText(std::string& bytes, const std::string& text) {
  if (text.size() > mtn::MAX_TEXT_SIZE) {
    throw std::runtime_error("a text has more than " + std::to_string(mtn::MAX_TEXT_SIZE) + " characters: " + text);
  }
  bytes.push_back(static_cast<char>(text.size()));
  bytes += text;
}

std::string section(std::size_t number, std::string content) {
  while (content.size() % 4 != 0) {
    content.push_back('\0');
  }
  std::string bytes;
  append(bytes, number, 4);
  append(bytes, mtn::SECTION_HEADER_SIZE + content.size(), 4);
  return bytes + content;
}

std::string generalSection(const KeyFrameMotion& motion) {
  std::string content;
  append(content, mtn::NUMBER_OF_SECTIONS, 4);
  append(content, mtn::MAJOR_VERSION, 2);
  append(content, mtn::MINOR_VERSION, 2);
  append(content, motion.key_frames.size(), 2);
  append(content, static_cast<std::size_t>(motion.frame_milliseconds), 2);
  append(content, 0, 4);
  return section(0, content);
}

std::string textSection(const KeyFrameMotion& motion) {
  std::string content;
  appendText(content, motion.name);
  appendText(content, motion.creator);
  appendText(content, motion.design);
  return section(1, content);
}

std::string locatorSection(const KeyFrameMotion& motion) {
  std::string content;
  append(content, motion.locators.size(), 2);
  for (const std::string& locator : motion.locators) {
    appendText(content, locator);
  }
  return section(2, content);
}

std::string keyFrameSection(const KeyFrameMotion& motion) {
  std::string content;
  append(content, 0, 4);
  for (std::size_t i = 0; i < motion.key_frames.size(); ++i) {
    if (i > 0) {
      const int step = motion.key_frames[i].milliseconds - motion.key_frames[i - 1].milliseconds;
      append(content, static_cast<std::size_t>(step / motion.frame_milliseconds - 1), 4);  // interpolated frames
    }
    content.append(mtn::VALUES_OF_BODY * mtn::VALUE_SIZE, '\0');
    for (const int position : motion.key_frames[i].positions) {
      append(content, static_cast<std::size_t>(position), 4);
    }
  }
  return section(3, content);
}

}  // namespace

std::string encodeMtn(const KeyFrameMotion& motion) {
  const std::string bytes =
      mtn::MAGIC + generalSection(motion) + textSection(motion) + locatorSection(motion) + keyFrameSection(motion);
  mtn::Motion read;
  if (!read.read(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size())) {
    throw std::runtime_error(read.problem());
  }
  return bytes;
}

}  // namespace motion_tool
