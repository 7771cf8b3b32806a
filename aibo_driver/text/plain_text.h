/// @file plain_text.h
/// Texts that come from elsewhere and are shown to a person, in a log, a message or a terminal. A terminal obeys
/// control characters, so none may reach it. A stranger may also send a million texts, or a text of a gigabyte.
#ifndef AIBO_DRIVER_TEXT_PLAIN_TEXT_H
#define AIBO_DRIVER_TEXT_PLAIN_TEXT_H

#include <cstddef>
#include <string>
#include <vector>

namespace aibo_driver::text {

/// Splits a text into the characters that protocol::isPlainText() allows, and the single bytes between them.
std::vector<std::string> charactersOf(const std::string& text);

/// Puts '?' in the place of each byte that belongs to no plain character. Newlines stay.
std::string plainText(const std::string& text);

/// Puts the text on one line. Newlines become '?', too.
/// @param most the most bytes that the line has; a longer text is cut and ends with "..."
std::string plainLine(const std::string& text, std::size_t most = 80);

/// The first three of any number of things, for a message about all of them. Each is shown as by plainLine().
class FirstThree {
 public:
  /// @param most the most bytes of each thing
  explicit FirstThree(std::size_t most = 80) : most_(most) {}

  void add(const std::string& one);

  bool empty() const { return count_ == 0; }
  std::size_t count() const { return count_; }

  /// The things as one text, such as "a, b, c and 2 more".
  /// @param separator the text between the things that are shown
  std::string text(const std::string& separator = ", ") const;

 private:
  std::size_t most_;
  std::vector<std::string> first_;
  std::size_t count_ = 0;
};

}  // namespace aibo_driver::text

#endif  // AIBO_DRIVER_TEXT_PLAIN_TEXT_H
