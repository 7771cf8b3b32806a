#include "tools/color_table_maker.h"

#include <gmock/gmock.h>

#include <array>
#include <cmath>
#include <optional>

#include "aibo_client/exceptions.h"
#include "support/refusal.h"

namespace aibo_driver::color_table {
namespace {

// The part of the picture with the color, and the means of its color.
constexpr Region kRegion{31, 12, 20, 15};
constexpr int kY = 150;
constexpr int kCr = 170;
constexpr int kCb = 100;

void paint(camera::BgrImage* picture, int x, int y, double luminance, double cr, double cb) {
  const double red = luminance + (cr - 128) / 0.713267;
  const double blue = luminance + (cb - 128) / 0.564334;
  const double green = (luminance - 0.299 * red - 0.114 * blue) / 0.587;
  std::uint8_t* bgr = &picture->pixels[3 * static_cast<std::size_t>(y * picture->width + x)];
  for (const double value : {blue, green, red}) {
    *bgr++ = static_cast<std::uint8_t>(std::lround(value));
  }
}

// What surrounds a color differs from it in only one value each, which is too low or too high.
void paintOther(camera::BgrImage* picture, int x, int y, int kind) {
  const int more = kind % 2 == 0 ? -40 : 40;
  paint(picture, x, y, kY + (kind / 2 == 0 ? more : 0), kCr + (kind / 2 == 1 ? more : 0),
        kCb + (kind / 2 == 2 ? more : 0));
}

// Cr grows to the right, and Cb downward.
camera::BgrImage pinkSquare() {
  camera::BgrImage picture{104, 80, std::vector<std::uint8_t>(3 * 104 * 80)};
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      if (kRegion.contains(x, y)) {
        paint(&picture, x, y, kY, kCr + (x - kRegion.left - 10) / 2, kCb + y - kRegion.top - 7);
      } else {
        paintOther(&picture, x, y, (x + y) % 6);
      }
    }
  }
  return picture;
}

std::string refusalOf(const Region& region) {
  return test_support::refusalOf<aibo_client::InvalidArgumentException>(
      [&] { makeTable(pinkSquare(), region, "a", 6); });
}

TEST(TableMaker, TheTableHasTheColorsOfTheRegionAndNoOthers) {
  const aibo_client::ColorTable table = makeTable(pinkSquare(), kRegion, "pink", 3);
  EXPECT_EQ(table.name, "pink");
  const Coverage coverage = coverageOf(table, pinkSquare(), kRegion);
  EXPECT_EQ(coverage.inside, 1);
  EXPECT_EQ(coverage.outside, 0);
  const Coverage of_a_part = coverageOf(table, pinkSquare(), {31, 12, 20, 9});
  EXPECT_EQ(of_a_part.inside, 1);
  EXPECT_NEAR(of_a_part.outside, 120.0 / (104 * 80 - 180), 1e-9);
  for (std::size_t segment = 0; segment < table.segments.size(); ++segment) {
    const bool is_of_it = segment >= 17 && segment <= 19;  // Y is about 150, and each has 8 values of it
    EXPECT_EQ(table.segments[segment],
              is_of_it ? std::optional<aibo_client::ColorRange>({kCr - 5 - 3, kCr + 4 + 3, kCb - 7 - 3, kCb + 7 + 3})
                       : std::nullopt)
        << segment;
  }
}

TEST(TableMaker, BlackWhiteAndFullColorsHaveTablesToo) {
  const Region all{0, 0, 4, 4};
  for (const std::array<std::uint8_t, 3>& bgr :
       {std::array<std::uint8_t, 3>{0, 0, 0}, {255, 255, 255}, {255, 0, 0}, {0, 0, 255}}) {
    camera::BgrImage picture{4, 4, {}};
    for (int i = 0; i < 16; ++i) {
      picture.pixels.insert(picture.pixels.end(), bgr.begin(), bgr.end());
    }
    const aibo_client::ColorTable table = makeTable(picture, all, "full", 127);
    for (const auto& range : table.segments) {
      EXPECT_TRUE(!range || (range->cr_min >= 0 && range->cr_max <= 255 && range->cb_min >= 0 && range->cb_max <= 255));
    }
    const Coverage coverage = coverageOf(makeTable(picture, all, "exact", 0), picture, all);
    EXPECT_EQ(coverage.inside, 1);
    EXPECT_EQ(coverage.outside, 0) << "there is nothing else";
  }
}

TEST(TableMaker, SaysWhatIsWrongWithARegion) {
  EXPECT_EQ(refusalOf({85, 12, 20, 15}), "the region 85,12,20,15 is not within the picture, which has 104x80 pixels");
  for (const Region& region : {Region{31, 66, 20, 15}, Region{-1, 12, 20, 15}, Region{31, -1, 20, 15},
                               Region{0, 0, 2147483647, 15}, Region{0, 0, 20, 2147483647}}) {
    EXPECT_THAT(refusalOf(region), testing::HasSubstr("not within")) << region.left << "," << region.top;
  }
  EXPECT_EQ(refusalOf({31, 12, 3, 5}), "the region has 15 pixels; it must have at least 16");
}

}  // namespace
}  // namespace aibo_driver::color_table
