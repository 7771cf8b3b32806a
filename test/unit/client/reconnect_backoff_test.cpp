#include "client/reconnect_backoff.h"

#include <gtest/gtest.h>

#include <set>

using std::chrono::milliseconds;

namespace {

TEST(ReconnectBackoffTest, WaitsDoubleUpToTheLimitLessARandomPart) {
  std::set<milliseconds> last_waits;
  for (unsigned seed = 1; seed < 200; ++seed) {
    aibo_client::ReconnectBackoff backoff(milliseconds(100), milliseconds(2000), seed);
    for (const int whole : {100, 200, 400, 800, 1600, 2000, 2000, 2000}) {
      const milliseconds wait = backoff.next();
      EXPECT_GE(wait, milliseconds(whole / 2));
      EXPECT_LE(wait, milliseconds(whole));
    }
    last_waits.insert(backoff.next());
  }
  EXPECT_GT(last_waits.size(), 100u) << "clients that lost the same robot come back at different times";
}

}  // namespace
