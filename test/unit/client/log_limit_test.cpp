#include "client/log_limit.h"

#include <gmock/gmock.h>

#include <string>
#include <utility>
#include <vector>

#include "client/notifier.h"

namespace aibo_driver {
namespace {

using ::testing::HasSubstr;

class LogLimitTest : public ::testing::Test {
 protected:
  int admitted(int messages) {
    int count = 0;
    for (int i = 0; i < messages; ++i) {
      count += limit_.admit(now_).is_logged ? 1 : 0;
    }
    return count;
  }

  LogLimit limit_;
  LogLimit::TimePoint now_{std::chrono::hours(1)};
};

TEST_F(LogLimitTest, ABurstIsLoggedAndThenOneMessagePerPeriod) {
  EXPECT_EQ(admitted(1000), LogLimit::kBurst);
  now_ += std::chrono::milliseconds(500);
  EXPECT_EQ(admitted(1000), 0);
  now_ += std::chrono::milliseconds(500);
  EXPECT_EQ(admitted(1000), 1);
  now_ += 3 * LogLimit::kPeriod;
  EXPECT_EQ(admitted(1000), 3);
  now_ += std::chrono::hours(1);
  EXPECT_EQ(admitted(1000), LogLimit::kBurst);
}

TEST_F(LogLimitTest, MessagesThatComeRarelyAreAllLogged) {
  for (int i = 0; i < 100; ++i) {
    EXPECT_TRUE(limit_.admit(now_).is_logged);
    now_ += LogLimit::kPeriod;
  }
}

TEST_F(LogLimitTest, WhatWasLeftOutIsCountedOnce) {
  EXPECT_EQ(admitted(1000), LogLimit::kBurst);
  now_ += 2 * LogLimit::kPeriod;
  EXPECT_EQ(limit_.admit(now_).left_out, 1000U - LogLimit::kBurst);
  EXPECT_EQ(limit_.admit(now_).left_out, 0U);
}

// 1000 messages take far less than a second.
TEST(NotifierLogTest, AFloodIsLimitedAndSaysSo) {
  std::vector<std::string> lines;
  RcServerClient::Callbacks callbacks;
  callbacks.log = [&](LogLevel, const std::string& line) { lines.push_back(line); };
  const Notifier notifier(std::move(callbacks));
  for (int i = 0; i < 1000; ++i) {
    notifier.log(LogLevel::kWarn, "a message");
  }
  ASSERT_GE(lines.size(), static_cast<std::size_t>(LogLimit::kBurst) + 1);
  EXPECT_LT(lines.size(), 2U * LogLimit::kBurst);
  EXPECT_EQ(lines[LogLimit::kBurst - 1], "a message");
  EXPECT_THAT(lines[LogLimit::kBurst], HasSubstr("are left out"));
}

}  // namespace
}  // namespace aibo_driver
