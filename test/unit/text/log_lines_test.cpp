#include "text/log_lines.h"

#include <gmock/gmock.h>

#include <optional>

namespace aibo_driver::text {
namespace {

class LogLinesTest : public testing::Test {
 protected:
  LogLines::TimePoint now_{std::chrono::seconds(5000)};
  LogLines lines_{[this] { return now_; }};
};

TEST_F(LogLinesTest, HaveNothingThatATerminalObeysAndAreShort) {
  EXPECT_EQ(lines_.admit("a.cpp", 1, "md5sum [\x1b[2J\n[FATAL] forged]"), "md5sum [?[2J?[FATAL] forged]");
  EXPECT_EQ(lines_.admit("a.cpp", 1, std::string(10'000'000, 'x'))->size(), 2003U);
}

TEST_F(LogLinesTest, AFloodIsALineASecondAndHidesNoOtherLine) {
  int flood = 0;
  std::optional<std::string> last;
  for (int i = 0; i < 100'000; ++i) {
    if (const auto line = lines_.admit("connection.cpp", 7, "a header of a stranger")) {
      last = line;
      ++flood;
    }
    now_ += std::chrono::microseconds(100);
  }
  EXPECT_EQ(flood, 109);
  EXPECT_EQ(last, "a header of a stranger (earlier lines left out: 9999)");
  EXPECT_EQ(lines_.admit("connection.cpp", 8, "something else"), "something else");
  EXPECT_EQ(lines_.admit("driver.cpp", 7, "something else"), "something else");
}

}  // namespace
}  // namespace aibo_driver::text
