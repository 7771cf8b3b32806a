#include "tools/teleop/key_steering.h"

#include <gmock/gmock.h>

namespace teleop {
namespace {

using std::chrono::milliseconds;

class KeySteeringTest : public ::testing::Test {
 protected:
  void expect(char key, double forward, double left, double turn) {
    keys_.press(key, now_);
    const aibo_client::WalkVelocity velocity = keys_.velocity(now_);
    EXPECT_DOUBLE_EQ(velocity.forward, forward) << key;
    EXPECT_DOUBLE_EQ(velocity.left, left) << key;
    EXPECT_DOUBLE_EQ(velocity.turn, turn) << key;
  }

  KeySteering::TimePoint now_{milliseconds(1000)};
  KeySteering keys_{{0.1, 0.05, 0.5}, milliseconds(800)};
};

TEST_F(KeySteeringTest, GoesWhereTheKeyIsSeenFromK) {
  expect('i', 0.1, 0, 0);
  expect('u', 0.1, 0, 0.5);
  expect('o', 0.1, 0, -0.5);
  expect('j', 0, 0, 0.5);
  expect('l', 0, 0, -0.5);
  expect('m', -0.1, 0, -0.5);
  expect(',', -0.1, 0, 0);
  expect('.', -0.1, 0, 0.5);
}

TEST_F(KeySteeringTest, GoesAlsoByTheArrowKeys) {
  expect(kArrowUp, 0.1, 0, 0);
  expect(kArrowDown, -0.1, 0, 0);
  expect(kArrowLeft, 0, 0, 0.5);
  expect(kArrowRight, 0, 0, -0.5);
}

TEST_F(KeySteeringTest, GoesSidewaysWithCapitals) {
  expect('J', 0, 0.05, 0);
  expect('L', 0, -0.05, 0);
  expect('I', 0.1, 0, 0);
  expect('U', 0.1, 0.05, 0);
  expect('O', 0.1, -0.05, 0);
  expect('M', -0.1, 0.05, 0);
  expect('<', -0.1, 0, 0);
  expect('>', -0.1, -0.05, 0);
}

TEST_F(KeySteeringTest, StopsByEveryOtherKey) {
  for (const char key : {'k', 'K', ' ', 's', '5', '\033', '\n'}) {
    keys_.press('i', now_);
    expect(key, 0, 0, 0);
  }
}

TEST_F(KeySteeringTest, GoesOnlyAsLongAsAKeyIsHeldDown) {
  EXPECT_TRUE(keys_.velocity(now_).isZero()) << "no key was pressed yet";
  keys_.press('i', now_);
  EXPECT_FALSE(keys_.velocity(now_ + milliseconds(799)).isZero());
  EXPECT_TRUE(keys_.velocity(now_ + milliseconds(800)).isZero());
  keys_.press('i', now_ + milliseconds(700));
  EXPECT_FALSE(keys_.velocity(now_ + milliseconds(1400)).isZero());
  KeySteering latching({}, milliseconds(0));
  latching.press('i', now_);
  EXPECT_FALSE(latching.velocity(now_ + milliseconds(100000)).isZero());
}

TEST_F(KeySteeringTest, ChangesItsSpeedsAndGoesOn) {
  keys_.press('i', now_);
  EXPECT_TRUE(keys_.press('w', now_));
  EXPECT_NEAR(keys_.velocity(now_).forward, 0.11, 1e-12);
  EXPECT_NEAR(keys_.speeds().left, 0.055, 1e-12);
  EXPECT_NEAR(keys_.speeds().turn, 0.5, 1e-12);
  EXPECT_TRUE(keys_.press('c', now_));
  EXPECT_NEAR(keys_.speeds().turn, 0.45, 1e-12);
  EXPECT_TRUE(keys_.press('x', now_));
  EXPECT_TRUE(keys_.press('e', now_));
  EXPECT_NEAR(keys_.speeds().forward, 0.099, 1e-12);
  EXPECT_NEAR(keys_.speeds().turn, 0.495, 1e-12);
  EXPECT_TRUE(keys_.press('q', now_));
  EXPECT_NEAR(keys_.speeds().forward, 0.1089, 1e-12);
  EXPECT_NEAR(keys_.speeds().turn, 0.5445, 1e-12);
  EXPECT_TRUE(keys_.press('z', now_));
  EXPECT_NEAR(keys_.speeds().forward, 0.09801, 1e-12);
  EXPECT_NEAR(keys_.speeds().turn, 0.49005, 1e-12);
  EXPECT_FALSE(keys_.press('i', now_));
}

TEST_F(KeySteeringTest, DoesNotGoOnWhenTheSpeedsAreChangedAfterAKeyWasLetGo) {
  keys_.press('i', now_);
  keys_.press('q', now_ + milliseconds(900));
  EXPECT_TRUE(keys_.velocity(now_ + milliseconds(900)).isZero());
}

}  // namespace
}  // namespace teleop
