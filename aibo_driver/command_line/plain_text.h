/// @file plain_text.h
/// What comes from elsewhere and is shown to a person: a terminal obeys control characters, so none may reach it.
#ifndef AIBO_DRIVER_COMMAND_LINE_PLAIN_TEXT_H
#define AIBO_DRIVER_COMMAND_LINE_PLAIN_TEXT_H

#include <string>
#include <vector>

namespace aibo_driver::command_line {

/// Splits a text into those characters that protocol::isPlainText() allows, and the bytes between them, one by one.
std::vector<std::string> charactersOf(const std::string& text);

/// The text with '?' for each byte that belongs to no plain character, except for newlines.
std::string plainText(const std::string& text);

}  // namespace aibo_driver::command_line

#endif  // AIBO_DRIVER_COMMAND_LINE_PLAIN_TEXT_H
