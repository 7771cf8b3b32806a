#include "protocol/walk_requests.h"

#include <gmock/gmock.h>

namespace protocol {
namespace version2 {
namespace {

using ::testing::StrEq;

TEST(Posture, IsStandSitOrRest) {
  for (int id = 0; id < 256; ++id) {
    EXPECT_EQ(canTake(static_cast<unsigned char>(id)), id >= 1 && id <= 3) << id;
  }
  EXPECT_THAT(postureName(POSTURE_STAND), StrEq("stand"));
  EXPECT_THAT(postureName(POSTURE_SIT), StrEq("sit"));
  EXPECT_THAT(postureName(POSTURE_REST), StrEq("rest"));
}

}  // namespace
}  // namespace version2
}  // namespace protocol
