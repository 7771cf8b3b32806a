#include "simulator/ers7/scene/shapes.h"

#include <gtest/gtest.h>

#include <cmath>

namespace simulated_ers7 {
namespace {

using Eigen::Vector3d;

const Capsule kSphere{{3, 0, 0}, {3, 0, 0}, 1};
const Capsule kCapsule{{5, -1, 0}, {5, 1, 0}, 0.5};
const Box kBox{{4, 0, 0}, {1, 2, 3}};

void expectHit(const Ray& ray, const Shape& shape, double distance, const Vector3d& normal) {
  const auto hit = intersect(ray, shape);
  ASSERT_TRUE(hit.has_value());
  EXPECT_NEAR(hit->distance, distance, 1e-12);
  EXPECT_TRUE(hit->normal.isApprox(normal, 1e-9)) << hit->normal.transpose();
}

Ray rayAhead(double y, double z) {
  return {{0, y, z}, Vector3d::UnitX()};
}

TEST(Shapes, ARayHitsTheNearSideOfASphere) {
  expectHit(rayAhead(0, 0), kSphere, 2, {-1, 0, 0});
  expectHit(rayAhead(0.6, 0), kSphere, 3 - 0.8, {-0.8, 0.6, 0});
}

TEST(Shapes, ARayHitsTheSideAndTheCapsOfACapsule) {
  expectHit(rayAhead(0.7, 0), kCapsule, 4.5, {-1, 0, 0});
  expectHit(rayAhead(0.7, 0.3), kCapsule, 5 - 0.4, {-0.8, 0, 0.6});
  expectHit(rayAhead(1.3, 0), kCapsule, 5 - 0.4, {-0.8, 0.6, 0});
}

TEST(Shapes, ARayAlongACapsuleHitsItsCap) {
  expectHit({{5, -4, 0}, Vector3d::UnitY()}, kCapsule, 2.5, {0, -1, 0});
}

TEST(Shapes, ARayHitsTheNearFaceOfABox) {
  expectHit(rayAhead(1.9, -2.9), kBox, 3, {-1, 0, 0});
  expectHit({{4, 5, 0}, {0, -1, 0}}, kBox, 3, {0, 1, 0});
  expectHit({{0, 0, 6}, Vector3d(4, 0, -3).normalized()}, kBox, 5, {0, 0, 1});
}

TEST(Shapes, ARayThatMissesOrPointsAwayHitsNothing) {
  for (const Shape& shape : {Shape(kSphere), Shape(kCapsule), Shape(kBox)}) {
    EXPECT_FALSE(intersect(rayAhead(3.5, 0), shape).has_value());
    EXPECT_FALSE(intersect(rayAhead(-3.5, 0), shape).has_value());
    EXPECT_FALSE(intersect(Ray{{9, 0, 0}, Vector3d::UnitX()}, shape).has_value());
  }
}

TEST(Shapes, TheSignedDistanceIsNegativeInside) {
  EXPECT_NEAR(signedDistance({0, 4, 0}, kSphere), 4, 1e-12);
  EXPECT_NEAR(signedDistance({3, 0, 0.25}, kSphere), -0.75, 1e-12);
  EXPECT_NEAR(signedDistance({5, 0, 2}, kCapsule), 1.5, 1e-12);
  EXPECT_NEAR(signedDistance({4, 5, 7}, kBox), 5, 1e-12);
  EXPECT_NEAR(signedDistance({4.75, 0, 0}, kBox), -0.25, 1e-12);
}

}  // namespace
}  // namespace simulated_ers7
