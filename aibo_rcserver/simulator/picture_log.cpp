#include "simulator/picture_log.h"

#include <fcntl.h>
#include <unistd.h>

#include <boost/crc.hpp>
#include <cerrno>
#include <system_error>

// The file is also opened for reading. So a pipe can be opened before it has a reader, and stays open after its reader
// has left.
PictureLog::PictureLog(const std::string& path)
    : descriptor_(::open(path.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_NONBLOCK | O_CLOEXEC, 0666)) {
  if (descriptor_ < 0) {
    throw std::system_error(errno, std::generic_category(), "cannot open the picture log " + path);
  }
}

PictureLog::~PictureLog() {
  ::close(descriptor_);
}

void PictureLog::cameraImageTaken() {
  image_time_ = std::chrono::system_clock::now();
}

void PictureLog::aboutToSend(const void* data, std::size_t size) {
  if (pictures_.add(data, size)) {
    picture_time_ = image_time_;
  }
  if (!pictures_.isComplete()) {
    return;
  }
  const std::string& jpeg = pictures_.jpeg();
  boost::crc_32_type checksum;
  checksum.process_bytes(jpeg.data(), jpeg.size());
  const auto nanoseconds = std::chrono::duration_cast<std::chrono::nanoseconds>(picture_time_.time_since_epoch());
  const std::string line = std::to_string(nanoseconds.count()) + " " + std::to_string(jpeg.size()) + " " +
                           std::to_string(checksum.checksum()) + "\n";
  [[maybe_unused]] const auto written = ::write(descriptor_, line.data(), line.size());
}
