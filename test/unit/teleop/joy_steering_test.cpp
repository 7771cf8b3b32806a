#include "tools/teleop/joy_steering.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>

namespace teleop {
namespace {

using ::testing::HasSubstr;

class JoySteeringTest : public ::testing::Test {
 protected:
  std::optional<aibo_driver::WalkVelocity> steer(bool pressed, float forward, float left = 0, float turn = 0) {
    return joy_.steer({left, forward, 0, turn}, {0, 0, 0, 0, pressed ? 1 : 0});
  }

  JoySteering joy_{JoyMapping()};
};

TEST_F(JoySteeringTest, SteersWhileTheDeadManButtonIsPressed) {
  EXPECT_FALSE(steer(false, 1));
  const auto velocity = steer(true, 1, -1, 1);
  ASSERT_TRUE(velocity);
  EXPECT_DOUBLE_EQ(velocity->forward, 0.15);
  EXPECT_DOUBLE_EQ(velocity->left, -0.06);
  EXPECT_DOUBLE_EQ(velocity->turn, 1.0);
}

TEST_F(JoySteeringTest, StopsOnceWhenTheButtonIsLetGo) {
  steer(true, 1);
  const auto velocity = steer(false, 1);
  ASSERT_TRUE(velocity);
  EXPECT_TRUE(velocity->isZero());
  EXPECT_FALSE(steer(false, 1)) << "others may steer";
}

TEST_F(JoySteeringTest, TakesASmallDeflectionForNone) {
  EXPECT_TRUE(steer(true, 0.09F)->isZero());
  EXPECT_NEAR(steer(true, 0.55F)->forward, 0.075, 1e-6);
  EXPECT_NEAR(steer(true, -0.55F)->forward, -0.075, 1e-6);
  EXPECT_NEAR(steer(true, 7.0F)->forward, 0.15, 1e-6) << "not more than all of it";
}

TEST_F(JoySteeringTest, TakesWhatIsNotANumberForNone) {
  EXPECT_TRUE(steer(true, std::nanf(""))->isZero());
}

TEST_F(JoySteeringTest, StopsWithAJoystickThatHasOtherParts) {
  EXPECT_EQ(joy_.problem(4, 5), "");
  EXPECT_THAT(joy_.problem(3, 5), HasSubstr("3 axes and 5 buttons, but its mapping names axis 3 and button 4"));
  EXPECT_THAT(joy_.problem(4, 4), HasSubstr("4 buttons"));
  EXPECT_FALSE(joy_.steer({1, 1}, {1, 1, 1, 1, 1}));
  steer(true, 1);
  const auto velocity = joy_.steer({1, 1}, {1, 1, 1, 1, 1});
  ASSERT_TRUE(velocity);
  EXPECT_TRUE(velocity->isZero());
}

}  // namespace
}  // namespace teleop
