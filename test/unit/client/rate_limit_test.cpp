#include "system/rate_limit.h"

#include <gmock/gmock.h>

#include "client/notifier.h"

namespace aibo_client {
namespace {

TEST(NotifierLogTest, AFloodIsLimitedAndSaysSo) {
  aibo_system::RateLimit::TimePoint now{std::chrono::hours(1)};
  std::vector<std::string> lines;
  Callbacks callbacks;
  callbacks.log = [&](LogLevel, const std::string& line) { lines.push_back(line); };
  const Notifier notifier(std::move(callbacks), [&now] { return now; });
  for (int i = 0; i < 1000; ++i) {
    notifier.log(LogLevel::kWarn, "a message");
  }
  ASSERT_EQ(lines.size(), 21U);
  EXPECT_EQ(lines[19], "a message");
  EXPECT_THAT(lines[20], testing::HasSubstr("are left out"));
  for (const char* const left_out : {"980", "1"}) {
    lines.clear();
    now += std::chrono::seconds(1);
    notifier.log(LogLevel::kWarn, "a later one");
    notifier.log(LogLevel::kWarn, "one too many");
    ASSERT_EQ(2u, lines.size());
    EXPECT_EQ(std::string("a later one (earlier messages left out: ") + left_out + ")", lines[0]);
    EXPECT_THAT(lines[1], testing::HasSubstr("are left out"));
  }
}

}  // namespace
}  // namespace aibo_client
