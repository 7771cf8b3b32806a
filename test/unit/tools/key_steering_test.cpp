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

  void expectSpeeds(char key, double forward, double left, double turn) {
    EXPECT_TRUE(keys_.press(key, now_));
    EXPECT_NEAR(keys_.speeds().forward, forward, 1e-12) << key;
    EXPECT_NEAR(keys_.speeds().left, left, 1e-12) << key;
    EXPECT_NEAR(keys_.speeds().turn, turn, 1e-12) << key;
  }

  KeySteering::TimePoint now_{milliseconds(12345)};
  KeySteering keys_{{0.2, 0.05, 0.7}, milliseconds(600)};
};

TEST_F(KeySteeringTest, GoesWhereTheKeyIsSeenFromK) {
  const std::tuple<char, double, double, double> rows[] = {
      {'i', 0.2, 0, 0},      {'u', 0.2, 0, 0.7},       {'o', 0.2, 0, -0.7},     {'j', 0, 0, 0.7},
      {'l', 0, 0, -0.7},     {'m', -0.2, 0, -0.7},     {',', -0.2, 0, 0},       {'.', -0.2, 0, 0.7},
      {kArrowUp, 0.2, 0, 0}, {kArrowDown, -0.2, 0, 0}, {kArrowLeft, 0, 0, 0.7}, {kArrowRight, 0, 0, -0.7},
      {'J', 0, 0.05, 0},     {'L', 0, -0.05, 0},       {'I', 0.2, 0, 0},        {'U', 0.2, 0.05, 0},
      {'O', 0.2, -0.05, 0},  {'M', -0.2, 0.05, 0},     {'<', -0.2, 0, 0},       {'>', -0.2, -0.05, 0},
  };
  for (const auto& [key, forward, left, turn] : rows) {
    expect(key, forward, left, turn);
  }
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
  EXPECT_FALSE(keys_.velocity(now_ + milliseconds(599)).isZero());
  EXPECT_TRUE(keys_.velocity(now_ + milliseconds(600)).isZero());
  keys_.press('i', now_ + milliseconds(500));
  EXPECT_FALSE(keys_.velocity(now_ + milliseconds(1000)).isZero());
  KeySteering latching({}, milliseconds(0));
  latching.press('i', now_);
  EXPECT_FALSE(latching.velocity(now_ + milliseconds(100000)).isZero());
}

TEST_F(KeySteeringTest, ChangesItsSpeedsAndGoesOn) {
  keys_.press('i', now_);
  expectSpeeds('w', 0.22, 0.055, 0.7);
  EXPECT_NEAR(keys_.velocity(now_).forward, 0.22, 1e-12);
  expectSpeeds('c', 0.22, 0.055, 0.63);
  expectSpeeds('x', 0.198, 0.0495, 0.63);
  expectSpeeds('e', 0.198, 0.0495, 0.693);
  expectSpeeds('q', 0.2178, 0.05445, 0.7623);
  expectSpeeds('z', 0.19602, 0.049005, 0.68607);
  EXPECT_FALSE(keys_.press('i', now_));
}

TEST_F(KeySteeringTest, DoesNotGoOnWhenTheSpeedsAreChangedAfterAKeyWasLetGo) {
  keys_.press('i', now_);
  keys_.press('q', now_ + milliseconds(700));
  EXPECT_TRUE(keys_.velocity(now_ + milliseconds(700)).isZero());
}

}  // namespace
}  // namespace teleop
