#include "simulator/ers7/camera/scene_view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numeric>

namespace simulated_ers7 {
namespace {

using Eigen::Vector2d;

const double kDegree = std::acos(-1.0) / 180;

CameraPose degrees(double neck_tilt, double head_pan, double head_tilt) {
  CameraPose pose;
  pose.head.neck_tilt = neck_tilt * kDegree;
  pose.head.head_pan = head_pan * kDegree;
  pose.head.head_tilt = head_tilt * kDegree;
  return pose;
}

/// Centre of all pink pixels in the part of the picture around a point.
Vector2d middleOfPink(const YCrCbImage& picture, const Vector2d& around) {
  Vector2d sum = Vector2d::Zero();
  int count = 0;
  for (int y = 0; y < kPictureHeight; ++y) {
    for (int x = 0; x < kPictureWidth; ++x) {
      const Vector2d place(x + 0.5, y + 0.5);
      const auto i = static_cast<std::size_t>(y * kPictureWidth + x);
      if (picture.cr[i] > 165 && (place - around).norm() < 17) {
        sum += place;
        ++count;
      }
    }
  }
  return sum / count;
}

TEST(SceneView, TheBallAppearsWhereThePinholeProjectsIt) {
  Scene scene;
  SceneView view(scene, 1);
  for (const CameraPose& pose : {degrees(-25, 0, 10), degrees(-35, 12, 10), degrees(-20, -10, 0)}) {
    const YCrCbImage& picture = view.picture(pose, 0.3, 1, CameraSettings());
    const Eigen::Vector3d seen = (pose.body * cameraInBody(pose.head)).inverse() * scene.ballCenter();
    // By hand: 208 pixels over 56.9 degrees, 160 over 45.2.
    const Vector2d expected(104 - 104 / std::tan(28.45 * kDegree) * seen.y() / seen.x(),
                            80 - 80 / std::tan(22.6 * kDegree) * seen.z() / seen.x());
    EXPECT_LT((middleOfPink(picture, expected) - expected).norm(), 1.0) << expected.transpose();
  }
}

TEST(SceneView, FineDetailIsThatOfTheEdges) {
  Scene scene;
  SceneView view(scene, 1);
  double sharpness = 0;  // of the change between neighbours in a row, what double resolution has within a pixel of H
  for (const std::uint8_t detail : view.picture(degrees(-25, 0, 10), 1, 30, CameraSettings()).y_hl) {
    sharpness += std::abs(detail - 128) > 12 ? std::abs(detail - 128) : 0;  // more than noise
  }
  EXPECT_GT(sharpness, 2000);
  EXPECT_LT(sharpness, 5000) << "no edge is stronger than what is before and behind it";
}

/// Of a plane of the picture of the room.
double meanOf(YCrCbImage::Plane YCrCbImage::*plane, const CameraSettings& settings) {
  Scene scene;
  SceneView view(scene, 1);
  const YCrCbImage::Plane& values = view.picture({}, 1, 30, settings).*plane;
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

TEST(SceneView, MoreGainMakesItBrighterAFastShutterDarker) {
  const auto brightness = [](const CameraSettings& settings) { return meanOf(&YCrCbImage::y, settings); };
  CameraSettings settings;
  const double usual = brightness(settings);
  settings.gain = ocamparamGAIN_HIGH;
  EXPECT_GT(brightness(settings), 1.1 * usual);
  settings.gain = ocamparamGAIN_MID;
  settings.shutter = ocamparamSHUTTER_FAST;
  EXPECT_LT(brightness(settings), 0.9 * usual);
  settings.gain = ocamparamGAIN_LOW;
  settings.auto_exposure = true;
  EXPECT_EQ(brightness(settings), usual);
}

TEST(SceneView, WhiteBalanceForLampsMakesTheRoomBlue) {
  const auto blueness = [](const CameraSettings& settings) { return meanOf(&YCrCbImage::cb, settings); };
  CameraSettings settings;
  const double usual = blueness(settings);
  settings.white_balance = ocamparamWB_INDOOR_MODE;
  EXPECT_GT(blueness(settings), usual + 5);
  settings.white_balance = ocamparamWB_OUTDOOR_MODE;
  EXPECT_LT(blueness(settings), usual - 1);
  settings.auto_white_balance = true;
  EXPECT_EQ(blueness(settings), usual);
}

TEST(Scene, ATableHasAnEdgeAndABoard) {
  const Scene scene(true);
  EXPECT_EQ(scene.groundAt({0, 0}), 0.7);
  EXPECT_EQ(scene.groundAt({kTableX + 0.79, -0.59}), 0.7);
  EXPECT_EQ(scene.groundAt({kTableX + 0.81, 0}), 0);
  EXPECT_EQ(scene.groundAt({0, -0.61}), 0);
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
