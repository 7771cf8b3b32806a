// aibo_monitor can read what aibo_rcserver writes.

#include "simulator/picture_log.h"

#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <string>
#include <system_error>
#include <vector>

#include "log_file_fixture.h"
#include "protocol/version1.h"
#include "protocol/version2.h"
#include "tools/picture_log_reader.h"

namespace aibo_driver::tools {
namespace {

using Clock = std::chrono::system_clock;
using Bytes = std::vector<std::uint8_t>;

class PictureLogTest : public LogFileFixture {
 protected:
  void send(const Bytes& jpeg) {
    Bytes message(protocol::PICTURE_HEADER_SIZE);
    protocol::encodePictureHeader(jpeg.size(), message.data());
    message.insert(message.end(), jpeg.begin(), jpeg.end());
    log_.aboutToSend(message.data(), message.size());
  }

  std::optional<PictureLogReader::Time> loggedTime(const Bytes& jpeg) {
    reader_.readNewLines();
    return reader_.cameraTime(jpeg, Clock::now());
  }

  PictureLog log_{path()};
  PictureLogReader reader_{path()};
};

TEST_F(PictureLogTest, SaysWhenTheCameraSawThePictureThatIsSent) {
  const Bytes first{0xFF, 0xD8, 0xFF, 1};
  const Bytes second{0xFF, 0xD8, 0xFF, 2};
  const auto begin = Clock::now();
  log_.cameraImageTaken();
  const auto between = Clock::now();
  send(first);
  log_.cameraImageTaken();
  const auto end = Clock::now();
  send(second);
  ASSERT_TRUE(loggedTime(first));
  EXPECT_GE(*loggedTime(first), begin);
  EXPECT_LE(*loggedTime(first), between);
  ASSERT_TRUE(loggedTime(second));
  EXPECT_GE(*loggedTime(second), between);
  EXPECT_LE(*loggedTime(second), end);
}

TEST_F(PictureLogTest, FindsAPictureOfVersion2) {
  using namespace protocol::version2;
  const Bytes jpeg{0xFF, 0xD8, 0xFF};
  Bytes message(FRAME_HEADER_SIZE + IMAGE_HEADER_SIZE);
  encodeFrameHeader({PICTURE, 85, 4711, static_cast<unsigned>(IMAGE_HEADER_SIZE + jpeg.size())}, message.data());
  encodeImageHeader({1, 2, 208, 160, 85, LAYER_HIGH, {}}, message.data() + FRAME_HEADER_SIZE);
  message.insert(message.end(), jpeg.begin(), jpeg.end());
  log_.cameraImageTaken();
  log_.aboutToSend(message.data(), message.size());
  EXPECT_TRUE(loggedTime(jpeg));
}

TEST_F(PictureLogTest, SkipsWhatIsNotAPicture) {
  const Bytes jpeg{0xFF, 0xD8, 0xFF};
  log_.cameraImageTaken();
  const Bytes error_reply{'e', 0, 0, 0};
  log_.aboutToSend(error_reply.data(), error_reply.size());
  const Bytes short_header{'f', 0, 0};
  log_.aboutToSend(short_header.data(), short_header.size());
  const Bytes half_a_picture{'f', 0, 0, 0, 6, 0xFF, 0xD8, 0xFF};
  log_.aboutToSend(half_a_picture.data(), half_a_picture.size());
  EXPECT_FALSE(loggedTime(jpeg));
  EXPECT_EQ(0u, sizeOfLog());
}

TEST_F(PictureLogTest, SaysWhichFileCannotBeOpened) {
  try {
    PictureLog log(path() + "/below_a_file");
    FAIL() << "opened a log below a file";
  } catch (const std::system_error& error) {
    EXPECT_NE(std::string::npos, std::string(error.what()).find(path()));
  }
}

class PictureLogPipeTest : public LogFileFixture {};

TEST_F(PictureLogPipeTest, NeverWaitsForAPipeThatNobodyReads) {
  makePipe();
  PictureLog log(path());
  PictureLogReader reader(path());
  const Bytes message{'f', 0, 0, 0, 4, 0xFF, 0xD8, 0xFF, 42};
  for (int picture = 0; picture < 10000; ++picture) {
    log.aboutToSend(message.data(), message.size());
  }
  reader.readNewLines();
  EXPECT_TRUE(reader.cameraTime({0xFF, 0xD8, 0xFF, 42}, Clock::now()));
  log.cameraImageTaken();
  log.aboutToSend(message.data(), message.size());
  reader.readNewLines();
  EXPECT_GT(reader.cameraTime({0xFF, 0xD8, 0xFF, 42}, Clock::now())->time_since_epoch().count(), 0);
}

}  // namespace
}  // namespace aibo_driver::tools
