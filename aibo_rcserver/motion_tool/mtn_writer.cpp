#include <cstddef>
#include <cstdint>
#include <stdexcept>

#include "motion_tool/motion_tool.h"
#include "mtn/layout.h"

namespace motion_tool {
namespace {

void append(std::string& bytes, std::uint32_t value, int size) {
  for (int i = 0; i < size; ++i) {
    bytes.push_back(static_cast<char>(value >> (8 * i)));
  }
}

void append16(std::string& bytes, std::size_t value) {
  append(bytes, static_cast<std::uint32_t>(value), 2);
}

void append32(std::string& bytes, std::size_t value) {
  append(bytes, static_cast<std::uint32_t>(value), 4);
}

void appendText(std::string& bytes, const std::string& text) {
  if (text.size() > mtn::MAX_TEXT_SIZE) {
    throw std::runtime_error("a text has more than " + std::to_string(mtn::MAX_TEXT_SIZE) + " characters: " + text);
  }
  bytes.push_back(static_cast<char>(text.size()));
  bytes += text;
}

std::string section(std::uint32_t number, std::string content) {
  while (content.size() % 4 != 0) {
    content.push_back('\0');
  }
  std::string bytes;
  append32(bytes, number);
  append32(bytes, mtn::SECTION_HEADER_SIZE + content.size());
  return bytes + content;
}

std::string generalSection(const KeyFrameMotion& motion) {
  std::string content;
  append32(content, mtn::NUMBER_OF_SECTIONS);
  append16(content, mtn::MAJOR_VERSION);
  append16(content, mtn::MINOR_VERSION);
  append16(content, motion.key_frames.size());
  append16(content, static_cast<std::size_t>(motion.frame_milliseconds));
  append32(content, 0);
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
  append16(content, motion.locators.size());
  for (const std::string& locator : motion.locators) {
    appendText(content, locator);
  }
  return section(2, content);
}

std::string keyFrameSection(const KeyFrameMotion& motion) {
  std::string content;
  append32(content, 0);
  for (std::size_t i = 0; i < motion.key_frames.size(); ++i) {
    if (i > 0) {
      const int step = motion.key_frames[i].milliseconds - motion.key_frames[i - 1].milliseconds;
      append32(content, static_cast<std::size_t>(step / motion.frame_milliseconds - 1));  // interpolated frames
    }
    content.append(mtn::VALUES_OF_BODY * mtn::VALUE_SIZE, '\0');
    for (const int position : motion.key_frames[i].positions) {
      append32(content, static_cast<std::uint32_t>(position));
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
