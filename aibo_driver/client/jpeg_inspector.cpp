#include "aibo_client/jpeg_inspector.h"

#include <array>
#include <cstring>
#include <utility>

namespace aibo_client {
namespace {

// The markers of ITU T.81, table B.1.
constexpr std::uint8_t kSof0 = 0xC0;
constexpr std::uint8_t kDht = 0xC4;
constexpr std::uint8_t kRst0 = 0xD0;
constexpr std::uint8_t kRst7 = 0xD7;
constexpr std::uint8_t kSoi = 0xD8;
constexpr std::uint8_t kEoi = 0xD9;
constexpr std::uint8_t kSos = 0xDA;
constexpr std::uint8_t kDqt = 0xDB;
constexpr std::uint8_t kDri = 0xDD;
constexpr std::uint8_t kApp0 = 0xE0;
constexpr std::uint8_t kApp14 = 0xEE;
constexpr std::uint8_t kApp15 = 0xEF;
constexpr std::uint8_t kCom = 0xFE;

constexpr std::size_t kComponents = 3;
constexpr std::size_t kFrameHeaderSize = 6 + 3 * kComponents;  // ITU T.81, B.2.2, without the length
constexpr std::size_t kScanHeaderSize = 4 + 2 * kComponents;   // ITU T.81, B.2.3, without the length

constexpr std::array<std::pair<int, int>, 8> kCameraSizes = {{{208, 160},
                                                              {104, 80},
                                                              {52, 40},
                                                              {kLargestPictureWidth, kLargestPictureHeight},
                                                              {176, 144},
                                                              {88, 72},
                                                              {44, 36},
                                                              {352, 288}}};

bool isCameraSize(int width, int height) {
  for (const auto& size : kCameraSizes) {
    if (size.first == width && size.second == height) {
      return true;
    }
  }
  return false;
}

/// Goes through a picture once, from SOI to EOI. Each step returns false once it has found a problem.
class MarkerWalk {
 public:
  MarkerWalk(const std::uint8_t* data, std::size_t size) : position_(data), end_(data + size) {}

  JpegInspection run() {
    if (remaining() < 2 || position_[0] != 0xFF || position_[1] != kSoi) {
      fail("not a JPEG: it does not begin with SOI");
      return result_;
    }
    position_ += 2;
    while (!in_scan_ && nextSegment()) {
    }
    if (in_scan_) {
      checkScanData();
    }
    return result_;
  }

 private:
  std::size_t remaining() const { return static_cast<std::size_t>(end_ - position_); }

  bool fail(const std::string& problem) {
    result_.problem = problem;
    return false;
  }

  static int read16(const std::uint8_t* at) { return at[0] << 8 | at[1]; }

  bool nextSegment() {
    if (remaining() < 1 || *position_ != 0xFF) {
      return fail(remaining() < 1 ? "cut off in its header" : "no marker where one is required");
    }
    while (remaining() > 0 && *position_ == 0xFF) {  // any number of fill bytes may precede a marker
      ++position_;
    }
    if (remaining() < 3) {
      return fail("cut off in its header");
    }
    const std::uint8_t marker = *position_++;
    const int length = read16(position_);
    if (length < 2 || static_cast<std::size_t>(length) > remaining()) {
      return fail(length < 2 ? "a segment of impossible length" : "cut off in its header");
    }
    const std::uint8_t* const segment = position_ + 2;
    position_ += length;
    return checkSegment(marker, segment, static_cast<std::size_t>(length) - 2);
  }

  bool checkSegment(std::uint8_t marker, const std::uint8_t* segment, std::size_t size) {
    switch (marker) {
      case kSof0:
        return checkFrame(segment, size);
      case kSos:
        return checkScan(segment, size);
      case kDqt:
        has_quantization_ = true;
        return true;
      case kDht:
        has_huffman_ = true;
        return true;
      case kApp14:
        return checkAdobe(segment, size);
      default:
        if (marker == kDri || marker == kCom || (marker >= kApp0 && marker <= kApp15)) {
          return true;
        }
        if (marker > kSof0 && marker < kRst0) {
          return fail("not a baseline JPEG (progressive, arithmetic, or another process)");
        }
        return fail("a marker that no camera writes");
    }
  }

  // Adobe's segment gives the meaning of the components: 0 is RGB, 1 is YCbCr.
  bool checkAdobe(const std::uint8_t* segment, std::size_t size) {
    const bool adobe = size >= 12 && std::memcmp(segment, "Adobe", 5) == 0;
    return !adobe || segment[11] == 1 || fail("its colours are not YCbCr");
  }

  bool checkFrame(const std::uint8_t* frame, std::size_t size) {
    if (frame_ != nullptr) {
      return fail("two frame headers");
    }
    if (size < 6) {
      return fail("a frame header of wrong length");
    }
    result_.height = read16(frame + 1);
    result_.width = read16(frame + 3);
    if (frame[0] != 8) {
      return fail("not 8 bits a sample");
    }
    if (frame[5] != kComponents) {
      return fail("not 3 colour components");
    }
    if (size != kFrameHeaderSize) {
      return fail("a frame header of wrong length");
    }
    if (!isCameraSize(result_.width, result_.height)) {
      return fail("a size that no camera has: " + std::to_string(result_.width) + "x" + std::to_string(result_.height));
    }
    frame_ = frame;
    return checkComponents();
  }

  bool checkComponents() {
    const std::uint8_t* const luma = frame_ + 6;
    const std::uint8_t* const first_chroma = luma + 3;
    const std::uint8_t* const second_chroma = luma + 6;
    if (luma[0] == 'R' && first_chroma[0] == 'G' && second_chroma[0] == 'B') {
      return fail("its colours are not YCbCr");
    }
    const bool luma_sane = luma[1] == 0x11 || luma[1] == 0x21 || luma[1] == 0x12 || luma[1] == 0x22;
    if (!luma_sane || first_chroma[1] != 0x11 || second_chroma[1] != 0x11) {
      return fail("an unusual subsampling");
    }
    return true;
  }

  bool checkScan(const std::uint8_t* scan, std::size_t size) {
    if (frame_ == nullptr) {
      return fail("no frame header before the scan");
    }
    if (!has_quantization_ || !has_huffman_) {
      return fail("its tables are missing");
    }
    if (size != kScanHeaderSize || scan[0] != kComponents) {
      return fail("not one scan of all components");
    }
    for (std::size_t i = 0; i < kComponents; ++i) {
      if (scan[1 + 2 * i] != frame_[6 + 3 * i]) {
        return fail("a scan of components that the frame does not have");
      }
    }
    const std::uint8_t* const progression = scan + 1 + 2 * kComponents;
    if (progression[0] != 0 || progression[1] != 63 || progression[2] != 0) {
      return fail("not a baseline scan");
    }
    in_scan_ = true;
    return true;
  }

  // In compressed data, 0xFF is followed by 0 or begins a restart marker. The first other marker has to be EOI.
  bool checkScanData() {
    while (remaining() >= 2) {
      const void* const found = std::memchr(position_, 0xFF, remaining() - 1);
      if (found == nullptr) {
        break;
      }
      const std::uint8_t* const marker = static_cast<const std::uint8_t*>(found) + 1;
      position_ = marker + 1;
      if (*marker == 0xFF) {
        position_ = marker;
      } else if (*marker == kEoi) {
        return position_ == end_ || fail("bytes after its end");
      } else if (*marker != 0 && (*marker < kRst0 || *marker > kRst7)) {
        return fail("a marker within its compressed data");
      }
    }
    return fail("cut off: it does not end with EOI");
  }

  const std::uint8_t* position_;
  const std::uint8_t* const end_;
  const std::uint8_t* frame_ = nullptr;  // the content of a good frame header; null before
  bool has_quantization_ = false;
  bool has_huffman_ = false;
  bool in_scan_ = false;
  JpegInspection result_;
};

}  // namespace

JpegInspection inspectJpeg(const std::uint8_t* data, std::size_t size) {
  return MarkerWalk(data, size).run();
}

}  // namespace aibo_client
