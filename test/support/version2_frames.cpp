#include "support/version2_frames.h"

#include <algorithm>

#include "protocol/hello.h"

namespace version2_frames {

namespace version2 = protocol::version2;

Frame split(const Bytes& bytes) {
  return {version2::decodeFrameHeader(bytes.data()), Bytes(bytes.begin() + version2::FRAME_HEADER_SIZE, bytes.end())};
}

std::string textOf(const Frame& frame, std::size_t longest) {
  std::string text = frame.header.kind + (" " + std::to_string(frame.header.id));
  for (std::size_t i = 0; i < std::min(longest, frame.payload.size()); ++i) {
    text += " " + std::to_string(frame.payload[i]);
  }
  return text;
}

Bytes makeFrame(char kind, int number, const Bytes& payload) {
  version2::FrameHeader header = {};
  header.kind = kind;
  header.request_number = static_cast<unsigned short>(number);
  header.payload_size = static_cast<unsigned>(payload.size());
  Bytes frame = encoded(header);
  frame.insert(frame.end(), payload.begin(), payload.end());
  return frame;
}

Bytes makeHello(const std::string& capabilities, unsigned frame_number) {
  const bool walks = capabilities.find('S') != std::string::npos;
  const std::string text = "robot=ERS-7\nserver=a test 1.0\nframe_number=" + std::to_string(frame_number) +
                           "\ncapabilities=" + capabilities +
                           "\nlimits=1:-1300000:0:3000000 2:-1500000:1600000:10000000\n" +
                           (walks ? "walk_limits=150:100:60:1200\n" : "");
  return Bytes(text.begin(), text.end());
}

Bytes makePicture(const Bytes& jpeg, unsigned frame_number) {
  version2::ImageHeader header = {};
  header.image_count = kImageCount;
  header.frame_number = frame_number;
  header.width = 208;
  header.height = 160;
  header.quality = 85;
  header.layer = version2::LAYER_HIGH;
  Bytes payload = encoded(header);
  payload.insert(payload.end(), jpeg.begin(), jpeg.end());
  return payload;
}

Bytes makeTelemetry(unsigned frame_number, const std::vector<version2::TelemetryEntry>& entries) {
  version2::Telemetry telemetry = {};
  telemetry.frame_number = frame_number;
  telemetry.count = static_cast<unsigned short>(entries.size());
  std::copy(entries.begin(), entries.end(), telemetry.entries);
  return encoded(telemetry);
}

Bytes makeError(int code, const std::string& text) {
  return encoded(version2::ErrorMessage{static_cast<unsigned short>(code), text.data(), text.size()});
}

Bytes makeEnd(int what, int how, const std::string& name, const std::string& reason, int order) {
  return encoded(version2::EndMessage{static_cast<unsigned char>(what), static_cast<unsigned char>(how),
                                      static_cast<unsigned short>(order), name.data(), name.size(), reason.data(),
                                      reason.size()});
}

}  // namespace version2_frames
