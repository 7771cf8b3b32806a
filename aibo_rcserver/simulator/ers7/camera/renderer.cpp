#include "simulator/ers7/camera/renderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "simulator/ers7/scene/light.h"

namespace simulated_ers7 {
namespace {

using Eigen::Vector3d;

size_t indexOf(int x, int y) {
  return static_cast<size_t>(y) * kPictureWidth + static_cast<size_t>(x);
}

/// A pixel's size on the surface along each axis: its width across the ray, stretched where the surface is slanted.
/// @param pixel_size less than 1 for a part of a pixel
Vector3d footprintOf(const SceneHit& hit, const Vector3d& direction, double pixel_size) {
  constexpr double kFlattestSlant = 0.02;
  const double width = hit.distance * pixel_size / kFocalLengthX;
  const double slant = direction.dot(hit.normal);
  const Vector3d along_surface = (direction - slant * hit.normal).cwiseAbs();
  return Vector3d::Constant(width) + width * (1 / std::max(std::abs(slant), kFlattestSlant) - 1) * along_surface;
}

Color lightAlong(const Ray& ray, const SceneHit& hit, const Illumination& illumination, double pixel_size) {
  return lightFrom(hit, appearanceOf(hit, footprintOf(hit, ray.direction, pixel_size)), illumination, ray.direction);
}

bool isOfRoom(Surface surface) {
  return surface == Surface::kFloor || surface == Surface::kWall || surface == Surface::kCeiling;
}

/// The size of a block in pixels. The picture consists of whole blocks.
constexpr int kBlock = 4;

static_assert(kPictureWidth % kBlock == 0 && kPictureHeight % kBlock == 0, "see above");

template <typename Value>
using Block = std::array<Value, static_cast<size_t>(kBlock* kBlock)>;

constexpr size_t kBlockCorners[] = {0, kBlock - 1, kBlock*(kBlock - 1), kBlock* kBlock - 1};

/// True if all hits show the same plane.
template <std::size_t kSize>
bool isFlat(const std::array<SceneHit, kSize>& hits) {
  return isOfRoom(hits[0].surface) && std::all_of(hits.begin(), hits.end(), [&](const SceneHit& hit) {
           return hit.surface == hits[0].surface && hit.normal == hits[0].normal;
         });
}

/// The mean of the values at the block's corners, for one pixel.
Illumination meanOfCorners(const Block<Illumination>& light, size_t pixel) {
  const auto mean = [](const Illumination& from, const Illumination& to, double share) {
    return Illumination{from.lamp + share * (to.lamp - from.lamp),
                        from.openness + share * (to.openness - from.openness)};
  };
  const double across = static_cast<double>(pixel % kBlock) / (kBlock - 1);
  const double down = static_cast<double>(pixel / kBlock) / (kBlock - 1);
  return mean(mean(light[kBlockCorners[0]], light[kBlockCorners[1]], across),
              mean(light[kBlockCorners[2]], light[kBlockCorners[3]], across), down);
}

/// True if the difference between two illuminations is invisible.
bool lookTheSame(const Illumination& one, const Illumination& other) {
  constexpr double kVisible = 0.015;
  return std::abs(one.lamp - other.lamp) < kVisible && std::abs(one.openness - other.openness) < kVisible;
}

/// Calculates the light at the corners of a block and at one point between them. If the light at this point is the mean
/// of the corners, all other pixels are interpolated. If not, they are calculated.
/// @param is_flat true: the block shows a single plane
template <typename Calculate>
void illuminate(bool is_flat, const Calculate& calculate, Block<Illumination>* light) {
  constexpr size_t kBetween = kBlock + 1;
  bool is_even = false;
  if (is_flat) {
    for (const size_t corner : kBlockCorners) {
      (*light)[corner] = calculate(corner);
    }
    is_even = lookTheSame(calculate(kBetween), meanOfCorners(*light, kBetween));
  }
  for (size_t i = 0; i < light->size(); ++i) {
    (*light)[i] = is_even ? meanOfCorners(*light, i) : calculate(i);
  }
}

/// The range of pixels in which a ball may appear along an axis of the picture, between the tangents from the camera.
/// @param ahead,aside the ball's centre; aside is positive in the direction of the axis
std::pair<double, double> extentOf(double ahead, double aside, double radius, double focal_length, double size) {
  const double distance = std::hypot(ahead, aside);
  if (distance <= radius) {
    return {0, size};
  }
  const double direction = std::atan2(aside, ahead);
  const double half = std::asin(radius / distance);
  const auto place = [=](double angle) {
    constexpr double kBeside = 1.5;  // radians, far beyond the picture
    return std::clamp(size / 2 + focal_length * std::tan(std::clamp(angle, -kBeside, kBeside)), 0.0, size);
  };
  return {place(direction - half), place(direction + half)};
}

float luminanceOf(const Color& light) {
  return static_cast<float>(0.299 * light[0] + 0.587 * light[1] + 0.114 * light[2]);
}

/// @param parts the result of Renderer::lightOfParts()
FineDetail relativeDetail(const std::array<Color, 4>& parts) {
  float luminance[4];
  std::transform(parts.begin(), parts.end(), luminance, luminanceOf);
  const float mean = (luminance[0] + luminance[1] + luminance[2] + luminance[3]) / 4;
  const FineDetail detail = fineDetailOf(luminance[0], luminance[1], luminance[2], luminance[3]);
  return mean > 0 ? FineDetail{detail.lh / mean, detail.hl / mean, detail.hh / mean} : FineDetail{};
}

}  // namespace

/// A camera that casts rays.
class Renderer::Eye {
 public:
  explicit Eye(const Eigen::Isometry3d& camera)
      : place_(camera.translation()),
        ahead_(camera.linear().col(0)),
        left_(camera.linear().col(1) / kFocalLengthX),
        up_(camera.linear().col(2) / kFocalLengthY) {}

  /// @param x,y a place in the picture (ycrcb_image.h)
  Ray rayThrough(double x, double y) const {
    const Vector3d direction = ahead_ + (kPictureWidth / 2.0 - x) * left_ + (kPictureHeight / 2.0 - y) * up_;
    return {place_, direction * (1 / direction.norm())};
  }

 private:
  Vector3d place_;
  Vector3d ahead_;
  Vector3d left_;  // from a pixel to the next
  Vector3d up_;
};

Renderer::Renderer(const Scene& scene)
    : scene_(scene),
      picture_(static_cast<size_t>(kPictureWidth * kPictureHeight)),
      detail_(static_cast<size_t>(kPictureWidth * kPictureHeight), FineDetail{}),
      seen_(static_cast<size_t>(kPictureWidth * kPictureHeight)),
      is_edge_(seen_.size()),
      near_(static_cast<size_t>(kPictureWidth * kPictureHeight)),
      drawn_positions_(scene.bodies().size()) {}

const LightImage& Renderer::render(const Eigen::Isometry3d& camera) {
  const bool everything_moved = !drawn_from_ || drawn_from_->matrix() != camera.matrix();
  drawn_from_ = camera;
  findBodies(camera);
  if (everything_moved) {
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

void Renderer::findBodies(const Eigen::Isometry3d& camera) {
  std::fill(near_.begin(), near_.end(), Near{});
  for (size_t i = 0; i < scene_.bodies().size(); ++i) {
    const Body& body = scene_.bodies()[i];
    const auto bit = static_cast<BodySet>(1u << i);
    const auto mark = [&](double radius, BodySet Near::*set) {
      const Window window = windowAround(camera, body.position(), radius);
      for (int y = window.top; y < window.bottom; ++y) {
        for (int x = window.left; x < window.right; ++x) {
          near_[indexOf(x, y)].*set |= bit;
        }
      }
    };
    mark(body.reach(), &Near::visible);
    mark(lightReach(body), &Near::changing_light);
  }
}

void Renderer::draw(const Eigen::Isometry3d& camera, const Window& window) {
  const Eye eye(camera);
  for (int y = window.top; y < window.bottom; y += kBlock) {
    for (int x = window.left; x < window.right; x += kBlock) {
      drawBlock(eye, x, y);
    }
  }
  smoothEdges(eye, window);
}

void Renderer::drawBlock(const Eye& eye, int left, int top) {
  Block<Ray> rays;
  Block<SceneHit> hits;
  Block<Illumination> light;
  const auto pixelOf = [left, top](size_t i) {
    return indexOf(left + static_cast<int>(i) % kBlock, top + static_cast<int>(i) / kBlock);
  };
  BodySet visible = 0;
  for (size_t i = 0; i < rays.size(); ++i) {
    rays[i] = eye.rayThrough(left + static_cast<int>(i) % kBlock + 0.5, top + static_cast<int>(i) / kBlock + 0.5);
    visible |= near_[pixelOf(i)].visible;
  }
  std::array<SceneHit, std::size(kBlockCorners)> corners;
  std::transform(std::begin(kBlockCorners), std::end(kBlockCorners), corners.begin(),
                 [&](size_t corner) { return scene_.castRay(rays[corner], visible); });
  // A face that shows in all corners of a block fills the block, because a room's faces are convex.
  const bool is_flat = visible == 0 && isFlat(corners);
  for (size_t i = 0; i < rays.size(); ++i) {
    hits[i] = is_flat ? Scene::castRayAtPlane(rays[i], corners[0]) : scene_.castRay(rays[i], near_[pixelOf(i)].visible);
  }
  illuminate(
      is_flat || isFlat(hits),
      [&](size_t i) { return illuminationOf(scene_, hits[i], near_[pixelOf(i)].changing_light); }, &light);
  for (size_t i = 0; i < hits.size(); ++i) {
    seen_[pixelOf(i)] = {hits[i].surface, hits[i].normal, light[i]};
    picture_[pixelOf(i)] = lightAlong(rays[i], hits[i], light[i], 1);
  }
}

void Renderer::smoothEdges(const Eye& eye, const Window& window) {
  findEdges(window);
  for (int y = window.top; y < window.bottom; ++y) {
    for (int x = window.left; x < window.right; ++x) {
      detail_[indexOf(x, y)] = {};
      if (is_edge_[indexOf(x, y)]) {
        const std::array<Color, 4> parts = lightOfParts(eye, x, y);
        picture_[indexOf(x, y)] = (parts[0] + parts[1] + parts[2] + parts[3]) / 4;
        detail_[indexOf(x, y)] = relativeDetail(parts);
      }
    }
  }
}

/// The parts of a pixel: upper left, upper right, lower left, lower right. Parts with the same face share its
/// illumination.
std::array<Color, 4> Renderer::lightOfParts(const Eye& eye, int x, int y) const {
  constexpr double kPart = 0.5;
  constexpr double kMiddles[] = {0.25, 0.75};
  const Near& near = near_[indexOf(x, y)];
  // The face in the middle of the pixel, and the other face that was found last. At first both are the same.
  Seen faces[] = {seen_[indexOf(x, y)], seen_[indexOf(x, y)]};
  std::array<Color, 4> parts;
  Color* part = parts.data();
  for (const double down : kMiddles) {
    for (const double across : kMiddles) {
      const Ray ray = eye.rayThrough(x + across, y + down);
      const SceneHit hit = scene_.castRay(ray, near.visible);
      const bool is_middle = faces[0].isAlso(hit.surface, hit.normal);
      if (!is_middle && !faces[1].isAlso(hit.surface, hit.normal)) {
        faces[1] = {hit.surface, hit.normal, illuminationOf(scene_, hit, near.changing_light)};
      }
      *part++ = lightAlong(ray, hit, faces[is_middle ? 0 : 1].light, kPart);
    }
  }
  return parts;
}

/// Compares each pixel in the window with its neighbours, each pair once.
void Renderer::findEdges(const Window& window) {
  std::fill(is_edge_.begin(), is_edge_.end(), false);
  const auto compare = [this](size_t one, size_t other) {
    if (!seen_[one].isAlso(seen_[other].surface, seen_[other].normal)) {
      is_edge_[one] = is_edge_[other] = true;
    }
  };
  for (int y = std::max(window.top - 1, 0); y < window.bottom; ++y) {
    for (int x = std::max(window.left - 1, 0); x < window.right; ++x) {
      if (x + 1 < kPictureWidth) {
        compare(indexOf(x, y), indexOf(x + 1, y));
      }
      if (y + 1 < kPictureHeight) {
        compare(indexOf(x, y), indexOf(x, y + 1));
      }
    }
  }
}

/// The pixels that may show a ball, or something inside it.
Renderer::Window Renderer::windowAround(const Eigen::Isometry3d& camera, const Vector3d& center, double radius) {
  constexpr double kMargin = 2;  // pixels; smooth edges reach one pixel beyond the object
  const Vector3d seen = camera.inverse() * center;
  const auto [left, right] = extentOf(seen.x(), -seen.y(), radius, kFocalLengthX, kPictureWidth);
  const auto [top, bottom] = extentOf(seen.x(), -seen.z(), radius, kFocalLengthY, kPictureHeight);
  return wholeBlocks({static_cast<int>(left - kMargin), static_cast<int>(top - kMargin),
                      static_cast<int>(right + kMargin) + 1, static_cast<int>(bottom + kMargin) + 1});
}

Renderer::Window Renderer::united(const Window& one, const Window& other) {
  return {std::min(one.left, other.left), std::min(one.top, other.top), std::max(one.right, other.right),
          std::max(one.bottom, other.bottom)};
}

/// The blocks of the picture that the window touches.
Renderer::Window Renderer::wholeBlocks(const Window& window) {
  const auto down = [](int place) { return std::max(place, 0) / kBlock * kBlock; };
  const auto up = [](int place, int most) { return std::min((place + kBlock - 1) / kBlock * kBlock, most); };
  return {down(window.left), down(window.top), up(window.right, kPictureWidth), up(window.bottom, kPictureHeight)};
}

}  // namespace simulated_ers7
