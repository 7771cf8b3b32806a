/// @file layouts.h
/// Payloads of version 2 for tests, and helpers that call encoders and decoders.
#ifndef TEST_UNIT_PROTOCOL_LAYOUTS_H
#define TEST_UNIT_PROTOCOL_LAYOUTS_H

#include <gmock/gmock.h>

#include <algorithm>
#include <string>
#include <vector>

#include "protocol/color_requests.h"
#include "protocol/version2.h"

namespace protocol {

using Bytes = std::vector<unsigned char>;

/// "00 1f ff" as bytes.
inline Bytes hex(const std::string& digits) {
  Bytes bytes;
  for (size_t i = 0; i < digits.size(); i += 3) {
    bytes.push_back(static_cast<unsigned char>(std::stoi(digits.substr(i, 2), nullptr, 16)));
  }
  return bytes;
}

inline Bytes bytesOf(const std::string& text) {
  return Bytes(text.begin(), text.end());
}

inline Bytes operator+(Bytes left, const Bytes& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

/// The first `size` bytes, in memory of exactly that size, so that a sanitizer finds reads beyond the end.
inline Bytes firstOf(const Bytes& bytes, size_t size) {
  return Bytes(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
}

namespace version2 {

constexpr char kTwoTargets[] =
    "01 f4 02 00 "              // 500 ms, two joints
    "02 00 00 00 00 07 a1 20 "  // 2: 500000
    "0b 00 00 00 ff ec 06 bb";  // 11: -1308997

constexpr char kTwoLimits[] =
    "01 00 00 00 00 30 9a 4a "  // 1: 3185226
    "34 00 00 00 00 e7 5c b4";  // 52: 15162548

constexpr char kThreeValues[] =
    "80 00 00 01 00 03 00 00 "  // frame 2147483649, three values
    "4a 03 00 00 ff ff ff ff "  // joint 3: -1
    "53 3f 00 00 ff 6a 5c c6 "  // sensor 63: -9806650 (-1 g upwards)
    "53 0e 00 00 00 00 00 01";  // sensor 14, a paw: pressed

constexpr char kTwoIds[] = "02 34";  // head_pan, tail_tilt

constexpr char kEnd[] =
    "01 01 ab cd "              // a motion was replaced: that of request 43981
    "4e 4f 44 2e 4d 54 4e 0a "  // NOD.MTN
    "63 c3 a9";                 // a reason

constexpr char kPicture[] =
    "00 01 02 03 0a 0b 0c 0d "  // image 66051, frame 168496141
    "00 d0 00 a0 55 00 00 00 "  // 208x160, quality 85, layer H
    "ff d8 ff d9";              // a JPEG of begin and end markers only

constexpr char kTwoLeds[] =
    "02 ff 00 00 "  // 2: 255, mode A
    "1a 80 01 00";  // 26: 128, mode B

constexpr char kVelocity[] = "00 96 ff c4 04 b0";  // 150 mm/s forward, 60 mm/s right, 1.2 rad/s left

constexpr char kColorRegions[] =
    "00 01 02 03 0a 0b 0c 0d "                                      // image 66051, frame 168496141
    "00 68 00 50 02 00 00 00 "                                      // 104x80, two channels, without the plane
    "00 00 00 00 00 00 01 2c 0d 00 0a 00 00 2a 00 1e 00 14 00 15 "  // channel 0: 300 pixels
    "06 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00";  // channel 6: none

constexpr char kHeardSound[] =
    "0a 0b 0c 0d 00 02 02 00 "  // frame 168496141, two samples of two channels
    "00 01 ff ff 7f ff 80 00";  // 1, -1; 32767, -32768

constexpr char kPlayedSound[] =
    "00 00 3e 80 01 00 00 00 "  // from sample 16000 on, the last
    "00 01 ff ff";              // 1, -1

constexpr char kUpload[] =
    "07 4e 4f 44 2e 4d 54 4e "  // NOD.MTN
    "4f 4d 54 4e";              // a motion cut off after four bytes

constexpr char kOrder[] =
    "0a 0b 0c 0d 00 03 "     // not after frame 168496141, three times
    "4e 4f 44 2e 4d 54 4e";  // NOD.MTN

constexpr char kHello[] =
    "robot=ERS-7\n"
    "server=aibo_rcserver 0.1.0\n"
    "frame_number=4294967295\n"
    "capabilities=H F W J V T\n"
    "limits=1:-1308997:0:3185226 2:-1535890:1535890:10057460\n";

/// The bytes of a payload. Checks that nothing after them is written.
template <typename Payload>
Bytes encoded(const Payload& payload) {
  const size_t size = encodedSize(payload);
  Bytes bytes(size + 8, 0xee);
  EXPECT_EQ(encode(payload, bytes.data()), size);
  EXPECT_TRUE(std::all_of(bytes.begin() + static_cast<std::ptrdiff_t>(size), bytes.end(),
                          [](unsigned char byte) { return byte == 0xee; }));
  bytes.resize(size);
  return bytes;
}

/// Only the reason for a refusal.
template <typename Payload>
const char* verdict(const Bytes& bytes) {
  Payload payload{};
  return decode(bytes.data(), bytes.size(), &payload);
}

/// A payload that is accepted. Texts point into the bytes.
template <typename Payload>
Payload decoded(const Bytes& bytes) {
  Payload payload{};
  EXPECT_THAT(decode(bytes.data(), bytes.size(), &payload), ::testing::IsNull());
  return payload;
}

}  // namespace version2
}  // namespace protocol

#endif  // TEST_UNIT_PROTOCOL_LAYOUTS_H
