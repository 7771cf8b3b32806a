#include "simulator/picture_log.h"

#include <gmock/gmock.h>
#include <sys/stat.h>

#include <chrono>
#include <fstream>
#include <string>
#include <system_error>
#include <vector>

#include "protocol/picture_datagram.h"
#include "protocol/version1.h"
#include "protocol/version2.h"
#include "support/temporary_folder.h"

namespace {

using std::chrono::system_clock;
using ::testing::AllOf;
using ::testing::Ge;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Le;
using ::testing::SizeIs;

using Bytes = std::vector<std::uint8_t>;

struct Line {
  system_clock::time_point time;
  std::size_t bytes;
  std::uint32_t checksum;
};

class PictureLogTest : public ::testing::Test {
 protected:
  void send(const Bytes& jpeg) {
    Bytes message(protocol::PICTURE_HEADER_SIZE);
    protocol::encodePictureHeader(jpeg.size(), message.data());
    message.insert(message.end(), jpeg.begin(), jpeg.end());
    log_.aboutToSend(message.data(), message.size());
  }

  std::vector<Line> lines() const {
    std::ifstream file(path_);
    std::vector<Line> lines;
    long long time = 0;
    for (Line line{}; file >> time >> line.bytes >> line.checksum; lines.push_back(line)) {
      line.time = system_clock::time_point(std::chrono::nanoseconds(time));
    }
    return lines;
  }

  const test_support::TemporaryFolder folder_;
  const std::string path_ = folder_.path("picture_log");
  PictureLog log_{path_};
};

TEST_F(PictureLogTest, SaysWhenTheCameraSawThePictureThatIsSentAndWhichItIs) {
  const auto begin = system_clock::now();
  log_.cameraImageTaken();
  const auto between = system_clock::now();
  send({0xFF, 0xD8, 0xFF, 1});
  log_.cameraImageTaken();
  const auto end = system_clock::now();
  send({0xFF, 0xD8, 0xFF, 2, 3});
  ASSERT_THAT(lines(), SizeIs(2));
  EXPECT_THAT(lines()[0].time, AllOf(Ge(begin), Le(between)));
  EXPECT_EQ(lines()[0].bytes, 4U);
  EXPECT_EQ(lines()[0].checksum, 0x98F87081) << "CRC-32";
  EXPECT_THAT(lines()[1].time, AllOf(Ge(between), Le(end)));
  EXPECT_EQ(lines()[1].bytes, 5U);
}

TEST_F(PictureLogTest, FindsAPictureOfVersion2) {
  using namespace protocol::version2;
  const Bytes jpeg{0xFF, 0xD8, 0xFF};
  Bytes message(FRAME_HEADER_SIZE + IMAGE_HEADER_SIZE);
  encode(FrameHeader{PICTURE, 85, 4711, static_cast<unsigned>(IMAGE_HEADER_SIZE + jpeg.size())}, message.data());
  encode(ImageHeader{1, 2, 208, 160, 85, LAYER_HIGH, {}}, message.data() + FRAME_HEADER_SIZE);
  message.insert(message.end(), jpeg.begin(), jpeg.end());
  log_.aboutToSend(message.data(), message.size());
  ASSERT_THAT(lines(), SizeIs(1));
  EXPECT_EQ(lines()[0].bytes, 3U);
}

TEST_F(PictureLogTest, AssemblesAPictureFromItsParts) {
  Bytes message(protocol::PICTURE_HEADER_SIZE);
  protocol::encodePictureHeader(8, message.data());
  message.insert(message.end(), {0xFF, 0xD8, 0xFF, 1, 2, 3, 4, 5});
  const std::size_t half = message.size() - 4;
  log_.cameraImageTaken();
  const auto between = system_clock::now();
  log_.aboutToSend(message.data(), half);
  log_.cameraImageTaken();
  log_.aboutToSend(message.data() + half, 4);
  ASSERT_THAT(lines(), SizeIs(1));
  EXPECT_THAT(lines()[0].time, Le(between)) << "the picture began before the next image";
}

TEST_F(PictureLogTest, AssemblesAPictureFromItsDatagrams) {
  using namespace protocol::version2;
  constexpr unsigned kSize = DATAGRAM_PART_SIZE + 5;
  unsigned sequence = 0;
  const auto send_part = [&](bool is_parity, unsigned short part) {
    Bytes datagram(DATAGRAM_HEADER_SIZE + sizeOfPart(kSize, part));
    encode(PictureDatagram{is_parity, part, sequence++, 1, kSize, ImageHeader{1, 2, 208, 160, 85, LAYER_HIGH, {}}},
           datagram.data());
    log_.aboutToSend(datagram.data(), datagram.size());
  };
  log_.cameraImageTaken();
  send_part(false, 0);
  EXPECT_THAT(lines(), IsEmpty());
  send_part(false, 1);
  send_part(true, 0);
  send_part(false, 1);  // repeated
  ASSERT_THAT(lines(), SizeIs(1));
  EXPECT_EQ(lines()[0].bytes, kSize);
}

TEST_F(PictureLogTest, SkipsWhatIsNotAPicture) {
  for (const Bytes& message : {Bytes{'e', 0, 0, 0}, Bytes{'f', 0, 0}, Bytes{'f', 0, 0, 0, 6, 0xFF, 0xD8, 0xFF}}) {
    log_.aboutToSend(message.data(), message.size());
  }
  EXPECT_THAT(lines(), IsEmpty());
}

TEST_F(PictureLogTest, SaysWhichFileCannotBeOpened) {
  try {
    PictureLog log(path_ + "/below_a_file");
    FAIL() << "opened a log below a file";
  } catch (const std::system_error& error) {
    EXPECT_THAT(error.what(), HasSubstr(path_));
  }
}

TEST_F(PictureLogTest, NeverWaitsForAPipeThatNobodyReads) {
  const std::string pipe = folder_.path("pipe");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  PictureLog log(pipe);
  const Bytes message{'f', 0, 0, 0, 4, 0xFF, 0xD8, 0xFF, 42};
  for (int picture = 0; picture < 10000; ++picture) {
    log.aboutToSend(message.data(), message.size());
  }
}

}  // namespace
