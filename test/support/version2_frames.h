/// @file version2_frames.h
/// Frames of a version 2 server, for tests.
#ifndef TEST_SUPPORT_VERSION2_FRAMES_H
#define TEST_SUPPORT_VERSION2_FRAMES_H

#include <cstddef>
#include <string>
#include <vector>

#include "protocol/version2.h"
#include "support/test_pictures.h"

namespace version2_frames {

using test_pictures::Bytes;

struct Frame {
  protocol::version2::FrameHeader header{};
  Bytes payload;
};

/// Splits one whole frame into header and payload.
Frame split(const Bytes& bytes);

/// Kind, id and payload as text, as in "W 85 1 0 0 1".
/// @param longest the most bytes of the payload that are shown
std::string textOf(const Frame& frame, std::size_t longest = 256);

Bytes makeFrame(char kind, int number, const Bytes& payload);

// Payloads.

template <typename Payload>
Bytes encoded(const Payload& payload) {
  Bytes bytes(protocol::version2::encodedSize(payload));
  protocol::version2::encode(payload, bytes.data());
  return bytes;
}

/// An ERS-7 with two joints, 1 and 2, served by "a test 1.0".
/// @param capabilities separated by blanks; with `S`, the robot walks 0.15 m/s forward, 0.1 m/s back, 0.06 m/s sideways
///   and turns 1.2 rad/s
Bytes makeHello(const std::string& capabilities = "F W J V T", unsigned frame_number = 1000);

constexpr unsigned kImageCount = 12345;
Bytes makePicture(const Bytes& jpeg, unsigned frame_number);

Bytes makeTelemetry(unsigned frame_number, const std::vector<protocol::version2::TelemetryEntry>& entries);

Bytes makeError(int code, const std::string& text);

/// @param order number of the request that began it
Bytes makeEnd(int what, int how, const std::string& name, const std::string& reason, int order = 0);

}  // namespace version2_frames

#endif  // TEST_SUPPORT_VERSION2_FRAMES_H
