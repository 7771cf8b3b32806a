#include "text/plain_text.h"

#include "protocol/text.h"

namespace aibo_driver::text {
namespace {

/// The size of the UTF-8 character that this byte begins, if it begins one.
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

std::string plainLine(const std::string& text, std::size_t most) {
  std::string line;
  for (const std::string& character : charactersOf(text.substr(0, most))) {
    line += isPlain(character) ? character : "?";
  }
  return text.size() > most ? line + "..." : line;
}

void FirstThree::add(const std::string& one) {
  if (++count_ <= 3) {
    first_.push_back(plainLine(one, most_));
  }
}

std::string FirstThree::text(const std::string& separator) const {
  std::string all;
  for (const std::string& one : first_) {
    all += (all.empty() ? "" : separator) + one;
  }
  return count_ > first_.size() ? all + " and " + std::to_string(count_ - first_.size()) + " more" : all;
}

}  // namespace aibo_driver::text
