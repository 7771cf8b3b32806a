/// @file output.h
#ifndef AIBO_DRIVER_COMMAND_LINE_OUTPUT_H
#define AIBO_DRIVER_COMMAND_LINE_OUTPUT_H

#include <cstdint>
#include <string>
#include <vector>

#include "aibo_driver/exceptions.h"
#include "command_line/json.h"

namespace aibo_driver::command_line {

/// The standard output takes no more, for instance because the disk is full.
class OutputException : public Exception {
 public:
  using Exception::Exception;
};

/// Where a command's results go: to the standard output, in words or as JSON. Notes and errors go to the standard error
/// output. Nothing of it contains control characters. From one thread.
class Output {
 public:
  explicit Output(bool json) : json_(json) {}

  bool json() const { return json_; }

  /// From now on the standard output is for bytes alone, and results go to the standard error output.
  void leaveStandardOutputToBytes() { results_to_stderr_ = true; }

  /// Shows a result, in one of two ways.
  /// @param words lines without the last newline
  /// @throw OutputException
  void result(const std::string& words, const Json& json);

  /// Tells the user something that is not a result. Never fails.
  void note(const std::string& words);

  /// Writes a picture to the standard output.
  /// @throw OutputException
  void bytes(const std::vector<std::uint8_t>& bytes);

 private:
  const bool json_;
  bool results_to_stderr_ = false;
};

}  // namespace aibo_driver::command_line

#endif  // AIBO_DRIVER_COMMAND_LINE_OUTPUT_H
