#include "simulator/ers7/camera/renderer.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "simulator/ers7/camera/camera_optics.h"
#include "simulator/ers7/scene/light.h"

namespace simulated_ers7 {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

size_t indexOf(int x, int y) {
  return static_cast<size_t>(y) * kPictureWidth + static_cast<size_t>(x);
}

Ray rayThrough(const Eigen::Isometry3d& camera, const Vector2d& place) {
  return {camera.translation(), camera.linear() * directionOf(place)};
}

/// The size of a pixel on the surface along each axis: its width across the ray, stretched where the surface is seen at
/// a slant.
/// @param pixel_size 1, or less for a part of a pixel
Vector3d footprintOf(const SceneHit& hit, const Vector3d& direction, double pixel_size) {
  constexpr double kFlattestSlant = 0.02;
  const double width = hit.distance * pixel_size / focalLengthX();
  const double slant = direction.dot(hit.normal);
  const Vector3d along_surface = (direction - slant * hit.normal).cwiseAbs();
  return Vector3d::Constant(width) + width * (1 / std::max(std::abs(slant), kFlattestSlant) - 1) * along_surface;
}

Color lightAlong(const Scene& scene, const Ray& ray, const SceneHit& hit, double pixel_size) {
  return lightFrom(scene, hit, appearanceOf(hit, footprintOf(hit, ray.direction, pixel_size)), ray.direction);
}

float luminanceOf(const Color& light) {
  return static_cast<float>(0.299 * light[0] + 0.587 * light[1] + 0.114 * light[2]);
}

/// @param parts upper left, upper right, lower left, lower right
FineDetail relativeDetail(const Color* parts) {
  float luminance[4];
  std::transform(parts, parts + 4, luminance, luminanceOf);
  const float mean = (luminance[0] + luminance[1] + luminance[2] + luminance[3]) / 4;
  const FineDetail detail = fineDetailOf(luminance[0], luminance[1], luminance[2], luminance[3]);
  return mean > 0 ? FineDetail{detail.lh / mean, detail.hl / mean, detail.hh / mean} : FineDetail{};
}

}  // namespace

Renderer::Renderer(const Scene& scene)
    : scene_(scene),
      picture_(static_cast<size_t>(kPictureWidth * kPictureHeight)),
      detail_(static_cast<size_t>(kPictureWidth * kPictureHeight), FineDetail{}),
      seen_(static_cast<size_t>(kPictureWidth * kPictureHeight)),
      drawn_positions_(scene.bodies().size()) {}

const LightImage& Renderer::render(const Eigen::Isometry3d& camera) {
  if (!drawn_from_ || drawn_from_->matrix() != camera.matrix()) {
    drawn_from_ = camera;
    draw(camera, {0, 0, kPictureWidth, kPictureHeight});
  } else {
    for (size_t i = 0; i < drawn_positions_.size(); ++i) {
      const Body& body = scene_.bodies()[i];
      if (body.position() != drawn_positions_[i]) {
        const double radius = lightReach(body);
        draw(camera,
             united(windowAround(camera, drawn_positions_[i], radius), windowAround(camera, body.position(), radius)));
      }
    }
  }
  std::transform(scene_.bodies().begin(), scene_.bodies().end(), drawn_positions_.begin(),
                 [](const Body& body) { return body.position(); });
  return picture_;
}

void Renderer::draw(const Eigen::Isometry3d& camera, const Window& window) {
  for (int y = window.top; y < window.bottom; ++y) {
    for (int x = window.left; x < window.right; ++x) {
      const Ray ray = rayThrough(camera, {x + 0.5, y + 0.5});
      const SceneHit hit = scene_.castRay(ray);
      seen_[indexOf(x, y)] = {hit.surface, hit.normal};
      picture_[indexOf(x, y)] = lightAlong(scene_, ray, hit, 1);
    }
  }
  smoothEdges(camera, window);
}

void Renderer::smoothEdges(const Eigen::Isometry3d& camera, const Window& window) {
  constexpr double kPart = 0.5;
  constexpr double kMiddles[] = {0.25, 0.75};
  for (int y = window.top; y < window.bottom; ++y) {
    for (int x = window.left; x < window.right; ++x) {
      detail_[indexOf(x, y)] = {};
      if (!isEdge(x, y)) {
        continue;
      }
      Color parts[4];
      Color* part = parts;
      for (const double down : kMiddles) {
        for (const double across : kMiddles) {
          const Ray ray = rayThrough(camera, {x + across, y + down});
          *part++ = lightAlong(scene_, ray, scene_.castRay(ray), kPart);
        }
      }
      picture_[indexOf(x, y)] = (parts[0] + parts[1] + parts[2] + parts[3]) * kPart * kPart;
      detail_[indexOf(x, y)] = relativeDetail(parts);
    }
  }
}

bool Renderer::isEdge(int x, int y) const {
  constexpr double kSameFace = 0.8;  // cosine between normals
  const Seen& here = seen_[indexOf(x, y)];
  const auto differs = [&here](const Seen& there) {
    return here.surface != there.surface || here.normal.dot(there.normal) < kSameFace;
  };
  return (x > 0 && differs(seen_[indexOf(x - 1, y)])) || (x + 1 < kPictureWidth && differs(seen_[indexOf(x + 1, y)])) ||
         (y > 0 && differs(seen_[indexOf(x, y - 1)])) || (y + 1 < kPictureHeight && differs(seen_[indexOf(x, y + 1)]));
}

/// The pixels that may show a part of a ball, or of something inside it.
Renderer::Window Renderer::windowAround(const Eigen::Isometry3d& camera, const Vector3d& center, double radius) {
  constexpr int kMargin = 2;  // pixels; smoothed edges reach a pixel beyond the object
  const Vector3d seen_center = camera.inverse() * center;
  if (seen_center.x() <= radius) {
    return {0, 0, kPictureWidth, kPictureHeight};
  }
  Vector2d low = Vector2d::Constant(std::numeric_limits<double>::infinity());
  Vector2d high = -low;
  for (const double ahead : {-radius, radius}) {
    for (const double side : {-radius, radius}) {
      const Vector2d corner = placeOf(seen_center + Vector3d(ahead, side, side));
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
    }
  }
  low = low.cwiseMax(0).cwiseMin(Vector2d(kPictureWidth, kPictureHeight));
  high = high.cwiseMax(0).cwiseMin(Vector2d(kPictureWidth, kPictureHeight));
  return clipped({static_cast<int>(low.x()) - kMargin, static_cast<int>(low.y()) - kMargin,
                  static_cast<int>(high.x()) + 1 + kMargin, static_cast<int>(high.y()) + 1 + kMargin});
}

Renderer::Window Renderer::united(const Window& one, const Window& other) {
  return {std::min(one.left, other.left), std::min(one.top, other.top), std::max(one.right, other.right),
          std::max(one.bottom, other.bottom)};
}

Renderer::Window Renderer::clipped(const Window& window) {
  return {std::max(window.left, 0), std::max(window.top, 0), std::min(window.right, kPictureWidth),
          std::min(window.bottom, kPictureHeight)};
}

}  // namespace simulated_ers7
