#include "picture_log.h"

#include <fcntl.h>
#include <unistd.h>

#include <boost/crc.hpp>
#include <cerrno>
#include <system_error>

#include "protocol/version1.h"
#include "protocol/version2.h"

namespace {

struct Jpeg {
  const unsigned char* bytes;
  std::size_t size;  ///< 0: there is none
};

Jpeg findVersion1Picture(const unsigned char* bytes, std::size_t size) {
  std::size_t jpeg_size = 0;
  if (size < protocol::PICTURE_HEADER_SIZE || !protocol::decodePictureHeader(bytes, &jpeg_size) ||
      size != protocol::PICTURE_HEADER_SIZE + jpeg_size) {
    return {};
  }
  return {bytes + protocol::PICTURE_HEADER_SIZE, jpeg_size};
}

Jpeg findVersion2Picture(const unsigned char* bytes, std::size_t size) {
  using namespace protocol::version2;
  if (size < FRAME_HEADER_SIZE) {
    return {};
  }
  const FrameHeader frame = decodeFrameHeader(bytes);
  ImageHeader image{};
  std::size_t jpeg_size = 0;
  if (frame.kind != PICTURE || size != FRAME_HEADER_SIZE + frame.payload_size ||
      decodePicture(bytes + FRAME_HEADER_SIZE, frame.payload_size, &image, &jpeg_size) != nullptr) {
    return {};
  }
  return {bytes + FRAME_HEADER_SIZE + IMAGE_HEADER_SIZE, jpeg_size};
}

}  // namespace

// For a pipe, reading is asked for as well: so it opens though nobody reads yet, and stays open when the reader goes.
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
  const auto* bytes = static_cast<const unsigned char*>(data);
  Jpeg jpeg = findVersion1Picture(bytes, size);
  if (jpeg.size == 0) {
    jpeg = findVersion2Picture(bytes, size);
  }
  if (jpeg.size == 0) {
    return;
  }
  boost::crc_32_type checksum;
  checksum.process_bytes(jpeg.bytes, jpeg.size);
  const auto nanoseconds = std::chrono::duration_cast<std::chrono::nanoseconds>(image_time_.time_since_epoch());
  const std::string line = std::to_string(nanoseconds.count()) + " " + std::to_string(jpeg.size) + " " +
                           std::to_string(checksum.checksum()) + "\n";
  [[maybe_unused]] const auto written = ::write(descriptor_, line.data(), line.size());
}
