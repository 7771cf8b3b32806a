/// @file picture_log_reader.h
#ifndef AIBO_DRIVER_TOOLS_PICTURE_LOG_READER_H
#define AIBO_DRIVER_TOOLS_PICTURE_LOG_READER_H

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

namespace aibo_driver::tools {

/// Reads what `aibo_rcserver --picture-log` writes: when the camera saw each picture that was sent.
///
/// Version 1 of the protocol carries no times, so the simulated robot logs them, one line for each picture: the
/// camera's time in nanoseconds since 1970, and the size in bytes and the CRC-32 of the JPEG, which identify the
/// picture. The log may be a file or a named pipe. Not thread-safe.
class PictureLogReader {
 public:
  using Time = std::chrono::time_point<std::chrono::system_clock, std::chrono::nanoseconds>;

  /// @param path of the log; it may still be empty
  /// @throw std::system_error if it cannot be opened
  explicit PictureLogReader(const std::string& path);
  ~PictureLogReader();

  PictureLogReader(const PictureLogReader&) = delete;
  PictureLogReader& operator=(const PictureLogReader&) = delete;

  /// Reads what has been written since the last call. Never waits.
  void readNewLines();

  /// When the camera saw this picture; empty if it is not in the lines read so far. Still photographs can make pictures
  /// that are equal byte for byte: then it is the last of them that the camera saw before the arrival.
  std::optional<Time> cameraTime(const std::vector<std::uint8_t>& jpeg, Time arrival) const;

 private:
  struct Entry {
    Time camera_time;
    std::uint64_t bytes;
    std::uint32_t checksum;
  };

  void takeLine(const std::string& line);

  int descriptor_;
  std::string unfinished_line_;
  std::deque<Entry> entries_;  // the oldest first
};

}  // namespace aibo_driver::tools

#endif  // AIBO_DRIVER_TOOLS_PICTURE_LOG_READER_H
