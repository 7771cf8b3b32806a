#include "tools/color_table_maker.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "aibo_client/exceptions.h"

namespace aibo_driver::color_table {

using aibo_client::ColorTable;

namespace {

constexpr int kYPerSegment = 256 / aibo_client::kColorSegments;
constexpr int kFewestPixels = 16;
constexpr double kOutliers = 0.01;  // the part of the values that is left out at each end

// The values are those of JPEG files (ITU-R BT.601, full range), because JPEGs contain what the camera measured.
struct Pixel {
  int y;
  int cr;
  int cb;
};

int toByte(double value) {
  return static_cast<int>(std::clamp(std::lround(value), 0L, 255L));
}

Pixel pixelAt(const camera::BgrImage& picture, int x, int y) {
  const std::uint8_t* bgr = &picture.pixels[3 * static_cast<std::size_t>(y * picture.width + x)];
  const double luminance = 0.299 * bgr[2] + 0.587 * bgr[1] + 0.114 * bgr[0];
  return {toByte(luminance), toByte(128 + 0.713267 * (bgr[2] - luminance)),
          toByte(128 + 0.564334 * (bgr[0] - luminance))};
}

struct Range {
  int lowest;
  int highest;
};

Range rangeOf(std::vector<int> values, int margin) {
  std::sort(values.begin(), values.end());
  const auto outliers = static_cast<std::size_t>(kOutliers * static_cast<double>(values.size()));
  return {std::max(0, values[outliers] - margin), std::min(255, values[values.size() - 1 - outliers] + margin)};
}

void checkRegion(const camera::BgrImage& picture, const Region& region) {
  const bool is_within = region.left >= 0 && region.top >= 0 && region.width >= 1 && region.height >= 1 &&
                         region.left <= picture.width - region.width && region.top <= picture.height - region.height;
  if (!is_within) {
    throw aibo_client::InvalidArgumentException(
        "the region " + std::to_string(region.left) + "," + std::to_string(region.top) + "," +
        std::to_string(region.width) + "," + std::to_string(region.height) + " is not within the picture, which has " +
        std::to_string(picture.width) + "x" + std::to_string(picture.height) + " pixels");
  }
  if (region.width * region.height < kFewestPixels) {
    throw aibo_client::InvalidArgumentException("the region has " + std::to_string(region.width * region.height) +
                                                " pixels; it must have at least " + std::to_string(kFewestPixels));
  }
}

bool isIn(const ColorTable& table, const Pixel& pixel) {
  const std::optional<aibo_client::ColorRange>& range =
      table.segments.at(static_cast<std::size_t>(pixel.y / kYPerSegment));
  return range && range->cr_min <= pixel.cr && pixel.cr <= range->cr_max && range->cb_min <= pixel.cb &&
         pixel.cb <= range->cb_max;
}

}  // namespace

ColorTable makeTable(const camera::BgrImage& picture, const Region& region, const std::string& name, int margin) {
  checkRegion(picture, region);
  std::vector<int> luminances;
  std::vector<int> reds;
  std::vector<int> blues;
  for (int y = region.top; y < region.top + region.height; ++y) {
    for (int x = region.left; x < region.left + region.width; ++x) {
      const Pixel pixel = pixelAt(picture, x, y);
      luminances.push_back(pixel.y);
      reds.push_back(pixel.cr);
      blues.push_back(pixel.cb);
    }
  }
  const Range luminance = rangeOf(std::move(luminances), kYPerSegment);
  const Range red = rangeOf(std::move(reds), margin);
  const Range blue = rangeOf(std::move(blues), margin);
  ColorTable table;
  table.name = name;
  for (int segment = luminance.lowest / kYPerSegment; segment <= luminance.highest / kYPerSegment; ++segment) {
    table.segments.at(static_cast<std::size_t>(segment)) =
        aibo_client::ColorRange{red.lowest, red.highest, blue.lowest, blue.highest};
  }
  return table;
}

Coverage coverageOf(const ColorTable& table, const camera::BgrImage& picture, const Region& region) {
  double inside = 0;
  double outside = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      if (isIn(table, pixelAt(picture, x, y))) {
        ++(region.contains(x, y) ? inside : outside);
      }
    }
  }
  const double region_size = region.width * region.height;
  const double rest = picture.width * picture.height - region_size;
  return {inside / region_size, rest > 0 ? outside / rest : 0};
}

}  // namespace aibo_driver::color_table
