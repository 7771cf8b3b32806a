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

  /// Shows the names of files on the robot, one a line.
  /// @param kind of the files, such as "motions"
  /// @throw OutputException
  void names(const std::string& kind, const std::vector<std::string>& names);

  /// Tells the user something that is not a result. Never fails.
  void note(const std::string& words);

  /// Writes a picture to the standard output.
  /// @throw OutputException
  void bytes(const std::vector<std::uint8_t>& bytes);

  /// Writes a picture to a file of this computer, which replaces nothing but JPEGs.
  /// @param file of any folder; "-" is the standard output, which is for bytes alone from then on
  /// @return the file's absolute path, or "-"
  /// @throw OutputException
  /// @throw files::FileException as files::saveJpeg()
  std::string picture(const std::string& file, const std::vector<std::uint8_t>& jpeg);

 private:
  const bool json_;
  bool results_to_stderr_ = false;
};

}  // namespace aibo_driver::command_line

#endif  // AIBO_DRIVER_COMMAND_LINE_OUTPUT_H
