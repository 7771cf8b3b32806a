#include "simulator/openr_host/clock.h"

#include <gtest/gtest.h>

namespace openr_host {
namespace {

TEST(WallClockTest, FramesBeginEveryEightMillisecondsCountedFromTheFirst) {
  const WallClock clock;
  const auto begin = *clock.beginOf(0);
  EXPECT_EQ(*clock.beginOf(1) - begin, std::chrono::milliseconds(8));
  // Exact to the nanosecond after a day.
  EXPECT_EQ(*clock.beginOf(125 * 86400) - begin, std::chrono::hours(24));
}

TEST(WallClockTest, TheCurrentFrameHasBegunAndTheNextOneHasNot) {
  const WallClock clock;
  longword frame = 0;
  std::chrono::steady_clock::time_point before;
  std::chrono::steady_clock::time_point after;
  do {
    before = std::chrono::steady_clock::now();
    frame = clock.frame();
    after = std::chrono::steady_clock::now();
  } while (frame < 2);
  EXPECT_LE(*clock.beginOf(frame), after);
  EXPECT_GT(*clock.beginOf(frame + 1), before);
}

TEST(SteppedClockTest, StopsUntilStepped) {
  SteppedClock clock;
  EXPECT_EQ(clock.frame(), 0U);
  clock.step();
  clock.step(10);
  EXPECT_EQ(clock.frame(), 11U);
  EXPECT_FALSE(clock.beginOf(12).has_value());
}

}  // namespace
}  // namespace openr_host
