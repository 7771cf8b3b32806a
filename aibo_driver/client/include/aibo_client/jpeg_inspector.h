/// @file jpeg_inspector.h
/// Separates whole camera pictures from damaged or hostile ones without decoding them.
#ifndef AIBO_CLIENT_JPEG_INSPECTOR_H
#define AIBO_CLIENT_JPEG_INSPECTOR_H

#include <cstddef>
#include <cstdint>
#include <string>

namespace aibo_client {

/// The size in pixels of the largest picture of these robots' cameras: the ERS-7's 208x160 in double resolution. The
/// RCServer compresses no larger picture.
constexpr int kLargestPictureWidth = 416;
constexpr int kLargestPictureHeight = 320;

/// The result of inspectJpeg().
struct JpegInspection {
  int width = 0;        ///< pixels; 0 if the frame header was not reached
  int height = 0;       ///< pixels; 0 if the frame header was not reached
  std::string problem;  ///< what is wrong with the picture; empty if it is good

  bool good() const { return problem.empty(); }
};

/// Checks that the bytes are one whole picture as the RCServer sends them, by walking its markers.
///
/// A good picture is a baseline JPEG (SOF0: neither progressive nor arithmetic) of 8 bit YCbCr, in 4:4:4, 4:2:2, 4:4:0
/// or 4:2:0, in one scan. It begins with SOI and ends with EOI, and nothing follows. Its size is one of the camera of
/// the ERS-7 (208x160, its layers 104x80 and 52x40, and 416x320) or of the ERS-210 (176x144, 88x72, 44x36, 352x288). So
/// nothing larger than 416x320 is ever decoded, whatever a header announces. No picture takes longer to decode than its
/// size justifies.
///
/// Damage inside the compressed data is not found; only a decoder finds it.
///
/// @param data not null unless size is 0
/// @param size bytes
JpegInspection inspectJpeg(const std::uint8_t* data, std::size_t size);

}  // namespace aibo_client

#endif  // AIBO_CLIENT_JPEG_INSPECTOR_H
