/// @file output.h
#ifndef AIBO_DRIVER_COMMAND_LINE_OUTPUT_H
#define AIBO_DRIVER_COMMAND_LINE_OUTPUT_H

#include <cstdint>
#include <string>
#include <vector>

#include "aibo_client/exceptions.h"
#include "text/json.h"

namespace aibo_driver::command_line {

using text::Json;

/// Thrown if the standard output accepts no more, for example because the disk is full.
class OutputException : public aibo_client::Exception {
 public:
  using Exception::Exception;
};

/// The destination of a command's results. They go to the standard output, in words or as JSON. Notes and errors go to
/// the standard error output. Control characters never appear. Only one thread may use it.
class Output {
 public:
  explicit Output(bool json) : json_(json) {}

  bool json() const { return json_; }

  /// From now on the standard output is only for bytes, and results go to the standard error output.
  void leaveStandardOutputToBytes() { results_to_stderr_ = true; }

  /// Shows a result, in words or as JSON.
  /// @param words the result as lines of text, without a newline at the end
  /// @throw OutputException writing to the standard output failed
  void result(const std::string& words, const Json& json);

  /// Tells the user something that is not a result. It never fails.
  void note(const std::string& words);

  /// Writes a picture to the standard output.
  /// @throw OutputException
  void bytes(const std::vector<std::uint8_t>& bytes);

  /// Writes a picture to a file of this computer. It replaces only files that are JPEGs.
  /// @param file a file in any folder, a pipe or a device; "-" means the standard output. If the file is the standard
  ///   output, or leads to it, the standard output is from then on only for bytes
  /// @return the file's absolute path, or "-"
  /// @throw OutputException the standard output accepts no more
  /// @throw files::FileException files::saveJpeg() fails
  std::string picture(const std::string& file, const std::vector<std::uint8_t>& jpeg);

 private:
  const bool json_;
  bool results_to_stderr_ = false;
};

}  // namespace aibo_driver::command_line

#endif  // AIBO_DRIVER_COMMAND_LINE_OUTPUT_H
