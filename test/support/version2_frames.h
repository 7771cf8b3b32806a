/// @file version2_frames.h
/// Frames of a version 2 server, for tests.
#ifndef TEST_SUPPORT_VERSION2_FRAMES_H
#define TEST_SUPPORT_VERSION2_FRAMES_H

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

#include "protocol/hello.h"
#include "protocol/version2.h"
#include "support/sockets.h"

namespace version2_frames {

namespace version2 = protocol::version2;
using test_support::Bytes;

struct Frame {
  version2::FrameHeader header{};
  Bytes payload;
};

/// Splits one whole frame into header and payload.
inline Frame split(const Bytes& bytes) {
  return {version2::decodeFrameHeader(bytes.data()), Bytes(bytes.begin() + version2::FRAME_HEADER_SIZE, bytes.end())};
}

/// Kind, id and payload as text, as in "W 85 1 0 0 1".
/// @param longest the most bytes of the payload that are shown
inline std::string describe(const Frame& frame, std::size_t longest = 256) {
  std::string text = frame.header.kind + (" " + std::to_string(frame.header.id));
  for (std::size_t i = 0; i < std::min(longest, frame.payload.size()); ++i) {
    text += " " + std::to_string(frame.payload[i]);
  }
  return text;
}

template <typename Payload>
Bytes encoded(const Payload& payload) {
  Bytes bytes(version2::encodedSize(payload));
  version2::encode(payload, bytes.data());
  return bytes;
}

inline Bytes makeFrame(char kind, int number, const Bytes& payload) {
  version2::FrameHeader header = {};
  header.kind = kind;
  header.request_number = static_cast<unsigned short>(number);
  header.payload_size = static_cast<unsigned>(payload.size());
  Bytes frame = encoded(header);
  frame.insert(frame.end(), payload.begin(), payload.end());
  return frame;
}

/// An ERS-7 with two joints, 1 and 2, served by "a test 1.0".
/// @param capabilities separated by blanks; with `S`, the robot walks 0.15 m/s forward, 0.1 m/s back, 0.06 m/s sideways
///   and turns 1.2 rad/s
inline Bytes makeHello(const std::string& capabilities = "F W J V T", unsigned frame_number = 1000) {
  const bool walks = capabilities.find('S') != std::string::npos;
  const std::string text = "robot=ERS-7\nserver=a test 1.0\nframe_number=" + std::to_string(frame_number) +
                           "\ncapabilities=" + capabilities +
                           "\nlimits=1:-1300000:0:3000000 2:-1500000:1600000:10000000\n" +
                           (walks ? "walk_limits=150:100:60:1200\n" : "");
  return Bytes(text.begin(), text.end());
}

constexpr unsigned kImageCount = 12345;

inline Bytes makePicture(const Bytes& jpeg, unsigned frame_number) {
  Bytes payload = encoded(version2::ImageHeader{kImageCount, frame_number, 208, 160, 85, version2::LAYER_HIGH, {}});
  payload.insert(payload.end(), jpeg.begin(), jpeg.end());
  return payload;
}

inline Bytes makeTelemetry(unsigned frame_number, const std::vector<version2::TelemetryEntry>& entries) {
  version2::Telemetry telemetry = {};
  telemetry.frame_number = frame_number;
  telemetry.count = static_cast<unsigned short>(entries.size());
  std::copy(entries.begin(), entries.end(), telemetry.entries);
  return encoded(telemetry);
}

inline Bytes makeError(int code, const std::string& text) {
  return encoded(version2::ErrorMessage{static_cast<unsigned short>(code), text.data(), text.size()});
}

/// @param order number of the request that began it
inline Bytes makeEnd(int what, int how, const std::string& name, const std::string& reason, int order = 0) {
  return encoded(version2::EndMessage{static_cast<unsigned char>(what), static_cast<unsigned char>(how),
                                      static_cast<unsigned short>(order), name.data(), name.size(), reason.data(),
                                      reason.size()});
}

}  // namespace version2_frames

#endif  // TEST_SUPPORT_VERSION2_FRAMES_H
