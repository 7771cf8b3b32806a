#include "protocol/walk_requests.h"

#include <gmock/gmock.h>

#include <climits>

#include "layouts.h"

namespace protocol {
namespace version2 {
namespace {

using ::testing::StrEq;

TEST(Velocity, IsForwardLeftAndTurn) {
  const auto velocity = decoded<Velocity>(hex(kVelocity));
  EXPECT_DOUBLE_EQ(velocity.forward, 0.15);
  EXPECT_DOUBLE_EQ(velocity.left, -0.06);
  EXPECT_DOUBLE_EQ(velocity.turn, 1.2);
  EXPECT_EQ(encoded(Velocity{-32.768, 32.767, -0.001}), hex("80 00 7f ff ff ff 00 00"));
  EXPECT_EQ(encoded(Velocity{0.0014, 0.0015, -0.0015}), hex("00 01 00 02 ff fe 00 00")) << "rounded to the nearest";
}

TEST(Velocity, OfEachValueOnTheWireComesBackAsItWas) {
  for (int value = SHRT_MIN; value <= SHRT_MAX; ++value) {
    const Velocity velocity = {value * 1e-3, 0, 0};
    const auto bytes = encoded(velocity);
    ASSERT_EQ(static_cast<short>((bytes[0] << 8) | bytes[1]), value);
    ASSERT_EQ(decoded<Velocity>(bytes).forward, velocity.forward);
  }
}

TEST(Posture, IsStandSitOrRest) {
  EXPECT_FALSE(canTake(0));
  EXPECT_TRUE(canTake(1));
  EXPECT_TRUE(canTake(2));
  EXPECT_TRUE(canTake(3));
  EXPECT_FALSE(canTake(4));
  EXPECT_FALSE(canTake(255));
  EXPECT_THAT(postureName(POSTURE_STAND), StrEq("stand"));
  EXPECT_THAT(postureName(POSTURE_SIT), StrEq("sit"));
  EXPECT_THAT(postureName(POSTURE_REST), StrEq("rest"));
}

}  // namespace
}  // namespace version2
}  // namespace protocol
