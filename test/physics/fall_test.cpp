#include <gmock/gmock.h>

#include "bench.h"

namespace {

namespace version2 = protocol::version2;

class Fall : public ::testing::Test {
 protected:
  void passSeconds(double seconds) {
    for (double time = 0; time < seconds; time += 0.008) {
      bench_.passFrame();
    }
  }

  void walk() {
    bench_.steer({0.08, 0, 0});
    passSeconds(4);
    ASSERT_EQ(bench_.step().state, version2::WALK_STATE_WALKS);
  }

  physics::Bench bench_;
};

// A robot that is pushed over stops walking at once, and after a second its legs do not push against anything any more.
TEST_F(Fall, EndsTheWalkAndLetsTheLegsGoSoft) {
  walk();
  bench_.robot().push({0, 16, 0});
  for (int i = 0; i < 500 && bench_.robot().tilt() < 1; ++i) {
    bench_.passFrame();
  }
  bench_.robot().push({0, 0, 0});
  const physics::End end = bench_.awaitEnd(version2::ENDED_WALK, 4);
  EXPECT_GT(bench_.robot().tilt(), 1);
  EXPECT_EQ(end.how, version2::END_FELL);
  EXPECT_THAT(end.reason, testing::HasSubstr("the robot lies on its"));
  EXPECT_TRUE(bench_.robot().motorsPull());
  passSeconds(1.2);
  EXPECT_FALSE(bench_.robot().motorsPull());
  EXPECT_EQ(bench_.step().state, version2::WALK_STATE_NONE);
}

TEST_F(Fall, IsNotSeenInAPushThatTheRobotWithstands) {
  walk();
  bench_.robot().push({0, 3, 0});
  passSeconds(0.3);
  bench_.robot().push({0, 0, 0});
  passSeconds(3);
  EXPECT_THAT(bench_.ends(), testing::IsEmpty());
  EXPECT_LT(bench_.robot().tilt(), 0.2);
}

}  // namespace
