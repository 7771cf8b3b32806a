#include "sound/level.h"

#include <gtest/gtest.h>

using aibo_driver::sound::Level;

namespace {

TEST(Level, IsThatOfWhatWasHeardSinceTheLastOne) {
  Level level;
  level.add({-32768, -32768});
  level.add({-32768});
  EXPECT_EQ(3u, level.count());
  EXPECT_NEAR(0, level.take(), 0.01);
  level.add({3277, -3277, 3277, -3277});
  EXPECT_EQ(4u, level.count());
  EXPECT_NEAR(-20, level.take(), 0.01) << "a tenth";
}

TEST(Level, OfSilenceIsANumber) {
  Level level;
  level.add({0, 0});
  EXPECT_NEAR(-90.3, level.take(), 0.01);
}

}  // namespace
