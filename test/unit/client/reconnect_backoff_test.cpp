#include "client/reconnect_backoff.h"

#include <gtest/gtest.h>

#include <set>

using aibo_client::ReconnectBackoff;
using std::chrono::milliseconds;

namespace {

TEST(ReconnectBackoffTest, WaitsDoubleUpToTheLimitLessHalfAtMost) {
  for (unsigned seed = 1; seed < 200; ++seed) {
    ReconnectBackoff backoff(milliseconds(100), milliseconds(2000), seed);
    for (const int whole : {100, 200, 400, 800, 1600, 2000, 2000, 2000}) {
      const milliseconds wait = backoff.next();
      EXPECT_GE(wait, milliseconds(whole / 2));
      EXPECT_LE(wait, milliseconds(whole));
    }
  }
}

TEST(ReconnectBackoffTest, ClientsThatLostTheSameRobotComeBackAtDifferentTimes) {
  std::set<milliseconds> waits;
  for (unsigned seed = 1; seed <= 50; ++seed) {
    ReconnectBackoff backoff(milliseconds(2000), milliseconds(2000), seed * 7919);
    waits.insert(backoff.next());
  }
  EXPECT_GT(waits.size(), 25u);
}

}  // namespace
