#include "tools/ball_finder.h"

#include <gtest/gtest.h>

#include <cmath>

namespace aibo_driver::ball {
namespace {

constexpr double kFocalLength = 96;  // pixels, of a mask that is 104 wide

// The rows are longer than they need to be.
sensor_msgs::Image emptyMask() {
  sensor_msgs::Image mask;
  mask.width = 104;
  mask.height = 80;
  mask.step = 3 * 104 + 7;
  mask.encoding = "rgb8";
  mask.data.resize(mask.step * mask.height, 255);
  for (std::size_t row = 0; row < mask.height; ++row) {
    std::fill_n(mask.data.begin() + static_cast<std::ptrdiff_t>(row * mask.step), 3 * mask.width, 0);
  }
  return mask;
}

void drawDisc(double x, double y, double radius, sensor_msgs::Image* mask) {
  for (int row = 0; row < 80; ++row) {
    for (int column = 0; column < 104; ++column) {
      if (std::hypot(column + 0.5 - x, row + 0.5 - y) < radius) {
        mask->data[static_cast<std::size_t>(row) * mask->step + 3 * static_cast<std::size_t>(column) + 1] = 1;
      }
    }
  }
}

TEST(BallFinder, FindsDirectionAndDistance) {
  sensor_msgs::Image mask = emptyMask();
  drawDisc(30, 60, 8, &mask);
  const auto ball = findBall(mask);
  ASSERT_TRUE(ball);
  EXPECT_NEAR(ball->left, (52 - 30) / kFocalLength, 0.002);
  EXPECT_NEAR(ball->up, (40 - 60) / kFocalLength, 0.002);
  EXPECT_NEAR(ball->distance, kBallRadius * kFocalLength / 8, 0.02);
}

TEST(BallFinder, ABallThatIsCutOffByTheBorderIsNoFartherAway) {
  sensor_msgs::Image mask = emptyMask();
  drawDisc(4, 40, 8, &mask);
  const auto ball = findBall(mask);
  ASSERT_TRUE(ball);
  EXPECT_NEAR(ball->distance, kBallRadius * kFocalLength / 8, 0.02);
}

TEST(BallFinder, TellsTheBoneFromTheBall) {
  for (const bool is_upright : {false, true}) {
    sensor_msgs::Image mask = emptyMask();
    drawDisc(70, 20, 5, &mask);
    for (int place = 10; place <= 50; place += 4) {
      drawDisc(is_upright ? 30 : place, is_upright ? place : 50, 6, &mask);  // a long thing, larger than the ball
    }
    const auto ball = findBall(mask);
    ASSERT_TRUE(ball);
    EXPECT_NEAR(ball->left, (52 - 70) / kFocalLength, 0.01);
  }
}

TEST(BallFinder, TheLargestIsTheNearest) {
  for (const double upper : {4, 8}) {
    sensor_msgs::Image mask = emptyMask();
    drawDisc(30, 20, upper, &mask);
    drawDisc(70, 60, 12 - upper, &mask);
    const auto ball = findBall(mask);
    ASSERT_TRUE(ball);
    EXPECT_NEAR(ball->left, (52 - (upper == 8 ? 30 : 70)) / kFocalLength, 0.002);
  }
}

TEST(BallFinder, FindsNothingInNoiseAndWhatIsNoMask) {
  sensor_msgs::Image mask = emptyMask();
  EXPECT_FALSE(findBall(mask));
  drawDisc(20, 20, 1, &mask);
  EXPECT_FALSE(findBall(mask)) << "a few pixels";
  drawDisc(50, 50, 9, &mask);
  EXPECT_TRUE(findBall(mask));
  mask.encoding = "mono8";
  EXPECT_FALSE(findBall(mask));
  mask.encoding = "rgb8";
  mask.data.pop_back();
  EXPECT_FALSE(findBall(mask));
}

}  // namespace
}  // namespace aibo_driver::ball
