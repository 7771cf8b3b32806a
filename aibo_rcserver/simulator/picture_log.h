/// @file picture_log.h
#ifndef AIBO_RCSERVER_SIMULATOR_PICTURE_LOG_H
#define AIBO_RCSERVER_SIMULATOR_PICTURE_LOG_H

#include <chrono>
#include <cstddef>
#include <string>

#include "simulator/sent_pictures.h"

/// Logs the time at which the camera took each picture that is sent, because version 1 of the protocol does not
/// transmit it.
///
/// Each line has the time when the objects got the camera's image, in nanoseconds since 1970; the size of the JPEG in
/// bytes; and its CRC-32, in decimal. aibo_monitor reads the log. A line is written before the last bytes of its
/// picture are sent, so a client with the picture finds it. The robot never waits: if a pipe is full, lines are lost.
class PictureLog {
 public:
  /// @param path a file, which is emptied, or a named pipe
  /// @throw std::system_error the file cannot be opened
  explicit PictureLog(const std::string& path);
  ~PictureLog();

  PictureLog(const PictureLog&) = delete;
  PictureLog& operator=(const PictureLog&) = delete;

  /// Call when the camera has delivered an image. Pictures that begin from now on show it.
  void cameraImageTaken();

  /// Call before bytes are sent. It ignores everything but pictures.
  void aboutToSend(const void* data, std::size_t size);

 private:
  int descriptor_;
  std::chrono::system_clock::time_point image_time_;
  std::chrono::system_clock::time_point picture_time_;  ///< for the picture that is being sent
  SentPictures pictures_;
};

#endif  // AIBO_RCSERVER_SIMULATOR_PICTURE_LOG_H
