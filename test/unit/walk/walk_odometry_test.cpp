#include "walk/walk_odometry.h"

#include <gmock/gmock.h>

#include <Eigen/LU>
#include <cmath>

namespace aibo_driver::walk {
namespace {

using aibo_client::EndedHow;
using aibo_client::EndedKind;
using aibo_client::PostureNow;

class WalkOdometryTest : public ::testing::Test {
 protected:
  WalkOdometryTest() {
    settings_.scale = 0.9;
    settings_.side_scale = 0.8;
    settings_.turn_scale = 0.5;
    settings_.direction = 0.1;
    settings_.curve = 0.3;
  }

  // A measurement `frames` after the one before. The robot itself is wrong about its velocity.
  void measure(const aibo_client::WalkVelocity& real, unsigned frames = 4) {
    const aibo_client::WalkVelocity velocity = velocityToSend(real, settings_, {});
    frame_ += frames;
    aibo_client::Telemetry telemetry;
    telemetry.frame_number = frame_;
    telemetry.connection_number = connection_;
    telemetry.walk = aibo_client::WalkReading{velocity, 0, aibo_client::WalkState::kWalks};
    EXPECT_TRUE(way_.update(telemetry));
  }

  double uncertainty() const { return std::sqrt(way_.odometry().covariance()(0, 0)); }
  double turnUncertainty() const { return std::sqrt(way_.odometry().covariance()(2, 2)); }

  WalkSettings settings_;
  WalkOdometry way_{settings_};
  unsigned frame_ = 0xfffffff0U;  // overflows
  std::uint64_t connection_ = 41;
};

TEST_F(WalkOdometryTest, IsTheSumOfTheVelocitiesOverTheRobotsTime) {
  measure({});
  for (int i = 0; i < 125; ++i) {  // 4 s
    measure({0.1, 0, 0});
  }
  EXPECT_NEAR(way_.odometry().x(), 0.4, 1e-9);
  measure({});
  EXPECT_NEAR(way_.odometry().x(), 0.4, 1e-9) << "each velocity is that of the time before it was measured";
  measure({0.1, 0, 0});
  EXPECT_NEAR(way_.velocity().forward, 0.1, 1e-12);
}

TEST_F(WalkOdometryTest, GoesOnIfMeasurementsAreMissing) {
  measure({0.1, 0, 0});
  measure({0.1, 0, 0}, 50);
  EXPECT_NEAR(way_.odometry().x(), 0.04, 1e-9);
  measure({0.1, 0, 0}, 62);  // just above 2 Hz
  EXPECT_LT(uncertainty(), 0.035);
  measure({0.1, 0, 0}, 63);
  EXPECT_NEAR(way_.odometry().x(), 0.14, 1e-9);
  EXPECT_GT(uncertainty(), 0.04) << "within more than half a second it may have stopped";
  const double before = uncertainty();
  measure({0, 0.1, 0.4}, 125);
  EXPECT_GT(uncertainty(), before + 0.01) << "also to the side";
  EXPECT_GT(turnUncertainty(), 0.2);
}

TEST_F(WalkOdometryTest, DoesNotJumpOverAReconnectButIsLessCertain) {
  measure({0.1, 0, 0});
  measure({0.1, 0, 0}, 100);
  const double before = uncertainty();
  ++connection_;
  frame_ = 1000;  // the robot was started again
  measure({});
  EXPECT_NEAR(way_.odometry().x(), 0.08, 1e-9);
  EXPECT_GT(uncertainty(), before + 0.04);
  EXPECT_GT(turnUncertainty(), 0.5);
  const double after = uncertainty();
  ++connection_;
  measure({}, 100000);
  EXPECT_EQ(uncertainty(), after) << "it stood when the connection broke";
  measure({0, 0, 0.5});
  const double turning = uncertainty();
  ++connection_;
  measure({});
  EXPECT_GT(uncertainty(), turning + 0.01) << "it turned where it stood";
}

TEST_F(WalkOdometryTest, MayBeAnywhereAfterAFall) {
  measure({});
  way_.motionEnded({EndedKind::kWalk, EndedHow::kStopped, "walk", ""});
  EXPECT_EQ(uncertainty(), 0);
  way_.motionEnded({EndedKind::kWalk, EndedHow::kFell, "walk", "it was lifted"});
  EXPECT_DOUBLE_EQ(uncertainty(), 1);
  EXPECT_GT(turnUncertainty(), 3);
}

TEST_F(WalkOdometryTest, MayBeAnywhereAfterItWasLiftedWhileItStoodAndThatCountsOnce) {
  const auto tell = [this](PostureNow posture) {
    way_.update(aibo_client::MotorsAndPosture{aibo_client::MotorState::kOn, posture});
  };
  measure({});
  tell(PostureNow::kStanding);
  EXPECT_EQ(uncertainty(), 0);
  tell(PostureNow::kCarried);
  EXPECT_DOUBLE_EQ(uncertainty(), 1);
  tell(PostureNow::kFallen);
  way_.motionEnded({EndedKind::kPosture, EndedHow::kFell, "stand", "it fell"});
  EXPECT_DOUBLE_EQ(uncertainty(), 1);
  tell(PostureNow::kWalking);
  way_.motionEnded({EndedKind::kWalk, EndedHow::kFell, "walk", "it was lifted"});
  tell(PostureNow::kFallen);
  EXPECT_DOUBLE_EQ(uncertainty(), std::sqrt(2));
}

constexpr double kPi = 3.14159265358979323846;

// Walks for a time in so many steps.
void walk(Odometry* odometry, const aibo_client::WalkVelocity& velocity, double time, int steps) {
  for (int i = 0; i < steps; ++i) {
    odometry->walk(velocity, time / steps);
  }
}

TEST(Odometry, TurnsCounterclockwiseAndThenGoesThatWay) {
  Odometry odometry;
  odometry.walk({0, 0, kPi / 2}, 1);
  odometry.walk({0.1, 0, 0}, 1);
  odometry.walk({0, 0.1, 0}, 2);
  EXPECT_NEAR(odometry.x(), -0.2, 1e-12);
  EXPECT_NEAR(odometry.y(), 0.1, 1e-12);
  EXPECT_NEAR(odometry.yaw(), kPi / 2, 1e-12);
}

TEST(Odometry, GoesAlongTheSameArcInOneStepAndInMany) {
  for (const int steps : {1, 7, 1000}) {
    Odometry odometry;
    walk(&odometry, {0.1, 0, 0.5}, kPi, steps);  // a quarter of a circle with a radius of 0.2 m
    EXPECT_NEAR(odometry.x(), 0.2, 1e-9) << steps;
    EXPECT_NEAR(odometry.y(), 0.2, 1e-9) << steps;
    EXPECT_NEAR(odometry.yaw(), kPi / 2, 1e-9) << steps;
  }
}

TEST(Odometry, KeepsTheDirectionBetweenMinusPiAndPi) {
  Odometry odometry;
  walk(&odometry, {0, 0, 1}, 4, 125);
  EXPECT_NEAR(odometry.yaw(), 4 - 2 * kPi, 1e-9);
  walk(&odometry, {0, 0, -1}, 8, 250);
  EXPECT_NEAR(odometry.yaw(), 2 * kPi - 4, 1e-9);
}

TEST(Odometry, IsAsUncertainAsTheDocumentSaysAfterAMetreAndAfterAQuarterTurn) {
  Odometry straight;
  straight.walk({0.1, 0, 0}, 10);
  constexpr double kOneDegree = kPi / 180;
  EXPECT_NEAR(std::sqrt(straight.covariance()(0, 0)), 0.1, 1e-9);
  EXPECT_NEAR(std::sqrt(straight.covariance()(1, 1)), 0.1, 1e-9);
  EXPECT_NEAR(std::sqrt(straight.covariance()(2, 2)), 9 * kOneDegree, 0.5 * kOneDegree);
  Odometry sideways;
  sideways.walk({0, -0.1, 0}, 10);
  EXPECT_NEAR(std::sqrt(sideways.covariance()(0, 0)), 0.1, 1e-9);
  Odometry turning;
  turning.walk({0, 0, -0.5}, kPi);
  EXPECT_NEAR(std::sqrt(turning.covariance()(0, 0)), 0.0125, 1e-3);
  EXPECT_NEAR(std::sqrt(turning.covariance()(2, 2)), 7 * kOneDegree, 0.5 * kOneDegree);
}

TEST(Odometry, ThatHasLostItsWayKeepsItsPlace) {
  Odometry odometry;
  odometry.walk({0.1, 0, 0}, 10);
  for (int i = 0; i < 10; ++i) {
    odometry.lose(1, 3.2);
  }
  EXPECT_NEAR(odometry.x(), 1, 1e-9);
  EXPECT_GT(odometry.covariance()(0, 0), 10);
  EXPECT_NEAR(odometry.covariance()(2, 2), kPi * kPi, 1e-9) << "more than any direction is not possible";
}

constexpr aibo_client::WalkLimits kRobot{0.15, 0.1, 0.06, 1.2};

void expectNear(const aibo_client::WalkVelocity& velocity, const aibo_client::WalkVelocity& expected) {
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
  const std::tuple<aibo_client::WalkVelocity, WalkSettings, aibo_client::WalkLimits, aibo_client::WalkVelocity> rows[] =
      {
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
  for (const aibo_client::WalkVelocity& wanted :
       {aibo_client::WalkVelocity{0.05, 0.01, 0.1}, aibo_client::WalkVelocity{-0.05, -0.01, 0.1}}) {
    expectNear(realVelocity(velocityToSend(wanted, settings, kRobot), settings), wanted);
  }
}

TEST(WalkSettings, KeepToTheRobotsLimitsWhateverTheCalibration) {
  WalkSettings settings;
  settings.scale = 0.2;
  settings.direction = 1.0;
  const aibo_client::WalkVelocity sent = velocityToSend({0.15, 0, 0}, settings, kRobot);
  EXPECT_LE(sent.forward, 0.15 + 1e-9);
  EXPECT_GE(sent.left, -0.06 - 1e-9);
}

}  // namespace
}  // namespace aibo_driver::walk
