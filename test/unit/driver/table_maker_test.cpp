#include "tools/color_table/table_maker.h"

#include <gmock/gmock.h>

#include <array>

#include "aibo_client/exceptions.h"

namespace aibo_driver::color_table {
namespace {

using ::testing::HasSubstr;

// A grey picture with a pink square, 20..39.
node::BgrImage pinkSquare() {
  node::BgrImage picture{104, 80, std::vector<std::uint8_t>(3 * 104 * 80, 128)};
  for (std::size_t y = 20; y < 40; ++y) {
    for (std::size_t x = 20; x < 40; ++x) {
      std::uint8_t* bgr = &picture.pixels[3 * (y * 104 + x)];
      bgr[0] = 140;
      bgr[1] = static_cast<std::uint8_t>(60 + x);
      bgr[2] = 240;
    }
  }
  return picture;
}

std::string refusalOf(const Region& region) {
  try {
    makeTable(pinkSquare(), region, "a", 6);
  } catch (const aibo_client::InvalidArgumentException& error) {
    return error.what();
  }
  return "";
}

TEST(TableMaker, TheTableHasTheColorsOfTheRegionAndNoOthers) {
  const Region region{20, 20, 20, 20};
  const aibo_client::ColorTable table = makeTable(pinkSquare(), region, "pink", 2);
  EXPECT_EQ(table.name, "pink");
  const Coverage coverage = coverageOf(table, pinkSquare(), region);
  EXPECT_GE(coverage.inside, 0.97);
  EXPECT_EQ(coverage.outside, 0);
  const Coverage of_a_part = coverageOf(table, pinkSquare(), {20, 20, 20, 10});
  EXPECT_EQ(of_a_part.inside, coverage.inside) << "each row is the same";
  EXPECT_NEAR(of_a_part.outside, coverage.inside * 200 / (104 * 80 - 200), 1e-9);
  EXPECT_FALSE(table.segments[0]);
  EXPECT_FALSE(table.segments[31]);
  ASSERT_TRUE(table.segments[17]);  // Y is about 140
  EXPECT_GT(table.segments[17]->cr_min, 180);
  EXPECT_LT(table.segments[17]->cb_max, 140);
}

TEST(TableMaker, AlsoTakesWhatIsALittleDarkerOrBrighter) {
  node::BgrImage grey{104, 80, std::vector<std::uint8_t>(3 * 104 * 80, 140)};
  const aibo_client::ColorTable table = makeTable(grey, {20, 20, 20, 20}, "grey", 2);
  for (std::size_t segment = 0; segment < table.segments.size(); ++segment) {  // each has 8 values of Y
    EXPECT_EQ(table.segments[segment].has_value(), segment >= 16 && segment <= 18) << segment;
  }
}

TEST(TableMaker, BlackWhiteAndFullColorsHaveTablesToo) {
  const Region all{0, 0, 4, 4};
  for (const std::array<std::uint8_t, 3>& bgr :
       {std::array<std::uint8_t, 3>{0, 0, 0}, {255, 255, 255}, {255, 0, 0}, {0, 0, 255}}) {
    node::BgrImage picture{4, 4, {}};
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

TEST(TableMaker, AFewOtherPixelsDoNotMatter) {
  node::BgrImage picture = pinkSquare();
  picture.pixels[3 * (25 * 104 + 25) + 2] = 0;
  const Region region{20, 20, 20, 20};
  EXPECT_EQ(makeTable(picture, region, "pink", 2).segments, makeTable(pinkSquare(), region, "pink", 2).segments);
}

TEST(TableMaker, SaysWhatIsWrongWithARegion) {
  EXPECT_THAT(refusalOf({90, 20, 20, 20}), HasSubstr("not within the picture, which has 104x80 pixels"));
  EXPECT_THAT(refusalOf({-1, 20, 20, 20}), HasSubstr("not within"));
  EXPECT_THAT(refusalOf({0, 0, 2147483647, 20}), HasSubstr("not within"));
  EXPECT_THAT(refusalOf({20, 20, 3, 5}), HasSubstr("15 pixels"));
}

}  // namespace
}  // namespace aibo_driver::color_table
