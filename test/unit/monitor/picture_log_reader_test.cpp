#include "tools/picture_log_reader.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <string>
#include <system_error>
#include <vector>

#include "log_file_fixture.h"

namespace aibo_driver::tools {
namespace {

using std::chrono::nanoseconds;

// The check value of CRC-32: the checksum of "123456789" is 0xCBF43926.
const std::vector<std::uint8_t> kPicture{'1', '2', '3', '4', '5', '6', '7', '8', '9'};
const std::string kPictureEntry = " 9 3421780262\n";
const PictureLogReader::Time kArrival{nanoseconds(2500)};

class PictureLogReaderTest : public LogFileFixture {};

TEST_F(PictureLogReaderTest, FindsAPictureByItsSizeAndChecksum) {
  append("1000" + kPictureEntry);
  PictureLogReader reader(path());
  reader.readNewLines();
  ASSERT_TRUE(reader.cameraTime(kPicture, kArrival));
  EXPECT_EQ(nanoseconds(1000), reader.cameraTime(kPicture, kArrival)->time_since_epoch());
  EXPECT_FALSE(reader.cameraTime({'1', '2', '3', '4', '5', '6', '7', '8', '0'}, kArrival));
  EXPECT_FALSE(reader.cameraTime({}, kArrival));
}

TEST_F(PictureLogReaderTest, WaitsForTheRestOfALineThatIsBeingWritten) {
  append("10");
  PictureLogReader reader(path());
  reader.readNewLines();
  EXPECT_FALSE(reader.cameraTime(kPicture, kArrival));
  append("00" + kPictureEntry);
  reader.readNewLines();
  ASSERT_TRUE(reader.cameraTime(kPicture, kArrival));
  EXPECT_EQ(nanoseconds(1000), reader.cameraTime(kPicture, kArrival)->time_since_epoch());
}

TEST_F(PictureLogReaderTest, TakesTheLastOfEqualPicturesThatWasSeenBeforeTheArrival) {
  append("1000" + kPictureEntry + "2000" + kPictureEntry + "3000" + kPictureEntry);
  PictureLogReader reader(path());
  reader.readNewLines();
  ASSERT_TRUE(reader.cameraTime(kPicture, kArrival));
  EXPECT_EQ(nanoseconds(2000), reader.cameraTime(kPicture, kArrival)->time_since_epoch());
}

TEST_F(PictureLogReaderTest, SkipsALineThatIsNotAnEntry) {
  append("nonsense\n\n1000" + kPictureEntry);
  PictureLogReader reader(path());
  reader.readNewLines();
  EXPECT_TRUE(reader.cameraTime(kPicture, kArrival));
}

TEST_F(PictureLogReaderTest, NeverWaitsAtAPipe) {
  makePipe();
  PictureLogReader reader(path());
  reader.readNewLines();  // nobody writes
  const int writer = ::open(path().c_str(), O_WRONLY | O_NONBLOCK | O_CLOEXEC);
  ASSERT_GE(writer, 0);
  reader.readNewLines();  // nothing written
  const std::string line = "1000" + kPictureEntry;
  ASSERT_EQ(static_cast<ssize_t>(line.size()), ::write(writer, line.data(), line.size()));
  reader.readNewLines();
  ::close(writer);
  EXPECT_TRUE(reader.cameraTime(kPicture, kArrival));
}

TEST_F(PictureLogReaderTest, SaysWhichLogCannotBeOpened) {
  try {
    PictureLogReader reader(path());
    FAIL() << "opened a log that is not there";
  } catch (const std::system_error& error) {
    EXPECT_NE(std::string::npos, std::string(error.what()).find(path()));
  }
}

}  // namespace
}  // namespace aibo_driver::tools
