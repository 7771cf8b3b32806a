#include "simulator/ers7/camera/camera.h"
#include "simulator/openr_host/clock.h"

#include <gtest/gtest.h>

#include <map>

namespace simulated_ers7 {
namespace {

TEST(CameraTiming, FiveOfSixImagesComeAfter32MillisecondsAndTheOthersAfter40) {
  std::map<longword, int> gaps;
  longword last = 0;
  for (longword frame = 1; frame <= 125 * 60; ++frame) {
    if (imagesUpTo(frame) != imagesUpTo(frame - 1)) {
      EXPECT_EQ(imagesUpTo(frame), imagesUpTo(frame - 1) + 1);
      ++gaps[frame - last];
      last = frame;
    }
  }
  ASSERT_EQ(gaps.size(), 2u);
  const double share_of_32 = static_cast<double>(gaps[4]) / (gaps[4] + gaps[5]);
  EXPECT_NEAR(share_of_32, 0.82, 0.02);
}

TEST(CameraTiming, TheMeanIs33Point47Milliseconds) {
  const longword frames = 125 * 3600;
  EXPECT_NEAR(frames * openr_host::kFrameSeconds / imagesUpTo(frames), 0.03347, 0.00001);
}

TEST(CameraTiming, TheFirstImageComesInTheFirstFrame) {
  EXPECT_EQ(imagesUpTo(0), 1u);
  EXPECT_EQ(imagesUpTo(1), 1u);
}

}  // namespace
}  // namespace simulated_ers7
