/// @file quantities.h
/// NAME=VALUE with units, as users type them. Angles and lengths need a unit: if somebody meant 30 degrees and we took
/// them for radians, the joint would move to its limit.
#ifndef AIBO_DRIVER_COMMAND_LINE_QUANTITIES_H
#define AIBO_DRIVER_COMMAND_LINE_QUANTITIES_H

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

namespace aibo_driver::command_line {

struct Assignment {
  std::string name;
  std::string value;
};

/// @param example an example for the message, such as "head_pan=30deg"
/// @throw InvalidArgumentException a word has no '=', or nothing on one side of it, or a name
///   appears twice
std::vector<Assignment> parseAssignments(const std::vector<std::string>& words, const std::string& example);

// Each of these functions throws InvalidArgumentException if the text is not such a quantity, or is not finite. `what`
// names the quantity in the message.

/// @param text for example 30deg or -0.5rad
/// @return rad
double parseAngle(const std::string& what, const std::string& text);

/// @param text for example 30deg/s or 0.5rad/s
/// @return rad/s
double parseAngularSpeed(const std::string& what, const std::string& text);

/// @param text for example 0.1m/s, -5cm/s or 80mm/s
/// @return m/s
double parseSpeed(const std::string& what, const std::string& text);

/// @return the number, without a unit
double parseNumber(const std::string& what, const std::string& text, double lowest, double highest);

/// @return the number, from lowest to highest
int parseWholeNumber(const std::string& what, const std::string& text, int lowest, int highest);

double degrees(double radian);

/// @param thing the name of the thing, in the singular
/// @return a text such as "1 picture" or "2 pictures"
std::string counted(std::uint64_t number, const std::string& thing);

/// @param seconds below 9e9
std::chrono::nanoseconds nanosecondsOf(double seconds);

}  // namespace aibo_driver::command_line

#endif  // AIBO_DRIVER_COMMAND_LINE_QUANTITIES_H
