#include "protocol/walk_requests.h"

#include <gmock/gmock.h>

#include <climits>

#include "layouts.h"

namespace protocol {
namespace version2 {
namespace {

using ::testing::StrEq;

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
