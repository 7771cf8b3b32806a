#include "simulator/ers7/scene/scene.h"

#include <gtest/gtest.h>

namespace simulated_ers7 {
namespace {

TEST(Scene, ATableHasAnEdgeAndABoard) {
  const Scene scene(true);
  EXPECT_EQ(scene.groundAt({0, 0}), kTableHeight);
  EXPECT_EQ(scene.groundAt({kTableX + kTableHalfLength + 0.01, 0}), 0);
  EXPECT_EQ(scene.groundAt({0, -kTableHalfWidth - 0.01}), 0);
  EXPECT_EQ(Scene().groundAt({0, 0}), 0);
  const SceneHit top = scene.castRay({{0, 0, 1}, {0, 0, -1}});
  EXPECT_EQ(top.surface, Surface::kWood);
  EXPECT_NEAR(top.distance, 1 - kTableHeight, 1e-9);
  EXPECT_EQ(scene.castRay({{kTableX + kTableHalfLength + 0.01, 0, 1}, {0, 0, -1}}).surface, Surface::kFloor);
  const SceneHit board = scene.castRay({{0, 0, kTableHeight + 0.1}, {0, 1, 0}});
  EXPECT_NEAR(board.distance, kTableHalfWidth - kBoardThickness, 1e-9);
  EXPECT_NEAR(scene.clearance({0, 0, kTableHeight + 0.1}), kTableHalfWidth - kBoardThickness, 1e-9)
      << "the table is no obstacle";
}

TEST(Scene, TheBallRollsToAndFro) {
  Scene scene;
  scene.setTime(0);
  const Eigen::Vector3d start = scene.ballCenter();
  scene.setTime(kBallPeriod / 4);
  const Eigen::Vector3d left = scene.ballCenter();
  EXPECT_NEAR(left.y() - start.y(), kBallSwing, 1e-9);
  scene.setTime(kBallPeriod * 3 / 4);
  EXPECT_NEAR(scene.ballCenter().y() - start.y(), -kBallSwing, 1e-9);
  scene.setTime(kBallPeriod * 100);
  EXPECT_TRUE(scene.ballCenter().isApprox(start, 1e-9));
}

}  // namespace
}  // namespace simulated_ers7
