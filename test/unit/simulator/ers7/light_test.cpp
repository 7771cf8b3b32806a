#include "simulator/ers7/scene/light.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace simulated_ers7 {
namespace {

using Eigen::Vector3d;

const Vector3d kUp(0, 0, 1);
const Vector3d kPoint = Vector3d::Constant(1e-4);  // a pixel that is nearly a point

Color albedoOf(Surface surface, const Vector3d& point, const Vector3d& normal, const Vector3d& pixel = kPoint) {
  return appearanceOf({0, point, normal, point, surface}, pixel).albedo;
}

/// @param x ahead of the carpet's middle
Color floorAt(double x, double y, const Vector3d& pixel = kPoint) {
  return albedoOf(Surface::kFloor, {kCarpetX + x, y, 0}, kUp, pixel);
}

char nameOf(const Color& color) {
  const std::vector<std::pair<char, Color>> known = {
      {'g', {0.075, 0.235, 0.085}}, {'w', {0.75, 0.75, 0.72}}, {'o', {0.42, 0.25, 0.125}}, {'c', {0.62, 0.555, 0.45}},
      {'d', {0.16, 0.25, 0.36}},    {'s', {0.72, 0.42, 0.16}}, {'t', {0.10, 0.36, 0.38}},  {'y', {1.9, 2.2, 2.6}},
      {'u', {0.31, 0.28, 0.225}},   {'b', {0.03, 0.16, 0.50}}, {'p', {0.75, 0.10, 0.28}}};
  char nearest = '?';
  double least = 0.2;
  for (const auto& [name, each] : known) {
    const double distance = (color - each).matrix().norm();
    if (distance < least) {
      least = distance;
      nearest = name;
    }
  }
  return nearest;
}

TEST(Light, TheCarpetHasTheLinesOfItsField) {
  const double length = kCarpetHalfLength - kLineInset;
  const double width = kCarpetHalfWidth - kLineInset;
  const double area = length - kPenaltyAreaDepth;
  const double diagonal = kCenterCircleRadius * std::sqrt(0.5);
  for (const double end : {-1.0, 1.0}) {
    for (const double side : {-1.0, 1.0}) {
      // Of each line: a place, and the direction across.
      const std::vector<std::pair<Vector3d, Vector3d>> lines = {
          {{end * length, side * 0.8, 0}, {1, 0, 0}},
          {{end * 0.7, side * width, 0}, {0, 1, 0}},
          {{0, side * 0.8, 0}, {1, 0, 0}},
          {{end * area, side * 0.3, 0}, {1, 0, 0}},
          {{end * (area + 0.2), side * kPenaltyAreaHalfWidth, 0}, {0, 1, 0}},
          {{end * diagonal, side * diagonal, 0}, {end * std::sqrt(0.5), side * std::sqrt(0.5), 0}}};
      for (const auto& [place, across] : lines) {
        for (const double off : {-0.016, -0.011, 0.0, 0.011, 0.016}) {
          const Vector3d point = place + off * across;
          EXPECT_EQ(nameOf(floorAt(point.x(), point.y())), std::abs(off) < kLineHalfWidth ? 'w' : 'g')
              << point.transpose();
        }
      }
      EXPECT_EQ(nameOf(floorAt(0, side * (width + 0.05))), 'g') << "the halfway line ends at the border";
      EXPECT_EQ(nameOf(floorAt(end * area, side * (kPenaltyAreaHalfWidth + 0.05))), 'g');
      EXPECT_EQ(nameOf(floorAt(end * (area - 0.05), side * kPenaltyAreaHalfWidth)), 'g');
      EXPECT_EQ(nameOf(floorAt(end * (kCarpetHalfLength - 0.01), side * (kCarpetHalfWidth - 0.01))), 'g');
      EXPECT_EQ(nameOf(floorAt(end * (kCarpetHalfLength + 0.01), 0.033)), 'o');
      EXPECT_EQ(nameOf(floorAt(0.03, side * (kCarpetHalfWidth + 0.01))), 'o');
    }
  }
}

TEST(Light, APixelHasTheMeanOfWhatItCovers) {
  const double lines = 0.94;  // how white a line is
  const double green = 0.235;
  const double white = green + lines * (0.80 - green);
  EXPECT_NEAR(floorAt(0, 0.8, {0.1, 0.1, 0})[1], green + 0.25 * (white - green), 0.02) << "a quarter is line";
  EXPECT_NEAR(floorAt(0.7, kCarpetHalfWidth - kLineInset, {0.1, 0.1, 0})[1], green + 0.25 * (white - green), 0.02);
  EXPECT_NEAR(floorAt(kCenterCircleRadius, 0, {0.1, 0.1, 0})[1], green + 0.25 * (white - green), 0.02);
  EXPECT_NEAR(floorAt(kCarpetHalfLength, 0.5, {0.2, 0.2, 0})[0], (0.075 + 0.42) / 2, 0.08) << "half is floor";
  double sum = 0;
  for (int i = 0; i < 4000; ++i) {
    sum += floorAt(0.4 + 0.0097 * (i % 64), 0.4 + 0.0097 * (i / 64))[1];
  }
  EXPECT_NEAR(floorAt(0.7, 0.7, {0.6, 0.6, 0})[1], sum / 4000, 0.01) << "far away, the pile is its mean";
}

TEST(Light, TheParquetHasPlanksOfDifferentTonesWithDarkGaps) {
  const double y = kCarpetHalfWidth + 0.1;
  double brightest = 0;
  double darkest = 1;
  for (double x = -2; x < 2; x += 0.05) {
    const double tone = floorAt(x, y + 0.05)[0];
    brightest = std::max(brightest, tone);
    darkest = std::min(darkest, tone);
  }
  EXPECT_GT(brightest / darkest, 1.15);
  int dark = 0;
  for (int i = 0; i < 1000; ++i) {
    dark += floorAt(0.33, y + 0.0005 * i)[0] < 0.24 ? 1 : 0;
  }
  EXPECT_NEAR(dark, 40, 8) << "4 mm of 100";
}

TEST(Light, TheWallsHaveADoorAWindowAndTwoPictures) {
  const auto ahead = [](double y, double z) {
    return nameOf(albedoOf(Surface::kWall, {kHighestCorner[0], y, z}, {-1, 0, 0}));
  };
  const auto left = [](double x, double z) {
    return nameOf(albedoOf(Surface::kWall, {x, kHighestCorner[1], z}, {0, -1, 0}));
  };
  const auto right = [](double x, double z) {
    return nameOf(albedoOf(Surface::kWall, {x, kLowestCorner[1], z}, {0, 1, 0}));
  };
  const auto behind = [](double y, double z) {
    return nameOf(albedoOf(Surface::kWall, {kLowestCorner[0], y, z}, {1, 0, 0}));
  };
  EXPECT_EQ(ahead(-0.9, 1), 'd');
  EXPECT_EQ(ahead(-1.29, 1.99), 'd');
  EXPECT_EQ(ahead(-1.33, 1), 'w') << "the door's frame";
  EXPECT_EQ(ahead(-0.9, 2.03), 'w');
  EXPECT_EQ(ahead(-0.9, 2.1), 'c');
  EXPECT_EQ(ahead(-1.4, 1), 'c');
  EXPECT_EQ(ahead(0.5, 0.7), 's');
  EXPECT_EQ(ahead(0.5, 0.405), 'o');
  EXPECT_EQ(ahead(0.915, 0.7), 'o');
  EXPECT_EQ(ahead(0.5, 1.1), 'c');
  EXPECT_EQ(left(1, 1), 'y');
  EXPECT_EQ(left(0.37, 1), 'w');
  EXPECT_EQ(left(0.3, 1), 'c');
  EXPECT_EQ(left(1, 2.1), 'c');
  EXPECT_EQ(right(0.9, 0.8), 't');
  EXPECT_EQ(right(0.58, 0.8), 'o');
  EXPECT_EQ(right(0.9, 1.2), 'c');
  EXPECT_EQ(right(1.4, 0.8), 'c');
  for (const double place : {-1.0, 0.0, 0.5, 1.0}) {
    EXPECT_EQ(behind(place, 1), 'c');
    EXPECT_EQ(behind(place, 0.04), 'w') << "the skirting board";
    EXPECT_EQ(behind(place, 0.086), 'u') << "a groove";
    EXPECT_EQ(behind(place, 0.095), 'c');
  }
}

TEST(Light, ThePoleHasItsBands) {
  const auto pole = [](double z) { return nameOf(albedoOf(Surface::kStationPole, {0, 0, z}, {1, 0, 0})); };
  EXPECT_EQ(pole(-0.04), 'w');
  EXPECT_EQ(pole(-0.03), 'b');
  EXPECT_EQ(pole(0.015), 'b');
  EXPECT_EQ(pole(0.03), 'w');
  EXPECT_EQ(pole(0.05), 'p');
  EXPECT_EQ(pole(0.095), 'p');
  EXPECT_EQ(pole(0.105), 'w');
}

TEST(Light, TheBallCastsAShadowAwayFromTheLampAndIsDarkWhereItTouchesTheFloor) {
  Scene scene;
  scene.setTime(0);
  const Vector3d to_lamp = Vector3d(-0.42, 0.50, 0.76).normalized();
  const auto onFloor = [&](const Vector3d& from_ball) {
    Vector3d point = scene.ballCenter() + from_ball;
    point.z() = 0;
    return illuminationOf(scene, {0, point, kUp, point, Surface::kFloor});
  };
  const Vector3d shadow = -to_lamp * (kBallRadius / to_lamp.z());
  EXPECT_NEAR(onFloor(shadow).lamp, 0, 0.02);
  EXPECT_NEAR(onFloor(-2 * shadow).lamp, to_lamp.z(), 1e-9) << "on the lamp's side";
  EXPECT_NEAR(onFloor(6 * shadow).lamp, to_lamp.z(), 1e-9) << "beyond the shadow";
  const double edge = onFloor(shadow + Vector3d(0.50, 0.42, 0).normalized() * kBallRadius).lamp;
  EXPECT_GT(edge, 0.1) << "it is soft";
  EXPECT_LT(edge, to_lamp.z() - 0.1);
  const double open = onFloor({0.3, 0, 0}).openness;
  EXPECT_LT(onFloor({0.01, 0, 0}).openness, 0.5 * open);
  EXPECT_NEAR(onFloor({-0.3, 0, 0}).openness, open, 0.02);
}

TEST(Light, CornersOfTheRoomAreDarkerAndOnlyWhatFacesTheLampIsLit) {
  const Scene scene;
  const auto at = [&](const Vector3d& point, const Vector3d& normal) {
    return illuminationOf(scene, {0, point, normal, point, Surface::kWall});
  };
  EXPECT_LT(at({kLowestCorner[0] + 0.01, 0, 0}, kUp).openness, 0.7 * at({0, 0, 0}, kUp).openness);
  EXPECT_LT(at({0, kHighestCorner[1] - 0.01, 0}, kUp).openness, 0.7 * at({0, 0, 0}, kUp).openness);
  EXPECT_GT(at({0, kLowestCorner[1], 1.2}, {0, 1, 0}).lamp, 0.4);
  EXPECT_EQ(at({0, kHighestCorner[1], 1.2}, {0, -1, 0}).lamp, 0);
}

TEST(Light, VarnishShinesWhereItMirrorsTheLampAndClothDoesNot) {
  const Vector3d to_lamp = Vector3d(-0.42, 0.50, 0.76).normalized();
  const SceneHit floor = {0, {0, 0, 0}, kUp, {0, 0, 0}, Surface::kFloor};
  const Vector3d mirrored(to_lamp.x(), to_lamp.y(), -to_lamp.z());  // from there, the lamp is in the mirror
  const Vector3d other(-to_lamp.x(), -to_lamp.y(), -to_lamp.z());
  const Appearance varnish = {Color::Constant(0.5), 1};
  const Illumination lit = {0.8, 1};
  const Color dull = lightFrom(floor, {Color::Constant(0.5), 0}, lit, mirrored);
  EXPECT_TRUE((dull - 0.5 * (Color(0.56, 0.58, 0.62) + 0.8 * Color(0.96, 0.91, 0.82))).matrix().norm() < 1e-9);
  EXPECT_NEAR((lightFrom(floor, varnish, lit, mirrored) - dull)[0], 0.8 * 0.96, 1e-9);
  EXPECT_NEAR((lightFrom(floor, varnish, lit, other) - dull)[0], 0, 1e-3);
  EXPECT_NEAR((lightFrom(floor, varnish, {0, 1}, mirrored))[0], 0.5 * 0.56, 1e-9) << "in the shadow";
  const SceneHit below = {0, {0, 0, 0}, -kUp, {0, 0, 0}, Surface::kFloor};
  EXPECT_NEAR(lightFrom(below, {Color::Constant(1), 0}, {0, 0.5}, mirrored)[1], 0.5 * 0.35, 1e-9);
}

}  // namespace
}  // namespace simulated_ers7
