/// @file plain_text.h
/// What comes from elsewhere and is shown to a person, in a log, a message or a terminal. A terminal obeys control
/// characters, so none may reach it; and what a stranger sends may be a million texts, or one of a gigabyte.
#ifndef AIBO_DRIVER_TEXT_PLAIN_TEXT_H
#define AIBO_DRIVER_TEXT_PLAIN_TEXT_H

#include <cstddef>
#include <string>
#include <vector>

namespace aibo_driver::text {

/// Splits a text into those characters that protocol::isPlainText() allows, and the bytes between them, one by one.
std::vector<std::string> charactersOf(const std::string& text);

/// The text with '?' for each byte that belongs to no plain character, except for newlines.
std::string plainText(const std::string& text);

/// The text on one line: newlines become '?', too.
/// @param most bytes; a longer text is cut, and ends with "..."
std::string plainLine(const std::string& text, std::size_t most = 80);

/// The first three of any number of things, for a message about all of them. Each is shown by plainLine().
class FirstThree {
 public:
  /// @param most bytes of each
  explicit FirstThree(std::size_t most = 80) : most_(most) {}

  void add(const std::string& one);

  bool empty() const { return count_ == 0; }
  std::size_t count() const { return count_; }

  /// "a, b, c and 2 more"
  /// @param separator between those that are shown
  std::string text(const std::string& separator = ", ") const;

 private:
  std::size_t most_;
  std::vector<std::string> first_;
  std::size_t count_ = 0;
};

}  // namespace aibo_driver::text

#endif  // AIBO_DRIVER_TEXT_PLAIN_TEXT_H
