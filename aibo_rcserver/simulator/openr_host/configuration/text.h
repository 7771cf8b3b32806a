/// @file text.h
/// Lines of configuration files, taken apart.
#ifndef AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONFIGURATION_TEXT_H
#define AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONFIGURATION_TEXT_H

#include <string>
#include <vector>

namespace openr_host {

/// Blanks, tabs, and the carriage return at the end of a line that was written on Windows.
constexpr char kSpace[] = " \t\r";

/// The text without the kSpace before and after it.
std::string withoutSpaceAround(const std::string& text);

/// The parts between the separators: one more than there are separators. A part may be empty.
std::vector<std::string> splitAt(char separator, const std::string& text);

}  // namespace openr_host

#endif  // AIBO_RCSERVER_SIMULATOR_OPENR_HOST_CONFIGURATION_TEXT_H
