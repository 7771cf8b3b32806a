#include "rcserver/walk/FallWatch.h"

#include <gmock/gmock.h>

#include <cmath>

namespace {

using ::testing::HasSubstr;

constexpr double kGravity = 9.80665;
constexpr double kDegree = 3.14159265358979323846 / 180;

class FallWatchTest : public ::testing::Test {
 protected:
  static FallWatch::Reading rolledBy(double degrees, bool paws = true) {
    return {
        0, kGravity * std::sin(degrees * kDegree), kGravity * std::cos(degrees * kDegree), {paws, paws, paws, paws}};
  }
  static FallWatch::Reading pitchedBy(double degrees) {
    return {kGravity * std::sin(degrees * kDegree), 0, kGravity * std::cos(degrees * kDegree), {}};
  }

  // A report every 4 frames.
  void look(const FallWatch::Reading& reading, unsigned frames, bool stands = true) {
    for (unsigned passed = 0; passed < frames; passed += 4) {
      frame_ += 4;
      watch_.Look(reading, stands, frame_);
    }
  }

  FallWatch watch_;
  unsigned frame_ = 0xffffff00u;  // it begins again at 0 on the way
};

TEST_F(FallWatchTest, ARobotThatSitsOrStandsOnASlopeIsUpright) {
  look(pitchedBy(25), 500);
  EXPECT_EQ(watch_.Now(), FallWatch::UPRIGHT);
  look(rolledBy(-55), 500);
  EXPECT_EQ(watch_.Now(), FallWatch::UPRIGHT);
  EXPECT_EQ(FallWatch::Words(watch_.Now()), nullptr);
}

TEST_F(FallWatchTest, FindsTheRobotOnEitherSideOrOnItsNose) {
  for (const FallWatch::Reading& reading : {rolledBy(80), pitchedBy(-80), pitchedBy(65), rolledBy(-80)}) {
    look(reading, 80);
    EXPECT_EQ(watch_.Now(), reading.left < 0 ? FallWatch::ON_LEFT_SIDE : FallWatch::ON_RIGHT_SIDE);
    EXPECT_THAT(FallWatch::Words(watch_.Now()), HasSubstr(reading.left < 0 ? "left side" : "right side"));
    look(rolledBy(0), 80);
    EXPECT_EQ(watch_.Now(), FallWatch::UPRIGHT);
  }
}

TEST_F(FallWatchTest, FindsTheRobotUpsideDown) {
  look(rolledBy(170), 80);
  EXPECT_EQ(watch_.Now(), FallWatch::UPSIDE_DOWN);
  EXPECT_THAT(FallWatch::Words(watch_.Now()), HasSubstr("on its back"));
  look(rolledBy(140), 80);
  EXPECT_EQ(watch_.Now(), FallWatch::ON_RIGHT_SIDE) << "it leans on its legs";
}

TEST_F(FallWatchTest, AKnockIsNoFall) {
  look(rolledBy(90), FallWatch::PATIENCE - 4);
  look(rolledBy(0), 20);
  look(rolledBy(90), FallWatch::PATIENCE - 4);
  EXPECT_EQ(watch_.Now(), FallWatch::UPRIGHT);
}

TEST_F(FallWatchTest, ARobotThatLiesAndShakesHasFallen) {
  for (int shake = 0; shake < 10; ++shake) {
    look(rolledBy(100), 4);
    look(rolledBy(45), 4);
  }
  EXPECT_EQ(watch_.Now(), FallWatch::ON_RIGHT_SIDE);
}

TEST_F(FallWatchTest, ARobotThatTumblesFallsOnce) {
  for (int turn = 0; turn < 8; ++turn) {
    look(rolledBy(turn % 2 == 0 ? 90 : 180), 20);
  }
  EXPECT_EQ(watch_.Now(), FallWatch::UPSIDE_DOWN);
  EXPECT_GE(watch_.Duration(frame_), 148u);
}

TEST_F(FallWatchTest, CountsFromTheFirstReadings) {
  look(rolledBy(90), 200);
  EXPECT_EQ(watch_.Duration(frame_), 192u) << "the mean is that of a robot without an accelerometer at first";
}

TEST_F(FallWatchTest, AnAccelerometerThatMeasuresNothingSaysNothing) {
  look({0.5, -1, -0.5, {true, true, true, true}}, 500);
  EXPECT_EQ(watch_.Now(), FallWatch::UPRIGHT);
}

TEST_F(FallWatchTest, ARobotWithoutFloorUnderItsPawsIsCarriedUntilItStandsAgain) {
  look(rolledBy(0), 20);
  look(rolledBy(0, false), 60);
  EXPECT_EQ(watch_.Now(), FallWatch::CARRIED);
  EXPECT_THAT(FallWatch::Words(watch_.Now()), HasSubstr("carried"));
  look(rolledBy(0), 60);
  EXPECT_EQ(watch_.Now(), FallWatch::UPRIGHT);
}

TEST_F(FallWatchTest, PawsThatLoseTheFloorForOneStepAreWalking) {
  for (int step = 0; step < 10; ++step) {
    look(rolledBy(0), 4);
    look(rolledBy(0, false), FallWatch::PATIENCE - 4);
  }
  EXPECT_EQ(watch_.Now(), FallWatch::UPRIGHT);
}

TEST_F(FallWatchTest, PawsThatHaveNeverTouchedAnythingSayNothing) {
  look(rolledBy(0, false), 500);
  EXPECT_EQ(watch_.Now(), FallWatch::UPRIGHT);
}

TEST_F(FallWatchTest, ARobotOnItsShanksIsNotCarried) {
  FallWatch::Reading reading = rolledBy(0);
  reading.paws[0] = reading.paws[1] = false;
  look(reading, 100);
  look(rolledBy(0, false), 500);
  EXPECT_EQ(watch_.Now(), FallWatch::UPRIGHT);
}

TEST_F(FallWatchTest, ARobotThatLiesOnItsBellyNeedsNoPaws) {
  look(rolledBy(0), 20);
  look(rolledBy(0, false), 500, false);
  EXPECT_EQ(watch_.Now(), FallWatch::UPRIGHT);
}

}  // namespace
