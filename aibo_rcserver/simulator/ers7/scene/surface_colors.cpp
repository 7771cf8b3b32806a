#include "simulator/ers7/scene/light.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "simulator/ers7/scene/scene.h"

namespace simulated_ers7 {
namespace {

const Color kCarpetGreen(0.075, 0.235, 0.085);
const Color kLineWhite(0.80, 0.80, 0.76);
const Color kOak(0.42, 0.25, 0.125);
const Color kWallCream(0.62, 0.555, 0.45);
const Color kPaintWhite(0.74, 0.73, 0.70);
const Color kDoorBlue(0.16, 0.25, 0.36);
const Color kPosterSand(0.72, 0.42, 0.16);
const Color kPosterTeal(0.10, 0.36, 0.38);
const Color kWindowSky(1.9, 2.2, 2.6);  // emits light
const Color kCeilingWhite(0.75, 0.75, 0.75);
const Color kBallPink(0.80, 0.085, 0.24);
const Color kBonePink(0.78, 0.14, 0.26);
const Color kStationWhite(0.66, 0.67, 0.70);
const Color kStationGrey(0.055, 0.06, 0.07);
const Color kPoleBlue(0.03, 0.16, 0.50);
const Color kPolePink(0.75, 0.10, 0.28);
const Color kCubeBlue(0.045, 0.16, 0.48);
const Color kCubeYellow(0.80, 0.52, 0.05);
const Color kBeech(0.60, 0.42, 0.24);

Color mix(const Color& from, const Color& to, double share) {
  return from + share * (to - from);
}

/// A pixel's extent along one axis.
struct Span {
  double low;
  double high;
  double per_width;

  Span(double middle, double width) : low(middle - width / 2), high(middle + width / 2), per_width(1 / width) {}

  double middle() const { return (low + high) / 2; }
  double width() const { return high - low; }
};

/// Rounds down, because std::floor() is slow on processors without SSE 4.1.
int64_t wholeBelow(double value) {
  const auto whole = static_cast<int64_t>(value);
  return whole - (static_cast<double>(whole) > value ? 1 : 0);
}

/// The share of the span between two positions.
double coverage(const Span& span, double low, double high) {
  const double overlap = std::min(span.high, high) - std::max(span.low, low);
  return overlap > 0 ? overlap * span.per_width : 0;
}

/// The share of the span in bands of this period and thickness.
double repeatedCoverage(const Span& span, double period, double thickness) {
  if (span.width() >= period) {
    return thickness / period;
  }
  const double band = period * static_cast<double>(wholeBelow(span.low / period));
  return coverage(span, band, band + thickness) + coverage(span, band + period, band + period + thickness);
}

/// A square of pseudo-random numbers in 0..1. The square is so large that its repetition is not visible, but small
/// enough for the processor's cache.
constexpr std::size_t kGridSize = 128;

std::vector<float> makeGrid() {
  std::vector<float> grid;
  for (uint64_t i = 0; i < kGridSize * kGridSize; ++i) {
    uint64_t mixed = i % kGridSize * 0x9E3779B97F4A7C15u ^ i / kGridSize * 0xC2B2AE3D27D4EB4Fu;
    mixed = (mixed ^ (mixed >> 29)) * 0xBF58476D1CE4E5B9u;
    grid.push_back(static_cast<float>(mixed >> 40) / static_cast<float>(1u << 24));
  }
  return grid;
}

const std::vector<float> kGrid = makeGrid();

/// The value of a cell of the grid, which repeats in all directions.
double cellValue(int64_t x, int64_t y) {
  return kGrid[static_cast<std::size_t>(y) % kGridSize * kGridSize + static_cast<std::size_t>(x) % kGridSize];
}

/// Noise between -1 and 1 with mean 0 and bumps of size 1.
double smoothNoise(double x, double y) {
  const int64_t column = wholeBelow(x);
  const int64_t row = wholeBelow(y);
  const double in_x = x - static_cast<double>(column);
  const double in_y = y - static_cast<double>(row);
  const double share_x = in_x * in_x * (3 - 2 * in_x);
  const double share_y = in_y * in_y * (3 - 2 * in_y);
  const double upper = cellValue(column, row) * (1 - share_x) + cellValue(column + 1, row) * share_x;
  const double lower = cellValue(column, row + 1) * (1 - share_x) + cellValue(column + 1, row + 1) * share_x;
  return 2 * (upper * (1 - share_y) + lower * share_y) - 1;
}

/// Visibility of a texture with bumps of `size` in a pixel of `width`.
double visibility(double size, double width) {
  return std::clamp(1.5 * size / width - 0.5, 0.0, 1.0);
}

/// Noise of this strength and size of bumps in a pixel of `width`.
double texture(double strength, double size, double width, double x, double y) {
  const double visible = visibility(size, width);
  return visible > 0 ? strength * visible * smoothNoise(x, y) : 0;
}

/// The share of the pixel under a rectangle's outline.
double outline(const Span& x, const Span& y, double half_length, double half_width) {
  const double beyond_ends = std::abs(x.middle()) - half_length;
  const double beyond_sides = std::abs(y.middle()) - half_width;
  if (std::max(beyond_ends + x.width() / 2, beyond_sides + y.width() / 2) < -kLineHalfWidth ||
      std::max(beyond_ends - x.width() / 2, beyond_sides - y.width() / 2) > kLineHalfWidth) {
    return 0;
  }
  const double outer = coverage(x, -half_length - kLineHalfWidth, half_length + kLineHalfWidth) *
                       coverage(y, -half_width - kLineHalfWidth, half_width + kLineHalfWidth);
  const double inner = coverage(x, -half_length + kLineHalfWidth, half_length - kLineHalfWidth) *
                       coverage(y, -half_width + kLineHalfWidth, half_width - kLineHalfWidth);
  return outer - inner;
}

/// The share of the pixel under the centre circle's line.
double circleLine(const Span& x, const Span& y) {
  const double radius = std::sqrt(x.middle() * x.middle() + y.middle() * y.middle());
  if (std::abs(radius - kCenterCircleRadius) > kLineHalfWidth + x.width() + y.width()) {
    return 0;
  }
  const double width = (std::abs(x.middle()) * x.width() + std::abs(y.middle()) * y.width()) / radius;
  return coverage({radius, width}, kCenterCircleRadius - kLineHalfWidth, kCenterCircleRadius + kLineHalfWidth);
}

/// The share of the pixel under white lines. x and y begin in the middle of the carpet.
double fieldLines(const Span& x, const Span& y) {
  constexpr double kHalfLength = kCarpetHalfLength - kLineInset;
  constexpr double kHalfWidth = kCarpetHalfWidth - kLineInset;
  const double border = outline(x, y, kHalfLength, kHalfWidth);
  const double halfway = coverage(x, -kLineHalfWidth, kLineHalfWidth) * coverage(y, -kHalfWidth, kHalfWidth);
  const Span from_penalty_area(std::abs(x.middle()) - kHalfLength + kPenaltyAreaDepth / 2, x.width());
  const double penalty_area = outline(from_penalty_area, y, kPenaltyAreaDepth / 2, kPenaltyAreaHalfWidth);
  return std::max(std::max(border, halfway), std::max(penalty_area, circleLine(x, y)));
}

Color carpet(const Span& x, const Span& y) {
  constexpr double kTuft = 0.005;
  constexpr double kPatch = 0.035;
  const double width = std::max(x.width(), y.width());
  const double pile = texture(0.06, kTuft, width, x.middle() / kTuft, y.middle() / kTuft) +
                      texture(0.09, kPatch, width, x.middle() / kPatch, y.middle() / kPatch);
  return mix(kCarpetGreen, kLineWhite, 0.94 * fieldLines(x, y)) * (1 + pile);
}

Color parquet(const Span& x, const Span& y) {
  constexpr double kPlankWidth = 0.10;
  constexpr double kPlankLength = 0.80;
  constexpr double kGap = 0.004;
  constexpr double kGrain = 0.012;
  const auto row = wholeBelow(y.middle() / kPlankWidth);
  const Span along(x.middle() + kPlankLength * cellValue(row, 0), x.width());
  const auto column = wholeBelow(along.middle() / kPlankLength);
  const double tone = 0.30 * visibility(kPlankWidth, y.width()) * (cellValue(row, column) - 0.5);
  const double grain = texture(0.13, kGrain, y.width(), along.middle() / (12 * kGrain), y.middle() / kGrain);
  const double gap = std::max(repeatedCoverage(y, kPlankWidth, kGap), repeatedCoverage(along, kPlankLength, kGap));
  return kOak * ((1 + tone + grain) * (1 - 0.6 * gap));
}

Appearance floorAppearance(const SceneHit& hit, const Eigen::Vector3d& footprint) {
  const Span x(hit.point.x() - kCarpetX, footprint.x());
  const Span y(hit.point.y(), footprint.y());
  const double on_carpet =
      coverage(x, -kCarpetHalfLength, kCarpetHalfLength) * coverage(y, -kCarpetHalfWidth, kCarpetHalfWidth);
  if (on_carpet == 0) {
    return {parquet(x, y)};
  }
  if (on_carpet > 1 - 1e-9) {
    return {carpet(x, y)};
  }
  return {mix(parquet(x, y), carpet(x, y), on_carpet)};
}

/// A framed rectangle on a wall.
struct Panel {
  Eigen::Vector3d wall_normal;
  double left;  ///< along the wall, in the room's x or y
  double right;
  double bottom;
  double top;
  double frame_width;
  Color frame;
  Color filling;
};

const Panel kPanels[] = {
    {{-1, 0, 0}, -1.30, -0.50, 0.01, 2.00, 0.07, kPaintWhite, kDoorBlue},
    {{-1, 0, 0}, 0.10, 0.90, 0.42, 0.98, 0.03, kOak, kPosterSand},
    {{0, -1, 0}, 0.40, 1.90, 0.75, 2.00, 0.06, kPaintWhite, kWindowSky},
    {{0, 1, 0}, 0.60, 1.30, 0.60, 1.10, 0.03, kOak, kPosterTeal},
};

Color wallPanels(const SceneHit& hit, const Color& wall, const Span& along, const Span& z) {
  Color color = wall;
  for (const Panel& panel : kPanels) {
    if (panel.wall_normal == hit.normal) {
      const double outer = coverage(along, panel.left - panel.frame_width, panel.right + panel.frame_width) *
                           coverage(z, panel.bottom - panel.frame_width, panel.top + panel.frame_width);
      const double inner = coverage(along, panel.left, panel.right) * coverage(z, panel.bottom, panel.top);
      color = mix(mix(color, panel.frame, outer), panel.filling, inner);
    }
  }
  return color;
}

/// Cream walls with a white skirting board, a door, a window and two pictures.
Appearance wallAppearance(const SceneHit& hit, const Eigen::Vector3d& footprint) {
  constexpr double kSkirtingHeight = 0.08;
  constexpr double kGroove = 0.012;
  const int axis = hit.normal.x() != 0 ? 1 : 0;
  const Span along(hit.point[axis], footprint[axis]);
  const Span z(hit.point.z(), footprint.z());
  Color color = mix(kWallCream, kPaintWhite, coverage(z, 0, kSkirtingHeight));
  color = mix(color, 0.5 * kWallCream, coverage(z, kSkirtingHeight, kSkirtingHeight + kGroove));
  return {wallPanels(hit, color, along, z)};
}

Appearance poleAppearance(const SceneHit& hit, const Eigen::Vector3d& footprint) {
  const Span z(hit.local_point.z(), footprint.z());
  const double blue = coverage(z, -0.035, 0.020);
  const double pink = coverage(z, 0.045, 0.100);
  return {mix(mix(kStationWhite, kPoleBlue, blue), kPolePink, pink), 0.3};
}

}  // namespace

Appearance appearanceOf(const SceneHit& hit, const Eigen::Vector3d& footprint) {
  switch (hit.surface) {
    case Surface::kFloor:
      return floorAppearance(hit, footprint);
    case Surface::kWall:
      return wallAppearance(hit, footprint);
    case Surface::kCeiling:
      return {kCeilingWhite};
    case Surface::kBall:
      return {kBallPink, 0.55};
    case Surface::kBone:
      return {kBonePink, 0.45};
    case Surface::kStation:
      return {kStationWhite, 0.3};
    case Surface::kStationDock:
      return {kStationGrey, 0.4};
    case Surface::kStationPole:
      return poleAppearance(hit, footprint);
    case Surface::kBlueCube:
      return {kCubeBlue, 0.2};
    case Surface::kYellowCube:
      return {kCubeYellow, 0.2};
    case Surface::kWood:
      return {kBeech, 0.15};
  }
  return {Color::Zero()};
}

}  // namespace simulated_ers7
