#include "protocol/color_requests.h"

#include <gmock/gmock.h>

#include <random>
#include <string>

#include "layouts.h"

namespace protocol {
namespace version2 {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsNull;
using ::testing::NotNull;

Bytes packed(const Bytes& plane) {
  Bytes out(packedColorPlaneSize(plane.size()));
  const size_t size = packColorPlane(plane.data(), plane.size(), out.data());
  EXPECT_LE(size, out.size());
  return firstOf(out, size);
}

Bytes unpacked(const Bytes& packed, size_t pixels) {
  Bytes plane(pixels);
  EXPECT_THAT(unpackColorPlane(packed.data(), packed.size(), pixels, plane.data()), IsNull());
  return plane;
}

const char* unpackProblem(const Bytes& packed, size_t pixels) {
  Bytes plane(pixels);
  return unpackColorPlane(packed.data(), packed.size(), pixels, plane.data());
}

TEST(ColorSettings, AreOfEveryNthImageAndOfThePlane) {
  EXPECT_EQ(encoded(ColorSettings{2, true}), hex("00 02 01 00"));
  EXPECT_THAT(verdict<ColorSettings>(hex("00 00 00 00")), HasSubstr("interval is 0"));
  EXPECT_THAT(verdict<ColorSettings>(hex("00 01 02 00")), HasSubstr("neither 0 nor 1"));
}

TEST(ColorTable, HasFourBytesForEachSegment) {
  ColorTable table{3, {}};
  table.segments[0] = {1, 2, 3, 4};
  table.segments[31] = {150, 230, 120, 190};
  const Bytes bytes = encoded(table);
  ASSERT_EQ(bytes.size(), 132U);
  EXPECT_EQ(firstOf(bytes, 8), hex("03 00 00 00 01 02 03 04"));
  EXPECT_EQ(Bytes(bytes.end() - 4, bytes.end()), hex("96 e6 78 be"));
}

TEST(ColorTable, IsRefusedWhenItMakesNoSense) {
  ColorTable table{7, {}};
  EXPECT_THAT(verdict<ColorTable>(encoded(table)), IsNull());
  table.channel = 8;
  EXPECT_THAT(verdict<ColorTable>(encoded(table)), HasSubstr("0 to 7"));
  table = {0, {}};
  table.segments[31] = {200, 199, 0, 0};
  EXPECT_THAT(verdict<ColorTable>(encoded(table)), HasSubstr("minimum above its maximum"));
  table.segments[31] = {0, 0, 1, 0};
  EXPECT_THAT(verdict<ColorTable>(encoded(table)), HasSubstr("minimum above its maximum"));
}

TEST(ColorTable, IsEmptyAsSonySays) {
  EXPECT_TRUE(isEmpty({128, 128, 128, 128}));
  EXPECT_FALSE(isEmpty({128, 128, 128, 129}));
}

TEST(ColorRegions, AreThoseOfTheChannelsThatHaveATable) {
  const auto regions = decoded<ColorRegions>(hex(kColorRegions));
  EXPECT_EQ(regions.image_count, 66051U);
  EXPECT_EQ(regions.frame_number, 168496141U);
  EXPECT_EQ(regions.width, 104);
  EXPECT_EQ(regions.height, 80);
  ASSERT_EQ(regions.count, 2);
  EXPECT_EQ(regions.regions[0].channel, 0);
  EXPECT_EQ(regions.regions[0].pixels, 300U);
  EXPECT_EQ(regions.regions[0].x, 64 * 52);
  EXPECT_EQ(regions.regions[0].y, 64 * 40);
  EXPECT_EQ(regions.regions[0].left, 42);
  EXPECT_EQ(regions.regions[0].top, 30);
  EXPECT_EQ(regions.regions[0].width, 20);
  EXPECT_EQ(regions.regions[0].height, 21);
  EXPECT_EQ(regions.regions[1].channel, 6);
  EXPECT_FALSE(regions.has_plane);
  EXPECT_EQ(regions.plane_size, 0U);
}

TEST(ColorRegions, AreRefusedWhenTheyContradictThemselves) {
  Bytes bytes = hex(kColorRegions);
  bytes[36] = 0;  // the second channel
  EXPECT_THAT(verdict<ColorRegions>(bytes), HasSubstr("ascending"));
  bytes[36] = 8;
  EXPECT_THAT(verdict<ColorRegions>(bytes), HasSubstr("0 to 7"));
  bytes = hex(kColorRegions);
  bytes[12] = 9;
  EXPECT_THAT(verdict<ColorRegions>(bytes), HasSubstr("more channels"));
  bytes[12] = 1;
  EXPECT_THAT(verdict<ColorRegions>(bytes), HasSubstr("count"));
  bytes = hex(kColorRegions);
  bytes[9] = 0;
  EXPECT_THAT(verdict<ColorRegions>(bytes), HasSubstr("no pixels"));
  bytes = hex(kColorRegions);
  bytes[13] = 1;
  EXPECT_THAT(verdict<ColorRegions>(bytes), HasSubstr("count")) << "a plane without bytes";
  EXPECT_THAT(verdict<ColorRegions>(bytes + hex("00 00")), IsNull());
}

TEST(ColorPlane, IsPackedByPackBits) {
  EXPECT_EQ(packed(hex("07 07 07 07 07")), hex("fc 07"));
  EXPECT_EQ(packed(hex("01 02 02 03")), hex("03 01 02 02 03"));
  EXPECT_EQ(packed(hex("01 02 02 02")), hex("00 01 fe 02"));
  EXPECT_EQ(packed(Bytes(129, 0)), hex("81 00 00 00"));
  EXPECT_EQ(packed(Bytes(MAX_COLOR_PLANE_SIZE, 0)).size(), 2 * 65U) << "an empty plane of an ERS-7";
}

TEST(ColorPlane, IsTheSameAfterwardsAndHardlyEverLarger) {
  std::mt19937 random(1);
  for (int round = 0; round < 500; ++round) {
    Bytes plane(1 + random() % 600);
    const auto values = 1 + static_cast<unsigned>(random() % 3);
    for (unsigned char& pixel : plane) {
      pixel = static_cast<unsigned char>(random() % values);
    }
    ASSERT_EQ(unpacked(packed(plane), plane.size()), plane);
  }
}

TEST(ColorPlane, IsRefusedUnlessItHasTheRightSize) {
  EXPECT_THAT(unpackProblem(hex("fc 07"), 5), IsNull());
  EXPECT_THAT(unpackProblem(hex("fc 07"), 4), HasSubstr("size"));
  EXPECT_THAT(unpackProblem(hex("fc 07"), 6), HasSubstr("too short"));
  EXPECT_THAT(unpackProblem(hex("fc"), 5), HasSubstr("size")) << "a run without its byte";
  EXPECT_THAT(unpackProblem(hex("01 07"), 2), HasSubstr("size")) << "two bytes, and one is there";
  EXPECT_THAT(unpackProblem(hex("80 fc 07"), 5), HasSubstr("size")) << "128 is not used";
}

}  // namespace
}  // namespace version2
}  // namespace protocol
