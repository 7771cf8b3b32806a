#include "protocol/color_requests.h"

#include <gmock/gmock.h>

#include <numeric>

#include "layouts.h"

namespace protocol {
namespace version2 {
namespace {

using ::testing::HasSubstr;
using ::testing::IsNull;

Bytes packed(const Bytes& plane) {
  Bytes out(plane.size() + plane.size() / 128 + 1);
  const size_t size = packColorPlane(plane.data(), plane.size(), out.data());
  EXPECT_LE(size, out.size());
  return firstOf(out, size);
}

const char* unpackProblem(const Bytes& packed, size_t pixels) {
  Bytes plane(pixels);
  return unpackColorPlane(packed.data(), packed.size(), pixels, plane.data());
}

TEST(ColorTable, IsEmptyAsSonySays) {
  EXPECT_TRUE(isEmpty({128, 128, 128, 128}));
  EXPECT_FALSE(isEmpty({128, 128, 128, 129}));
}

TEST(ColorPlane, IsPackedByPackBits) {
  EXPECT_EQ(packed(hex("07 07 07 07 07")), hex("fc 07"));
  EXPECT_EQ(packed(hex("01 02 02 03")), hex("03 01 02 02 03"));
  EXPECT_EQ(packed(hex("01 02 02 02")), hex("00 01 fe 02"));
  EXPECT_EQ(packed(Bytes(129, 0)), hex("81 00 00 00"));
  Bytes different(129);
  std::iota(different.begin(), different.end(), static_cast<unsigned char>(0));
  EXPECT_EQ(packed(different), hex("7f") + firstOf(different, 128) + hex("00 80"));
  EXPECT_EQ(packed(Bytes(MAX_COLOR_PLANE_WIDTH * MAX_COLOR_PLANE_HEIGHT, 0)).size(), 2 * 65U)
      << "an empty plane of an ERS-7";
}

TEST(ColorPlane, IsRefusedUnlessItHasTheRightSize) {
  EXPECT_THAT(unpackProblem(hex("fc 07"), 5), IsNull());
  EXPECT_THAT(unpackProblem(hex("fc 07"), 4), HasSubstr("size"));
  EXPECT_THAT(unpackProblem(hex("fc 07"), 6), HasSubstr("too short"));
  EXPECT_THAT(unpackProblem(hex("fc"), 5), HasSubstr("size")) << "a run without its byte";
  EXPECT_THAT(unpackProblem(hex("01 07"), 2), HasSubstr("size")) << "two bytes, and one is there";
  EXPECT_THAT(unpackProblem(hex("80 fc 07"), 5), HasSubstr("size")) << "128 is not used";
  EXPECT_THAT(unpackProblem(hex("80") + Bytes(129, 7), 129), HasSubstr("size"));
}

}  // namespace
}  // namespace version2
}  // namespace protocol
