#include "command_line/plain_text.h"

#include <cstddef>

#include "protocol/text.h"

namespace aibo_driver::command_line {
namespace {

/// The size of the UTF-8 character that begins with this byte, if one does.
std::size_t announcedSize(char byte) {
  const auto first = static_cast<unsigned char>(byte);
  return first < 0x80 ? 1 : first < 0xE0 ? 2 : first < 0xF0 ? 3 : 4;
}

bool isPlain(const std::string& character) {
  return protocol::isPlainText(character.data(), character.size());
}

}  // namespace

std::vector<std::string> charactersOf(const std::string& text) {
  std::vector<std::string> characters;
  for (std::size_t at = 0; at < text.size(); at += characters.back().size()) {
    const std::string character = text.substr(at, announcedSize(text[at]));
    characters.push_back(isPlain(character) ? character : text.substr(at, 1));
  }
  return characters;
}

std::string plainText(const std::string& text) {
  std::string plain;
  for (const std::string& character : charactersOf(text)) {
    plain += character == "\n" || isPlain(character) ? character : "?";
  }
  return plain;
}

}  // namespace aibo_driver::command_line
