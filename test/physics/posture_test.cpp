#include <gmock/gmock.h>

#include <algorithm>
#include <random>
#include <string>

#include "bench.h"

namespace {

using physics::Bench;
using physics::End;
using physics::World;
using ::testing::ContainsRegex;

namespace version2 = protocol::version2;
using version2::Posture;

constexpr double kDegree = 3.14159265358979323846 / 180;

/// A robot that takes postures. It must not tip over on any way.
class PostureTaker {
 public:
  explicit PostureTaker(const World& world = World()) : bench_(world) {}

  void take(Posture posture) {
    bench_.take(posture);
    awaitArrival(posture);
  }

  void awaitArrival(Posture posture) {
    SCOPED_TRACE(postureName(posture));
    const size_t before = bench_.ends().size();
    for (int i = 0; i < 20 * 125 && bench_.ends().size() == before; ++i) {
      passFrame();
    }
    ASSERT_GT(bench_.ends().size(), before)
        << "it does not arrive: " << (bench_.errors().empty() ? "no error" : bench_.errors().back());
    const End& end = bench_.ends().back();
    EXPECT_EQ(end.what, version2::ENDED_POSTURE);
    EXPECT_EQ(end.how, version2::END_DONE) << end.reason;
    EXPECT_EQ(end.name, postureName(posture));
    for (int i = 0; i < 125; ++i) {
      passFrame();
    }
    EXPECT_LT(highest_tilt_, 50 * kDegree);
    highest_tilt_ = 0;
  }

  Bench& bench() { return bench_; }

 private:
  void passFrame() {
    bench_.passFrame();
    highest_tilt_ = std::max(highest_tilt_, bench_.robot().tilt());
  }

  Bench bench_;
  double highest_tilt_ = 0;
};

void expectStands(physics::PhysicalErs7& robot) {
  EXPECT_FALSE(robot.bodyTouchesFloor());
  EXPECT_LT(robot.tilt(), 5 * kDegree);
  for (int leg = 0; leg < robot_model::NUMBER_OF_LEGS; ++leg) {
    EXPECT_TRUE(robot.touchesFloor(static_cast<robot_model::Leg>(leg))) << leg;
  }
}

class Postures : public ::testing::TestWithParam<World> {};

TEST_P(Postures, CanBeTakenFromEachOther) {
  PostureTaker taker(GetParam());
  for (const Posture posture :
       {version2::POSTURE_STAND, version2::POSTURE_SIT, version2::POSTURE_STAND, version2::POSTURE_REST,
        version2::POSTURE_SIT, version2::POSTURE_REST, version2::POSTURE_STAND}) {
    if (!taker.bench().robot().motorsPull()) {
      taker.bench().switchMotors(true);
    }
    taker.take(posture);
    EXPECT_EQ(taker.bench().robot().motorsPull(), posture != version2::POSTURE_REST);
    if (posture == version2::POSTURE_STAND) {
      expectStands(taker.bench().robot());
    }
  }
}

INSTANTIATE_TEST_SUITE_P(With, Postures, ::testing::Values(World{1.5, 0.8}, World{0.7, 0.4}, World{3, 1}));

// Somebody has bent the legs by hand; the robot stands up from whatever came of that, and walks.
TEST(OddPostures, AreLeftWithoutAFall) {
  std::minstd_rand random(7);
  const auto between = [&](double low, double high) {
    return low + (high - low) * static_cast<double>(random()) / std::minstd_rand::max();
  };
  int stood_up = 0;
  for (int i = 0; i < 6; ++i) {
    SCOPED_TRACE(i);
    PostureTaker taker;
    Bench& bench = taker.bench();
    bench.switchMotors(false);
    physics::JointAngles bent;
    for (const char* leg : {"left_front", "left_hind", "right_front", "right_hind"}) {
      bent[leg + std::string("_rotator")] = between(-90, 90);
      bent[leg + std::string("_elevator")] = between(0, 40);
      bent[leg + std::string("_knee")] = between(-10, 110);
    }
    bench.passFrame();
    bench.robot().place(bent);
    for (int frame = 0; frame < 250; ++frame) {
      bench.passFrame();
    }
    bench.switchMotors(true);
    for (int frame = 0; frame < 50; ++frame) {
      bench.passFrame();
    }
    bench.take(version2::POSTURE_STAND);
    bench.passFrame();
    if (!bench.errors().empty()) {  // it lies on its side, or on its shanks so that no paw is pressed
      EXPECT_THAT(bench.errors().back(), ContainsRegex("carried|on its side")) << "and nothing else keeps it down";
      continue;
    }
    taker.awaitArrival(version2::POSTURE_STAND);
    expectStands(bench.robot());
    ++stood_up;
  }
  EXPECT_GE(stood_up, 4);
}

}  // namespace
