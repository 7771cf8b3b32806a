#include "client/stall_detector.h"

#include <gtest/gtest.h>

using aibo_client::StallDetector;
using std::chrono::milliseconds;

namespace {

class StallDetectorTest : public testing::Test {
 protected:
  using TimePoint = StallDetector::TimePoint;

  /// The thread has not kept up once, and has caught up.
  StallDetectorTest() {
    now_ += milliseconds(200);
    detector_.bytesArrived(now_);
    now_ += StallDetector::kQuietTime;
    detector_.foundEmpty(now_);
  }

  /// A picture arrives whole; returns whether it is stale.
  bool pictureIsStale() {
    detector_.bytesArrived(now_);
    const bool stale = detector_.isStale(now_);
    detector_.foundEmpty(now_);
    return stale;
  }

  TimePoint now_ = TimePoint() + milliseconds(5000);
  StallDetector detector_{now_};
};

TEST_F(StallDetectorTest, NothingIsStaleWhileTheThreadKeepsUpOrTheRobotPauses) {
  for (int i = 0; i < 100; ++i) {
    now_ += milliseconds(i % 2 == 0 ? 32 : 40);
    EXPECT_FALSE(pictureIsStale());
  }
  for (int i = 0; i < 20; ++i) {
    EXPECT_LE(detector_.nextLook() - now_, StallDetector::kStallLimit / 2);
    now_ = detector_.nextLook();
    detector_.foundEmpty(now_);
  }
  EXPECT_FALSE(pictureIsStale());
}

TEST_F(StallDetectorTest, AfterAStallPicturesAreStaleUntilTheSocketHasBeenQuiet) {
  now_ += milliseconds(5000);
  EXPECT_TRUE(pictureIsStale());
  now_ += milliseconds(5);
  EXPECT_TRUE(pictureIsStale()) << "the robot has just refilled the freed window";
  now_ = detector_.nextLook();
  detector_.foundEmpty(now_);
  now_ += milliseconds(10);
  EXPECT_FALSE(pictureIsStale());
}

TEST_F(StallDetectorTest, APictureThatBeganBeforeTheQuietIsStaleEvenIfItEndsAfterIt) {
  now_ += milliseconds(5000);
  const TimePoint begin = now_;
  detector_.bytesArrived(begin);
  detector_.foundEmpty(begin);
  now_ += StallDetector::kQuietTime;
  detector_.foundEmpty(now_);
  now_ += milliseconds(5);
  detector_.bytesArrived(now_);
  EXPECT_TRUE(detector_.isStale(begin));
  EXPECT_FALSE(detector_.isStale(now_));
}

TEST_F(StallDetectorTest, ARobotThatNeverPausesIsCaughtUpWithInTheEnd) {
  now_ += milliseconds(200);
  const TimePoint begin = now_;
  int stale = 0;
  while (stale < 1000 && pictureIsStale()) {
    ++stale;
    now_ += milliseconds(1);
  }
  EXPECT_TRUE(detector_.isStale(begin)) << "this one has waited";
  EXPECT_GE(stale, StallDetector::kCatchUpLimit.count());
  EXPECT_LE(stale, StallDetector::kCatchUpLimit.count() + 2);
  now_ += milliseconds(1);
  EXPECT_FALSE(pictureIsStale());
}

}  // namespace
