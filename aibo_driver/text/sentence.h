/// @file sentence.h
/// Parts of sentences for users.
#ifndef AIBO_DRIVER_TEXT_SENTENCE_H
#define AIBO_DRIVER_TEXT_SENTENCE_H

#include <cmath>
#include <cstdio>
#include <string>

namespace aibo_driver::text {

/// Adds a full stop, unless the text ends with a mark of its own. Some reasons end with a question to the user.
inline std::string sentence(const std::string& text) {
  const bool has_end = !text.empty() && std::string(".?!").find(text.back()) != std::string::npos;
  return has_end ? text : text + ".";
}

/// Writes a number, as in "0.25".
/// @param digits how many digits follow the point. A number beyond 1e15 has an exponent instead, because nobody reads
///     300 digits.
inline std::string decimal(double value, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, std::abs(value) < 1e15 ? "%.*f" : "%.*g", digits, value);
  return text;
}

}  // namespace aibo_driver::text

#endif  // AIBO_DRIVER_TEXT_SENTENCE_H
