#include "web/steering.h"

#include <gmock/gmock.h>

namespace aibo_driver::web {
namespace {

using std::chrono::milliseconds;

constexpr Page kMine = 1;
constexpr Page kOther = 2;

class SteeringTest : public ::testing::Test {
 protected:
  // A finger makes the robot walk, or only turns its head.
  bool hold(Page page, bool walks = true) { return steering_.hold(page, walks, now_); }

  bool pass(milliseconds time) { return steering_.expire(now_ += time); }

  TimePoint now_{milliseconds(12345)};
  Steering steering_;
};

TEST_F(SteeringTest, EndsAWalkOnceWhenTheFingerIsLifted) {
  EXPECT_TRUE(hold(kMine));
  EXPECT_TRUE(steering_.letGo(kMine));
  EXPECT_FALSE(steering_.letGo(kMine));
  EXPECT_FALSE(pass(milliseconds(1000)));
  EXPECT_FALSE(steering_.page());
}

TEST_F(SteeringTest, EndsAWalkThatIsNotRepeated) {
  hold(kMine);
  EXPECT_FALSE(pass(milliseconds(299)));
  hold(kMine);
  EXPECT_FALSE(pass(milliseconds(299)));
  EXPECT_EQ(steering_.end(), now_ + milliseconds(1));
  EXPECT_TRUE(pass(milliseconds(1)));
  EXPECT_FALSE(pass(milliseconds(1)));
  EXPECT_TRUE(hold(kMine)) << "the finger is still there";
}

TEST_F(SteeringTest, TellsTheRobotToStandOnlyAfterAWalk) {
  hold(kMine, false);
  EXPECT_FALSE(steering_.letGo(kMine));
  hold(kMine);
  hold(kMine, false);
  EXPECT_TRUE(steering_.letGo(kMine)) << "also if the head was turned since";
}

TEST_F(SteeringTest, BelongsToOnePage) {
  hold(kMine);
  EXPECT_FALSE(hold(kOther));
  EXPECT_EQ(steering_.page(), kMine);
  EXPECT_FALSE(steering_.letGo(kOther)) << "that is not its walk";
  steering_.letGo(kMine);
  EXPECT_TRUE(hold(kOther));
}

}  // namespace
}  // namespace aibo_driver::web
