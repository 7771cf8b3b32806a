#include "simulator/ers7/camera/scene_view.h"

#include <gtest/gtest.h>
#include <turbojpeg.h>

#include <cmath>
#include <cstdlib>
#include <memory>
#include <vector>

#include "simulator/ers7/camera/camera_optics.h"

namespace simulated_ers7 {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

const double kDegree = std::acos(-1.0) / 180;

HeadAngles degrees(double neck_tilt, double head_pan, double head_tilt) {
  HeadAngles head;
  head.neck_tilt = neck_tilt * kDegree;
  head.head_pan = head_pan * kDegree;
  head.head_tilt = head_tilt * kDegree;
  return head;
}

/// The robot's view when it looks around.
const HeadAngles kViews[] = {degrees(-25, 0, 10), degrees(-10, 40, 0), degrees(-30, -25, 0), degrees(0, 0, 0)};

/// Chroma at half the width and height, as in a 4:2:0 JPEG.
YCrCbImage::Plane quartered(const YCrCbImage::Plane& plane) {
  YCrCbImage::Plane half;
  for (std::size_t y = 0; y < kPictureHeight; y += 2) {
    for (std::size_t x = 0; x < kPictureWidth; x += 2) {
      const std::size_t i = y * kPictureWidth + x;
      const int sum = plane[i] + plane[i + 1] + plane[i + kPictureWidth] + plane[i + kPictureWidth + 1];
      half.push_back(static_cast<std::uint8_t>((sum + 2) / 4));
    }
  }
  return half;
}

unsigned long jpegSize(const YCrCbImage& picture) {
  const std::unique_ptr<void, int (*)(tjhandle)> encoder(tjInitCompress(), tjDestroy);
  const auto cb = quartered(picture.cb);
  const auto cr = quartered(picture.cr);
  const unsigned char* planes[] = {picture.y.data(), cb.data(), cr.data()};
  unsigned char* jpeg = nullptr;
  unsigned long size = 0;
  EXPECT_EQ(tjCompressFromYUVPlanes(encoder.get(), planes, kPictureWidth, nullptr, kPictureHeight, TJSAMP_420, &jpeg,
                                    &size, 85, 0),
            0);
  tjFree(jpeg);
  return size;
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

TEST(SceneView, AtQuality85APictureHas3To6KilobytesAsInTheReport) {
  Scene scene;
  SceneView view(scene, 1);
  for (const HeadAngles& head : kViews) {
    view.setHead(head);
    const unsigned long size = jpegSize(view.picture(1, 30, CameraSettings()));
    EXPECT_GE(size, 3000u) << "with the head panned by " << head.head_pan;
    EXPECT_LE(size, 6 * 1024u) << "with the head panned by " << head.head_pan;
  }
}

TEST(SceneView, TheBallAppearsWhereThePinholeProjectsIt) {
  Scene scene;
  SceneView view(scene, 1);
  for (const HeadAngles& head : {degrees(-25, 0, 10), degrees(-35, 12, 10), degrees(-20, -10, 0)}) {
    view.setHead(head);
    const YCrCbImage& picture = view.picture(0.3, 1, CameraSettings());
    const Vector3d seen = view.camera().inverse() * scene.ballCenter();
    // By hand: 208 pixels over 56.9 degrees, 160 over 45.2.
    const Vector2d expected(104 - 104 / std::tan(28.45 * kDegree) * seen.y() / seen.x(),
                            80 - 80 / std::tan(22.6 * kDegree) * seen.z() / seen.x());
    EXPECT_LT((middleOfPink(picture, expected) - expected).norm(), 1.0) << expected.transpose();
  }
}

TEST(SceneView, InitiallyTheBallAndTheStationAreInThePicture) {
  Scene scene;
  const SceneView view(scene, 1);
  const Eigen::Isometry3d camera = view.camera();
  bool station_seen = false;
  for (double y = 0.5; y < kPictureHeight; ++y) {
    for (double x = 0.5; x < kPictureWidth; ++x) {
      const Ray ray{camera.translation(), camera.linear() * directionOf({x, y})};
      station_seen = station_seen || scene.castRay(ray).surface == Surface::kStationPole;
    }
  }
  EXPECT_TRUE(station_seen);
  const Vector2d ball = placeOf(camera.inverse() * scene.ballCenter());
  EXPECT_TRUE((ball.array() > 20).all() && ball.x() < kPictureWidth - 20 && ball.y() < kPictureHeight - 20);
}

TEST(SceneView, OnlyTheSameSeedAndImageGiveTheSamePicture) {
  Scene scene;
  SceneView view(scene, 7);
  const YCrCbImage first = view.picture(1, 30, CameraSettings());
  Scene other_scene;
  SceneView same(other_scene, 7);
  EXPECT_EQ(same.picture(1, 30, CameraSettings()).y, first.y);
  EXPECT_NE(same.picture(1, 31, CameraSettings()).y, first.y);
  SceneView other_seed(other_scene, 8);
  const YCrCbImage other = other_seed.picture(1, 30, CameraSettings());
  EXPECT_NE(other.y, first.y);
  EXPECT_NE(other.y_lh, first.y_lh);
}

/// The end of the ray through the middle of a pixel, with nothing left out.
SceneHit hitAt(const Scene& scene, const Eigen::Isometry3d& camera, double x, double y) {
  return scene.castRay({camera.translation(), camera.linear() * directionOf({x + 0.5, y + 0.5})});
}

bool isFaceOf(const SceneHit& one, const SceneHit& other) {
  return one.surface == other.surface && one.normal.dot(other.normal) > 0.8;
}

/// The light from a point with nothing left out. The pixel's size on the surface matters to its texture.
Color lightOf(const Scene& scene, const Eigen::Isometry3d& camera, const SceneHit& hit) {
  const Vector3d direction = (hit.point - camera.translation()).normalized();
  const double width = hit.distance / focalLengthX();
  const double slant = direction.dot(hit.normal);
  const Vector3d stretched = (1 / std::max(std::abs(slant), 0.02) - 1) * (direction - slant * hit.normal).cwiseAbs();
  const Appearance appearance = appearanceOf(hit, width * (Vector3d::Ones() + stretched));
  return lightFrom(hit, appearance, illuminationOf(scene, hit), direction);
}

TEST(SceneView, WhatTheRendererLeavesOutDoesNotShow) {
  const Scene scene;
  int different = 0;
  int different_at_edges = 0;
  for (const double ahead : {0.0, 0.3, 0.45}) {
    for (const HeadAngles& head : kViews) {
      const Eigen::Isometry3d camera = Eigen::Translation3d(ahead, 0, kStandingHeight) * cameraInBody(head);
      Renderer renderer(scene);
      const LightImage& picture = renderer.render(camera);
      for (int y = 1; y < kPictureHeight - 1; ++y) {
        for (int x = 1; x < kPictureWidth - 1; ++x) {
          const Color drawn = picture[static_cast<std::size_t>(y * kPictureWidth + x)];
          const SceneHit hit = hitAt(scene, camera, x, y);
          if (isFaceOf(hitAt(scene, camera, x - 1, y), hit) && isFaceOf(hitAt(scene, camera, x + 1, y), hit) &&
              isFaceOf(hitAt(scene, camera, x, y - 1), hit) && isFaceOf(hitAt(scene, camera, x, y + 1), hit)) {
            const double difference = (drawn - lightOf(scene, camera, hit)).abs().maxCoeff();
            different += difference > 0.03 ? 1 : 0;
          } else {
            Color mean = Color::Zero();
            for (const double across : {-0.25, 0.25}) {
              for (const double down : {-0.25, 0.25}) {
                mean += lightOf(scene, camera, hitAt(scene, camera, x + across, y + down)) / 4;
              }
            }
            different_at_edges += (drawn - mean).abs().maxCoeff() > 0.03 ? 1 : 0;
          }
        }
      }
    }
  }
  EXPECT_LT(different, 20) << "of 400,000 pixels";
  EXPECT_LT(different_at_edges, 1000) << "edges are smooth";
}

/// How much of the change between neighbours in a row the picture of double resolution has within a pixel of layer H.
double sharpness(const YCrCbImage& picture) {
  double sum = 0;
  for (const std::uint8_t detail : picture.y_hl) {
    sum += std::abs(detail - 128) > 12 ? std::abs(detail - 128) : 0;  // more than noise
  }
  return sum;
}

TEST(SceneView, FineDetailIsThatOfTheEdges) {
  Scene scene;
  SceneView view(scene, 1);
  view.setHead(degrees(-25, 0, 10));
  const YCrCbImage& picture = view.picture(1, 30, CameraSettings());
  EXPECT_GT(sharpness(picture), 2000);
  EXPECT_LT(sharpness(picture), 5000) << "no edge is stronger than what is before and behind it";
}

/// Deviation of the bands of fine detail where the picture is even.
double noiseOf(const YCrCbImage& picture) {
  double sum = 0;
  int count = 0;
  for (const std::uint8_t detail : picture.y_hh) {
    if (std::abs(detail - 128) < 12) {
      sum += (detail - 128) * (detail - 128);
      ++count;
    }
  }
  return std::sqrt(sum / count);
}

TEST(SceneView, FineDetailGetsNoisierWithTheGain) {
  Scene scene;
  SceneView view(scene, 1);
  CameraSettings settings;
  const double usual = noiseOf(view.picture(1, 30, settings));
  settings.gain = ocamparamGAIN_HIGH;
  EXPECT_GT(noiseOf(view.picture(1, 30, settings)), 1.5 * usual);
}

TEST(SceneView, MoreGainIsBrighterAndNoisierAFastShutterDarker) {
  Scene scene;
  SceneView view(scene, 1);
  const auto brightness = [&view](const CameraSettings& settings) {
    double sum = 0;
    for (const std::uint8_t y : view.picture(1, 30, settings).y) {
      sum += y;
    }
    return sum;
  };
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
  Scene scene;
  SceneView view(scene, 1);
  const auto blueness = [&view](const CameraSettings& settings) {
    double sum = 0;
    for (const std::uint8_t cb : view.picture(1, 30, settings).cb) {
      sum += cb;
    }
    return sum / (kPictureWidth * kPictureHeight);
  };
  CameraSettings settings;
  const double usual = blueness(settings);
  settings.white_balance = ocamparamWB_INDOOR_MODE;
  EXPECT_GT(blueness(settings), usual + 5);
  settings.white_balance = ocamparamWB_OUTDOOR_MODE;
  EXPECT_LT(blueness(settings), usual - 1);
  settings.auto_white_balance = true;
  EXPECT_EQ(blueness(settings), usual);
}

TEST(ImageSensor, EachBandOfTheFineDetailGoesToItsOwnPlane) {
  const ImageSensor sensor(1);
  constexpr std::size_t kPixels = std::size_t{kPictureWidth} * kPictureHeight;
  const LightImage light(kPixels, Color::Constant(0.3));
  for (int band = 0; band < 3; ++band) {
    const float strength = 0.4f;
    const FineDetail one = {band == 0 ? strength : 0, band == 1 ? strength : 0, band == 2 ? strength : 0};
    YCrCbImage picture;
    sensor.expose(light, DetailImage(kPixels, one), CameraSettings(), 1, &picture);
    int number = 0;
    for (const YCrCbImage::Plane* plane : {&picture.y_lh, &picture.y_hl, &picture.y_hh}) {
      double sum = 0;
      for (const std::uint8_t value : *plane) {
        sum += value;
      }
      const double mean = sum / kPixels - 128;
      EXPECT_NEAR(mean, number == band ? 35 : 0, number == band ? 25 : 0.5) << band << " in " << number;
      ++number;
    }
  }
}

TEST(ImageSensor, BrightnessAndColoursHaveNoiseOfTheirOwn) {
  constexpr std::size_t kPixels = std::size_t{kPictureWidth} * kPictureHeight;
  YCrCbImage picture;
  YCrCbImage noisier;  // and as bright
  CameraSettings settings;
  for (YCrCbImage* const taken : {&picture, &noisier}) {
    ImageSensor(1).expose(LightImage(kPixels, Color::Constant(0.3)), DetailImage(kPixels), settings, 1, taken);
    settings.gain = ocamparamGAIN_HIGH;
    settings.shutter = ocamparamSHUTTER_FAST;
  }
  const auto covariance = [](const YCrCbImage::Plane& one, const YCrCbImage::Plane& other) {
    double sum = 0;
    double sum_of_one = 0;
    double sum_of_other = 0;
    for (std::size_t i = 0; i < kPixels; ++i) {
      sum += one[i] * other[i];
      sum_of_one += one[i];
      sum_of_other += other[i];
    }
    return sum / kPixels - sum_of_one / kPixels * sum_of_other / kPixels;
  };
  const std::vector<const YCrCbImage::Plane*> planes = {&picture.y,    &picture.cr,   &picture.cb,
                                                        &picture.y_lh, &picture.y_hl, &picture.y_hh};
  for (const auto plane : {&YCrCbImage::y, &YCrCbImage::cr, &YCrCbImage::cb, &YCrCbImage::y_hh}) {
    EXPECT_GT(covariance(noisier.*plane, noisier.*plane), 3 * covariance(picture.*plane, picture.*plane));
  }
  for (const YCrCbImage::Plane* one : planes) {
    EXPECT_GT(covariance(*one, *one), 0.1);
    for (const YCrCbImage::Plane* other : planes) {
      if (one != other) {
        EXPECT_LT(std::abs(covariance(*one, *other)), 0.1 * covariance(*one, *one));
      }
    }
  }
}

TEST(Lens, BlursAPointEvenlyAlsoAtTheEdges) {
  Lens lens;
  const LightImage even = lens.project(LightImage(std::size_t{kPictureWidth} * kPictureHeight, Color::Ones()));
  const auto pixel = [](int x, int y) { return static_cast<std::size_t>(y * kPictureWidth + x); };
  EXPECT_GT(even[pixel(104, 80)][0], 1.1 * even[pixel(0, 0)][0]) << "the corners are darker";
  for (const int x : {0, 1, 100, kPictureWidth - 2, kPictureWidth - 1}) {
    for (const int y : {0, 1, 50, kPictureHeight - 2, kPictureHeight - 1}) {
      EXPECT_NEAR(even[pixel(x, y)][0], even[pixel(kPictureWidth - 1 - x, kPictureHeight - 1 - y)][0], 1e-6);
      LightImage point(even.size(), Color::Zero());
      point[pixel(x, y)] = Color::Ones();
      const LightImage& seen = lens.project(point);
      double sum = 0;
      for (std::size_t i = 0; i < seen.size(); ++i) {
        sum += seen[i][1] / even[i][1];
      }
      EXPECT_NEAR(sum, 1, 1e-6) << "no light is lost at " << x << " " << y;
      if (x > 0 && x < kPictureWidth - 1 && y > 0 && y < kPictureHeight - 1) {
        const auto at = [&](int i, int j) { return seen[pixel(x + i, y + j)][1] / even[pixel(x + i, y + j)][1]; };
        EXPECT_NEAR(at(-1, 0), at(1, 0), 1e-6);
        EXPECT_NEAR(at(0, -1), at(1, 0), 1e-6);
        EXPECT_NEAR(at(0, 1), at(1, 0), 1e-6);
        EXPECT_GT(at(0, 0), 2 * at(1, 0));
        EXPECT_GT(at(1, 0), at(1, 1));
      }
    }
  }
}

}  // namespace
}  // namespace simulated_ers7
