#include "protocol/walk_requests.h"

#include <gmock/gmock.h>

#include <climits>

#include "layouts.h"

namespace protocol {
namespace version2 {
namespace {

using ::testing::HasSubstr;
using ::testing::IsNull;
using ::testing::StrEq;

TEST(Velocity, IsForwardLeftAndTurn) {
  EXPECT_EQ(encoded(encodeVelocity, Velocity{150, -60, 1200}, VELOCITY_SIZE), hex(kVelocity));

  Velocity velocity{};
  ASSERT_THAT(decodeVelocity(hex(kVelocity).data(), VELOCITY_SIZE, &velocity), IsNull());
  EXPECT_EQ(velocity.forward, 150);
  EXPECT_EQ(velocity.left, -60);
  EXPECT_EQ(velocity.turn, 1200);
}

TEST(Velocity, CarriesTheOutermostValues) {
  const Bytes bytes = encoded(encodeVelocity, Velocity{SHRT_MIN, SHRT_MAX, -1}, VELOCITY_SIZE);
  EXPECT_EQ(bytes, hex("80 00 7f ff ff ff 00 00"));

  Velocity velocity{};
  ASSERT_THAT(decodeVelocity(bytes.data(), bytes.size(), &velocity), IsNull());
  EXPECT_EQ(velocity.forward, SHRT_MIN);
  EXPECT_EQ(velocity.left, SHRT_MAX);
  EXPECT_EQ(velocity.turn, -1);
}

TEST(Velocity, IsUnchangedWhenItIsRefused) {
  Velocity velocity{1, 2, 3};
  EXPECT_THAT(decodeVelocity(hex("00 96 ff c4 04 b0 00 01").data(), 8, &velocity), HasSubstr("reserved"));
  EXPECT_THAT(decodeVelocity(hex(kVelocity).data(), 7, &velocity), HasSubstr("size"));
  EXPECT_EQ(velocity.forward, 1);
  EXPECT_EQ(velocity.left, 2);
  EXPECT_EQ(velocity.turn, 3);
}

TEST(Posture, IsStandSitOrRest) {
  EXPECT_FALSE(isPosture(0));
  EXPECT_TRUE(isPosture(1));
  EXPECT_TRUE(isPosture(2));
  EXPECT_TRUE(isPosture(3));
  EXPECT_FALSE(isPosture(4));
  EXPECT_FALSE(isPosture(255));
  EXPECT_THAT(postureName(POSTURE_STAND), StrEq("stand"));
  EXPECT_THAT(postureName(POSTURE_SIT), StrEq("sit"));
  EXPECT_THAT(postureName(POSTURE_REST), StrEq("rest"));
}

}  // namespace
}  // namespace version2
}  // namespace protocol
