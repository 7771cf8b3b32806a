#include "protocol/frame_reader.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>

#include "layouts.h"

namespace protocol {
namespace version2 {
namespace {

class FrameReaderTest : public ::testing::Test {
 protected:
  static constexpr size_t kCapacity = 1000;

  // All frames in the bytes, encoded again; fails if one is too large.
  Bytes receive(const Bytes& bytes) {
    Bytes frames;
    for (size_t used = 0; used < bytes.size();) {
      size_t taken = 0;
      const FrameReader::Result result = reader_.append(bytes.data() + used, bytes.size() - used, &taken);
      EXPECT_NE(result, FrameReader::FRAME_TOO_LARGE);
      EXPECT_GT(taken, 0U);
      used += taken;
      if (result == FrameReader::FRAME_COMPLETE) {
        const unsigned char* payload = reader_.payload();
        frames = frames + encoded(reader_.header()) + Bytes(payload, payload + reader_.header().payload_size);
      }
    }
    return frames;
  }

  Bytes buffer_ = Bytes(kCapacity);
  FrameReader reader_{buffer_.data(), buffer_.size()};
};

TEST_F(FrameReaderTest, RefusesFourGibibytesWithoutTouchingMemory) {
  const Bytes bytes = hex("66 00 00 00 ff ff ff ff") + Bytes(kCapacity + 1, 0x11);
  size_t taken = 0;
  EXPECT_EQ(reader_.append(bytes.data(), bytes.size(), &taken), FrameReader::FRAME_TOO_LARGE);
  EXPECT_EQ(taken, bytes.size());
  EXPECT_THAT(buffer_, ::testing::Each(0));
}

TEST_F(FrameReaderTest, FindsTheSameFramesHoweverTheBytesAreSplitOrJoined) {
  std::mt19937 random(20061);
  const auto upTo = [&random](size_t limit) { return std::uniform_int_distribution<size_t>(0, limit)(random); };
  Bytes bytes;
  for (int i = 0; i < 200; ++i) {
    Bytes payload(i % 3 == 0 ? upTo(kCapacity) : upTo(12));
    std::generate(payload.begin(), payload.end(), [&] { return static_cast<unsigned char>(upTo(255)); });
    const FrameHeader header = {"HFWJVTfte"[upTo(8)], static_cast<unsigned char>(upTo(255)),
                                static_cast<unsigned short>(upTo(65535)), static_cast<unsigned>(payload.size())};
    bytes = bytes + encoded(header) + payload;
  }
  for (const size_t longest_piece : {1U, 2U, 7U, 8U, 9U, 100U, 1460U, 1000000U}) {
    Bytes found;
    for (size_t used = 0; used < bytes.size();) {
      const size_t size = std::min(1 + upTo(longest_piece - 1), bytes.size() - used);
      const auto begin = bytes.begin() + static_cast<std::ptrdiff_t>(used);
      found = found + receive(Bytes(begin, begin + static_cast<std::ptrdiff_t>(size)));
      used += size;
    }
    EXPECT_TRUE(found == bytes) << "in pieces of up to " << longest_piece;
  }
}

}  // namespace
}  // namespace version2
}  // namespace protocol
