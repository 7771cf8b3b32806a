#include "command_line/quantities.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <set>

#include "aibo_client/exceptions.h"

namespace aibo_driver::command_line {
namespace {

struct Unit {
  const char* name;
  double size;
};

/// @param allowed what the user should write instead
[[noreturn]] void refuse(const std::string& what, const std::string& text, const std::string& allowed) {
  throw aibo_client::InvalidArgumentException(what + " cannot be '" + text + "': give " + allowed);
}

/// Splits a text into its number and the rest.
double readNumber(const std::string& what, const std::string& text, const std::string& allowed, std::string* rest) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || !std::isfinite(number)) {
    refuse(what, text, allowed);
  }
  *rest = end;
  return number;
}

double parseWithUnit(const std::string& what, const std::string& text, const std::vector<Unit>& units,
                     const std::string& allowed) {
  std::string rest;
  const double number = readNumber(what, text, allowed, &rest);
  for (const Unit& unit : units) {
    if (rest == unit.name) {
      return number * unit.size;
    }
  }
  refuse(what, text, allowed);
}

Assignment parseAssignment(const std::string& word, const std::string& example) {
  const std::size_t equals = word.find('=');
  if (equals == std::string::npos || equals == 0 || equals + 1 == word.size()) {
    throw aibo_client::InvalidArgumentException("'" + word + "' has to have the form NAME=VALUE, such as " + example);
  }
  return {word.substr(0, equals), word.substr(equals + 1)};
}

}  // namespace

std::vector<Assignment> parseAssignments(const std::vector<std::string>& words, const std::string& example) {
  std::vector<Assignment> assignments(words.size());
  std::transform(words.begin(), words.end(), assignments.begin(),
                 [&](const std::string& word) { return parseAssignment(word, example); });
  std::set<std::string> names;
  for (const Assignment& each : assignments) {
    if (!names.insert(each.name).second) {
      throw aibo_client::InvalidArgumentException(each.name + " is given twice");
    }
  }
  return assignments;
}

double parseAngle(const std::string& what, const std::string& text) {
  return parseWithUnit(what, text, {{"deg", M_PI / 180}, {"rad", 1}}, "a number with its unit: 30deg or 0.52rad");
}

double parseAngularSpeed(const std::string& what, const std::string& text) {
  return parseWithUnit(what, text, {{"deg/s", M_PI / 180}, {"rad/s", 1}},
                       "a number with its unit: 30deg/s or 0.52rad/s");
}

double parseSpeed(const std::string& what, const std::string& text) {
  return parseWithUnit(what, text, {{"m/s", 1}, {"cm/s", 0.01}, {"mm/s", 0.001}},
                       "a number with its unit: 0.1m/s, 10cm/s or 100mm/s");
}

double parseNumber(const std::string& what, const std::string& text, double lowest, double highest) {
  char allowed[64];
  std::snprintf(allowed, sizeof allowed, "a number from %g to %g", lowest, highest);
  std::string rest;
  const double number = readNumber(what, text, allowed, &rest);
  if (!rest.empty() || number < lowest || number > highest) {
    refuse(what, text, allowed);
  }
  return number;
}

int parseWholeNumber(const std::string& what, const std::string& text, int lowest, int highest) {
  const std::string allowed = "a whole number from " + std::to_string(lowest) + " to " + std::to_string(highest);
  std::string rest;
  const double number = readNumber(what, text, allowed, &rest);
  if (!rest.empty() || number < lowest || number > highest || number != std::floor(number)) {
    refuse(what, text, allowed);
  }
  return static_cast<int>(number);
}

double degrees(double radian) {
  return radian * 180 / M_PI;
}

std::string counted(std::uint64_t number, const std::string& thing) {
  return std::to_string(number) + " " + thing + (number == 1 ? "" : "s");
}

std::chrono::nanoseconds nanosecondsOf(double seconds) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(seconds));
}

}  // namespace aibo_driver::command_line
