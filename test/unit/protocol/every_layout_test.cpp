#include <gmock/gmock.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "layouts.h"
#include "protocol/big_endian.h"
#include "protocol/frame_reader.h"
#include "protocol/hello.h"
#include "protocol/motion_requests.h"
#include "protocol/picture_datagram.h"
#include "protocol/sound_requests.h"
#include "protocol/stick_pictures.h"
#include "protocol/walk_requests.h"

namespace protocol {
namespace version2 {
namespace {

using ::testing::HasSubstr;
using ::testing::IsNull;
using ::testing::NotNull;

struct Layout {
  const char* name;
  Bytes payload;
  std::function<const char*(const Bytes&)> decode;
  // Decodes an accepted payload and encodes the result.
  std::function<Bytes(const Bytes&)> encode_again;
  // Offsets of bytes that must be 0.
  std::vector<size_t> reserved;
  // Smaller sizes at which the beginning of the payload is complete, too.
  std::vector<size_t> whole_at;
  // True if the last field takes all remaining bytes of the frame.
  bool takes_more;
};

template <typename Payload>
Layout layout(const char* name, const Bytes& payload, const std::vector<size_t>& reserved = {},
              const std::vector<size_t>& whole_at = {}, bool takes_more = false) {
  return {name,     payload,  verdict<Payload>, [](const Bytes& bytes) { return encoded(decoded<Payload>(bytes)); },
          reserved, whole_at, takes_more};
}

Layout listLayout(const char* name, const Bytes& payload, ReadFileName read, const std::vector<size_t>& whole_at) {
  const auto verdict_on = [read](const Bytes& bytes) {
    FileList list{};
    return decodeFileList(read, bytes.data(), bytes.size(), &list);
  };
  const auto encode_again = [read](const Bytes& bytes) {
    FileList list{};
    decodeFileList(read, bytes.data(), bytes.size(), &list);
    Bytes again(MAX_FILE_LIST_SIZE);
    return firstOf(again, encodeFileList(list, again.data()));
  };
  return {name, payload, verdict_on, encode_again, {}, whole_at, false};
}

const Layout kLayouts[] = {
    layout<PictureRequest>("PictureRequest", hex("00")),
    layout<StreamSettings>("StreamSettings", hex("01 00 00 01")),
    layout<JointTargets>("JointTargets", hex(kTwoTargets), {3, 5, 6, 7, 13, 14, 15}),
    layout<SpeedLimits>("SpeedLimits", hex(kTwoLimits), {1, 2, 3, 9, 10, 11}, {0, 8}),
    layout<TelemetryPeriod>("TelemetryPeriod", hex("00 04")),
    layout<JointIds>("JointIds", hex(kTwoIds), {}, {1}, true),
    layout<Telemetry>("Telemetry", hex(kThreeValues), {6, 7, 10, 11, 18, 19, 26, 27}),
    layout<MotorState>("MotorState", hex("01")),
    layout<MotorsAndPosture>("MotorsAndPosture", hex("01 04 00 00"), {2, 3}),
    layout<LedValues>("LedValues", hex(kTwoLeds), {3, 7}, {0, 4}),
    layout<EarPositions>("EarPositions", hex("01 00")),
    layout<ColorSettings>("ColorSettings", hex("00 01 01 00"), {3}),
    layout<ColorTable>("ColorTable", hex("06 00 00 00") + Bytes(4 * COLOR_SEGMENTS, 128), {1, 2, 3}),
    layout<ColorRegions>("ColorRegions", hex(kColorRegions), {14, 15, 17, 18, 19, 37, 38, 39}),
    layout<MicrophoneSettings>("MicrophoneSettings", hex("03 02 3e 80")),
    layout<HeardSound>("HeardSound", hex(kHeardSound), {7}),
    layout<PlayedSound>("PlayedSound", hex(kPlayedSound), {5, 6, 7}, {8, 10}),
    layout<SpeakerRoom>("SpeakerRoom", hex("00 00 3c 00")),
    layout<SoundEnd>("SoundEnd", hex("00 00 00 00 00 00 3e 80 00 00 00 01 00 00 00 40"), {1, 2, 3}),
    layout<Volume>("Volume", hex("03")),
    layout<Velocity>("Velocity", hex(kVelocity), {6, 7}),
    layout<MotionUpload>("MotionUpload", hex(kUpload), {}, {9, 10, 11}, true),
    layout<MotionToDelete>("MotionToDelete", bytesOf("NOD.MTN")),
    layout<MotionOrder>("MotionOrder", hex(kOrder)),
    layout<MotionChanges>("MotionChanges", bytesOf("clip"), {}, {0, 1, 2, 3}, true),
    layout<StickPicture>("StickPicture", bytesOf("AIBO0001.JPG")),
    layout<FetchedPicture>("FetchedPicture", hex("ff d8"), {}, {1}, true),
    listLayout("MotionList", bytesOf("NOD.MTN\nWAG.MTN"), readMotionName, {0, 7}),
    listLayout("PictureList", bytesOf("A.JPG\nAIBO0001.JPG"), readPictureName, {0, 5}),
    layout<DatagramPort>("DatagramPort", hex("d4 31")),
    layout<Acknowledgement>("Acknowledgement", hex("61 00 00 00 00 00 12 34")),
    layout<LossReport>("LossReport", hex("6c 00 00 00 00 00 12 34")),
    layout<PicturePayload>("Picture", hex(kPicture), {}, {17, 18, 19}, true),
    layout<ErrorMessage>("ErrorMessage", hex("00 02 c3 a9"), {}, {2}, true),
    layout<EndMessage>("EndMessage", hex(kEnd), {2, 3}, {12, 13}, true),
};

class EveryLayout : public ::testing::TestWithParam<Layout> {};

TEST_P(EveryLayout, IsAccepted) {
  EXPECT_THAT(GetParam().decode(GetParam().payload), IsNull());
}

TEST_P(EveryLayout, IsRefusedWhenBytesAreMissing) {
  const std::vector<size_t>& whole_at = GetParam().whole_at;
  for (size_t size = 0; size < GetParam().payload.size(); ++size) {
    const bool is_whole = std::find(whole_at.begin(), whole_at.end(), size) != whole_at.end();
    EXPECT_EQ(GetParam().decode(firstOf(GetParam().payload, size)) == nullptr, is_whole) << size;
  }
}

TEST_P(EveryLayout, IsRefusedWithAByteTooMany) {
  if (!GetParam().takes_more) {
    EXPECT_THAT(GetParam().decode(GetParam().payload + Bytes{0}), NotNull());
  }
}

TEST_P(EveryLayout, IsRefusedWithAReservedByteInUse) {
  for (const size_t offset : GetParam().reserved) {
    Bytes payload = GetParam().payload;
    payload[offset] = 1;
    EXPECT_THAT(GetParam().decode(payload), HasSubstr("reserved")) << offset;
  }
}

// Small letters in the names of motions become capitals.
Bytes capitals(Bytes bytes) {
  std::transform(bytes.begin(), bytes.end(), bytes.begin(),
                 [](unsigned char byte) { return static_cast<unsigned char>(std::toupper(byte)); });
  return bytes;
}

class RandomBytes {
 public:
  explicit RandomBytes(unsigned seed) : random_(seed) {}

  size_t upTo(size_t limit) { return std::uniform_int_distribution<size_t>(0, limit)(random_); }

  Bytes bytes(size_t size) {
    Bytes bytes(size);
    std::generate(bytes.begin(), bytes.end(), [this] { return static_cast<unsigned char>(random_() >> 24); });
    return bytes;
  }

  // Some bytes changed, the end cut off or lengthened.
  Bytes damaged(Bytes bytes) {
    for (size_t i = upTo(3); i > 0 && !bytes.empty(); --i) {
      bytes[upTo(bytes.size() - 1)] = static_cast<unsigned char>(upTo(1) == 0 ? upTo(255) : upTo(2));
    }
    return upTo(3) == 0 ? firstOf(bytes, upTo(bytes.size())) + this->bytes(upTo(9)) : bytes;
  }

 private:
  std::mt19937 random_;
};

TEST_P(EveryLayout, IsEncodedAsItWasDecodedWhateverTheBytes) {
  RandomBytes random(2006);
  int accepted = 0;
  for (int round = 0; round < 2000; ++round) {
    const Bytes payload = random.damaged(GetParam().payload);
    if (GetParam().decode(payload) == nullptr) {
      ++accepted;
      ASSERT_EQ(capitals(GetParam().encode_again(payload)), capitals(payload));
    }
  }
  EXPECT_GT(accepted, 100);
}

INSTANTIATE_TEST_SUITE_P(Version2, EveryLayout, ::testing::ValuesIn(kLayouts),
                         [](const auto& layout) { return std::string(layout.param.name); });

// Gives a payload to every decoder. A sanitizer finds reads beyond its end.
void decodeAsEverything(const Bytes& payload) {
  for (const Layout& layout : kLayouts) {
    layout.decode(payload);
  }
  Hello hello;
  decodeHello(payload.data(), payload.size(), &hello);
}

// Gives bytes to a reader in random pieces, and every frame to every decoder. Returns the number of frames.
int receiveInPieces(const Bytes& bytes, RandomBytes& random, FrameReader& reader) {
  int frames = 0;
  for (size_t used = 0; used < bytes.size();) {
    const Bytes piece(bytes.begin() + static_cast<std::ptrdiff_t>(used),
                      bytes.begin() + static_cast<std::ptrdiff_t>(used + random.upTo(bytes.size() - used)));
    size_t taken = 0;
    const FrameReader::Result result = reader.append(piece.data(), piece.size(), &taken);
    EXPECT_LE(taken, piece.size());
    EXPECT_TRUE(taken > 0 || piece.empty());
    used += taken;
    if (result == FrameReader::FRAME_COMPLETE) {
      ++frames;
      decodeAsEverything(Bytes(reader.payload(), reader.payload() + reader.header().payload_size));
    } else if (result == FrameReader::FRAME_TOO_LARGE) {
      reader.reset();
    }
  }
  return frames;
}

// Random bytes, or a damaged payload.
Bytes randomPayload(RandomBytes& random) {
  const size_t layout = random.upTo(2 * std::size(kLayouts));
  if (layout < std::size(kLayouts)) {
    return random.damaged(kLayouts[layout].payload);
  }
  return layout == std::size(kLayouts) ? random.damaged(bytesOf(kHello)) : random.bytes(random.upTo(100));
}

TEST(Version2, SurvivesAMillionRandomBytes) {
  RandomBytes random(2026);
  Bytes buffer(300);
  FrameReader reader(buffer.data(), buffer.size());
  int frames = 0;
  for (size_t received = 0; received < 1000000;) {
    const Bytes payload = randomPayload(random);
    Bytes header = random.bytes(FRAME_HEADER_SIZE);
    // Hardly any random header announces a payload that fits, so most headers get the right size.
    if (random.upTo(9) > 0) {
      encodeBigEndian32(static_cast<unsigned>(payload.size()), header.data() + 4);
    }
    frames += receiveInPieces(header + payload, random, reader);
    received += header.size() + payload.size();
  }
  EXPECT_GT(frames, 10000);
}

}  // namespace
}  // namespace version2
}  // namespace protocol
