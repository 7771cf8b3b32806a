/// @file picture_log.h
#ifndef AIBO_RCSERVER_SIMULATOR_PICTURE_LOG_H
#define AIBO_RCSERVER_SIMULATOR_PICTURE_LOG_H

#include <chrono>
#include <cstddef>
#include <string>

#include "simulator/sent_pictures.h"

/// Logs when the camera took each picture that is sent, because version 1 of the protocol does not say so.
///
/// There is one line per picture: the time when the camera's image was handed to the objects, in nanoseconds since
/// 1970; the size of the JPEG in bytes; its CRC-32, decimal. aibo_monitor reads the log. A line is written before the
/// last bytes of the picture are sent, so a client that has the picture finds its line. The robot never waits: if a
/// pipe is full, lines are lost.
class PictureLog {
 public:
  /// @param path of a file, which is emptied, or of a named pipe
  /// @throw std::system_error if it cannot be opened
  explicit PictureLog(const std::string& path);
  ~PictureLog();

  PictureLog(const PictureLog&) = delete;
  PictureLog& operator=(const PictureLog&) = delete;

  /// The camera has delivered an image. Pictures whose first bytes are sent from now on show it.
  void cameraImageTaken();

  /// Bytes are about to be sent. Anything but pictures is ignored.
  void aboutToSend(const void* data, std::size_t size);

 private:
  int descriptor_;
  std::chrono::system_clock::time_point image_time_;    ///< of the camera's last image
  std::chrono::system_clock::time_point picture_time_;  ///< of the picture that is being sent
  SentPictures pictures_;
};

#endif  // AIBO_RCSERVER_SIMULATOR_PICTURE_LOG_H
