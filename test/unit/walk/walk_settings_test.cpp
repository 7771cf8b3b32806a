#include "walk/walk_settings.h"

#include <gmock/gmock.h>

namespace aibo_driver::walk {
namespace {

using aibo_client::WalkVelocity;

constexpr aibo_client::WalkLimits kRobot{0.15, 0.1, 0.06, 1.2};

void expectNear(const WalkVelocity& velocity, const WalkVelocity& expected) {
  EXPECT_NEAR(velocity.forward, expected.forward, 1e-12);
  EXPECT_NEAR(velocity.left, expected.left, 1e-12);
  EXPECT_NEAR(velocity.turn, expected.turn, 1e-12);
}

TEST(WalkSettings, SlowDownAllOfAVelocityThatIsTooFastForTheRobotOrTheUser) {
  WalkSettings slow;
  slow.speed_limit = 0.05;
  slow.side_limit = 0.02;
  slow.turn_limit = 0.5;
  WalkSettings straight;
  straight.side_limit = 0;
  const std::tuple<WalkVelocity, WalkSettings, aibo_client::WalkLimits, WalkVelocity> rows[] = {
      {{0.1, -0.05, 1}, {}, kRobot, {0.1, -0.05, 1}},
      {{-0.1, 0.06, -1.2}, {}, kRobot, {-0.1, 0.06, -1.2}},
      {{0.3, 0, 1}, {}, kRobot, {0.15, 0, 0.5}},
      {{-0.3, 0.03, 0}, {}, kRobot, {-0.1, 0.01, 0}},
      {{0.1, 0.12, -1.2}, {}, kRobot, {0.05, 0.06, -0.6}},
      {{0.1, 0, 12}, {}, kRobot, {0.01, 0, 1.2}},
      {{0.3, 0.3, 2}, {}, {}, {0.3, 0.3, 2}},  // a robot that does not say its limits
      {{0.1, 0, 0.2}, slow, kRobot, {0.05, 0, 0.1}},
      {{-0.1, 0, 0}, slow, kRobot, {-0.05, 0, 0}},
      {{0, 0.04, 0}, slow, kRobot, {0, 0.02, 0}},
      {{0, 0, -1}, slow, kRobot, {0, 0, -0.5}},
      {{0.1, 0.05, 0.2}, straight, kRobot, {0.1, 0, 0.2}},  // a limit of 0 leaves a direction out
  };
  for (const auto& [wanted, settings, robot, expected] : rows) {
    expectNear(velocityToSend(wanted, settings, robot), expected);
  }
}

TEST(WalkSettings, CorrectEachAxis) {
  WalkSettings settings;
  settings.scale = 0.9;
  settings.side_scale = 0.8;
  settings.curve = 2;
  expectNear(realVelocity({0.1, 0, 0}, settings), {0.09, 0, 0.18});
  expectNear(realVelocity({-0.1, 0.05, 0}, settings), {-0.09, 0.04, 0});
  settings.turn_scale = 0.5;
  expectNear(realVelocity({0.1, 0, 0.2}, settings), {0.09, 0, 0.28});
  settings.turn_scale = 1;
  expectNear(velocityToSend({0.09, 0.04, 0}, settings, kRobot), {0.1, 0.05, -0.18});
  expectNear(velocityToSend({0, 0, 0}, settings, kRobot), {0, 0, 0});
  settings.speed_limit = 0.09;
  expectNear(velocityToSend({0.5, 0, 0}, settings, kRobot), {0.1, 0, -0.18});
  settings.direction = 0.3;
  settings.turn_scale = 1.2;
  for (const WalkVelocity& wanted : {WalkVelocity{0.05, 0.01, 0.1}, WalkVelocity{-0.05, -0.01, 0.1}}) {
    expectNear(realVelocity(velocityToSend(wanted, settings, kRobot), settings), wanted);
  }
}

TEST(WalkSettings, KeepToTheRobotsLimitsWhateverTheCalibration) {
  WalkSettings settings;
  settings.scale = 0.2;
  settings.direction = 1.0;
  const WalkVelocity sent = velocityToSend({0.15, 0, 0}, settings, kRobot);
  EXPECT_LE(sent.forward, 0.15 + 1e-9);
  EXPECT_GE(sent.left, -0.06 - 1e-9);
}

}  // namespace
}  // namespace aibo_driver::walk
