#include "aibo_client/jpeg_inspector.h"

#include <cstring>

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

constexpr int kComponents = 3;
constexpr int kFrameHeaderSize = 6 + 3 * kComponents;  // ITU T.81, B.2.2, without the length
constexpr int kScanHeaderSize = 4 + 2 * kComponents;   // ITU T.81, B.2.3, without the length

// The layers of the cameras, from low to double: each is twice as large as the one before.
constexpr int kLowestLayers[][2] = {{52, 40}, {44, 36}};  // ERS-7, ERS-210
constexpr int kLayers = 4;

bool isCameraSize(int width, int height) {
  for (const auto& [low_width, low_height] : kLowestLayers) {
    for (int layer = 0; layer < kLayers; ++layer) {
      if (width == low_width << layer && height == low_height << layer) {
        return true;
      }
    }
  }
  return false;
}

constexpr char kCutOff[] = "cut off in its header";
constexpr char kStrange[] = "a header that no camera writes";

/// Goes through a picture once, from SOI to EOI. Each function returns what is wrong; empty if nothing is.
class MarkerWalk {
 public:
  MarkerWalk(const std::uint8_t* data, std::size_t size) : position_(data), end_(data + size) {}

  JpegInspection run() {
    result_.problem = problemOfPicture();
    return result_;
  }

 private:
  std::size_t remaining() const { return static_cast<std::size_t>(end_ - position_); }

  static int read16(const std::uint8_t* at) { return at[0] << 8 | at[1]; }

  std::string problemOfPicture() {
    if (remaining() < 2 || position_[0] != 0xFF || position_[1] != kSoi) {
      return "not a JPEG: it does not begin with SOI";
    }
    position_ += 2;
    for (;;) {
      while (remaining() >= 2 && position_[0] == 0xFF && position_[1] == 0xFF) {
        ++position_;  // any number of fill bytes may precede a marker
      }
      if (remaining() < 4) {
        return kCutOff;
      }
      const std::uint8_t marker = position_[1];
      const int length = read16(position_ + 2);
      if (position_[0] != 0xFF || length < 2) {
        return kStrange;
      }
      if (remaining() < 2 + static_cast<std::size_t>(length)) {
        return kCutOff;
      }
      const std::uint8_t* const segment = position_ + 4;
      position_ += 2 + length;
      if (std::string problem = problemOfSegment(marker, segment, length - 2); !problem.empty()) {
        return problem;
      }
      if (marker == kSos) {
        return problemOfData();
      }
    }
  }

  std::string problemOfSegment(std::uint8_t marker, const std::uint8_t* segment, int size) {
    switch (marker) {
      case kSof0:
        return problemOfFrame(segment, size);
      case kSos:
        return problemOfScan(segment, size);
      case kDqt:
        has_quantization_ = true;
        return "";
      case kDht:
        has_huffman_ = true;
        return "";
      case kApp14: {  // Adobe's segment gives the meaning of the components: 1 is YCbCr
        const bool is_adobe = size >= 12 && std::memcmp(segment, "Adobe", 5) == 0;
        return is_adobe && segment[11] != 1 ? "its colours are not YCbCr" : "";
      }
      default:
        if (marker > kSof0 && marker < kRst0) {
          return "not a baseline JPEG (progressive, arithmetic, or another process)";
        }
        return marker == kDri || marker == kCom || (marker >= kApp0 && marker <= kApp15) ? "" : kStrange;
    }
  }

  std::string problemOfFrame(const std::uint8_t* frame, int size) {
    if (frame_ != nullptr || size != kFrameHeaderSize || frame[0] != 8 || frame[5] != kComponents) {
      return "not one frame of 3 components with 8 bits";
    }
    frame_ = frame;
    result_.height = read16(frame + 1);
    result_.width = read16(frame + 3);
    if (!isCameraSize(result_.width, result_.height)) {
      return "a size that no camera has: " + std::to_string(result_.width) + "x" + std::to_string(result_.height);
    }
    if (frame[6] == 'R' && frame[9] == 'G' && frame[12] == 'B') {
      return "its colours are not YCbCr";
    }
    const int luma = frame[7];
    const bool is_usual = luma == 0x11 || luma == 0x21 || luma == 0x12 || luma == 0x22;
    return is_usual && frame[10] == 0x11 && frame[13] == 0x11 ? "" : "an unusual subsampling";
  }

  std::string problemOfScan(const std::uint8_t* scan, int size) const {
    if (frame_ == nullptr || !has_quantization_ || !has_huffman_) {
      return "its frame header or its tables are missing";
    }
    const bool is_whole = size == kScanHeaderSize && scan[0] == kComponents && scan[1] == frame_[6] &&
                          scan[3] == frame_[9] && scan[5] == frame_[12] && scan[7] == 0 && scan[8] == 63 &&
                          scan[9] == 0;
    return is_whole ? "" : "not one baseline scan of all components";
  }

  // In compressed data, 0xFF is followed by 0 or begins a restart marker. The first other marker has to be EOI.
  std::string problemOfData() {
    while (remaining() >= 2) {
      const void* const found = std::memchr(position_, 0xFF, remaining() - 1);
      if (found == nullptr) {
        break;
      }
      const std::uint8_t* const marker = static_cast<const std::uint8_t*>(found) + 1;
      position_ = *marker == 0xFF ? marker : marker + 1;
      if (*marker == kEoi) {
        return position_ == end_ ? "" : "bytes after its end";
      }
      if (*marker != 0 && *marker != 0xFF && (*marker < kRst0 || *marker > kRst7)) {
        return "a marker within its compressed data";
      }
    }
    return "cut off: it does not end with EOI";
  }

  const std::uint8_t* position_;
  const std::uint8_t* const end_;
  const std::uint8_t* frame_ = nullptr;  // the content of the frame header; null before
  bool has_quantization_ = false;
  bool has_huffman_ = false;
  JpegInspection result_;
};

}  // namespace

JpegInspection inspectJpeg(const std::uint8_t* data, std::size_t size) {
  return MarkerWalk(data, size).run();
}

}  // namespace aibo_client
