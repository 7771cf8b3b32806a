/// @file sentence.h
#ifndef AIBO_DRIVER_TEXT_SENTENCE_H
#define AIBO_DRIVER_TEXT_SENTENCE_H

#include <string>

namespace aibo_driver::text {

/// Adds a full stop, unless the text ends with a mark of its own. Some reasons end with a question to the user.
inline std::string sentence(const std::string& text) {
  const bool has_end = !text.empty() && std::string(".?!").find(text.back()) != std::string::npos;
  return has_end ? text : text + ".";
}

}  // namespace aibo_driver::text

#endif  // AIBO_DRIVER_TEXT_SENTENCE_H
