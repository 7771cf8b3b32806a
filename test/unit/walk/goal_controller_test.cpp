// How a robot is steered to a goal.
#include "walk/goal_controller.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <random>

namespace aibo_driver::walk {
namespace {

using aibo_client::WalkVelocity;

/// Walks as it is steered, 0.2 s later, with the acceleration and the limits of the robot's gait.
class Walker {
 public:
  explicit Walker(const PlanePose& start = {}) : pose_(start) {}

  /// @return the seconds until it stands at the goal; 60 if it does not get there
  double walkTo(GoalController& way) {
    WalkVelocity wanted;
    for (double time = 0; time < 60; time += kStep) {
      if (std::fmod(time + 1e-9, 0.1) < kStep) {
        wanted = way.velocityAt(pose_);
        if (wanted.isZero()) {
          for (double rest = 0; rest < 1; rest += kStep) {
            pass({});  // it stops
          }
          return time;
        }
      }
      pass(wanted);
    }
    return 60;
  }

  const PlanePose& pose() const { return pose_; }
  double way() const { return way_; }

 private:
  static constexpr double kStep = 0.02;

  static void approach(double wanted, double most, double* value) {
    *value += std::clamp(std::clamp(wanted, -most, most) - *value, -2 * most * kStep, 2 * most * kStep);
  }

  void pass(const WalkVelocity& wanted) {
    delayed_.push_back(wanted);
    if (delayed_.size() > 10) {
      delayed_.pop_front();
    }
    approach(delayed_.front().forward, 0.15, &velocity_.forward);
    approach(delayed_.front().left, 0.06, &velocity_.left);
    approach(delayed_.front().turn, 1.2, &velocity_.turn);
    const PlanePose before = pose_;
    pose_ = inFrameOf(pose_, {velocity_.forward * kStep, velocity_.left * kStep, velocity_.turn * kStep});
    way_ += std::hypot(pose_.x - before.x, pose_.y - before.y);
  }

  PlanePose pose_;
  WalkVelocity velocity_;
  std::deque<WalkVelocity> delayed_;
  double way_ = 0;
};

TEST(GoalController, ArrivesWhereverTheGoalIs) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(-1.5, 1.5);
  std::uniform_real_distribution<double> angle(-3.14, 3.14);
  for (int i = 0; i < 200; ++i) {
    const PlanePose goal{place(random), place(random), angle(random)};
    Walker walker({place(random), place(random), angle(random)});
    GoalController way(goal);
    const double distance = way.distanceFrom(walker.pose());
    EXPECT_LT(walker.walkTo(way), 20 + 10 * distance) << goal.x << " " << goal.y << " " << goal.yaw;
    EXPECT_LT(way.distanceFrom(walker.pose()), 0.045);
    EXPECT_LT(std::abs(way.turnFrom(walker.pose())), 0.09);
    EXPECT_LT(walker.way(), 1.2 * distance + 0.1) << "it goes there straight";
  }
}

TEST(GoalController, ItTurnsTowardsTheGoalBeforeItWalks) {
  GoalController way({-1, 0.1, 0});
  const WalkVelocity velocity = way.velocityAt({});
  EXPECT_EQ(velocity.forward, 0);
  EXPECT_EQ(velocity.left, 0);
  EXPECT_GT(velocity.turn, 0.5);
  const WalkVelocity ahead = way.velocityAt({0, 0, 3});
  EXPECT_GT(ahead.forward, 0.1);
  EXPECT_EQ(way.velocityAt({0, 0, 2.3}).forward, 0);
  EXPECT_NEAR(way.velocityAt({-0.9, 0.1, 3.14159265}).forward, 0.08, 1e-6) << "it slows down before the place";
}

TEST(GoalController, APoseInTheFrameOfTheRobotIsRelativeToItsPose) {
  const PlanePose pose = inFrameOf({1, 2, 3.14159265 / 2}, {0.5, 0.1, 3});
  EXPECT_NEAR(pose.x, 0.9, 1e-6);
  EXPECT_NEAR(pose.y, 2.5, 1e-6);
  EXPECT_NEAR(pose.yaw, 3 + 3.14159265 / 2 - 2 * 3.14159265, 1e-6);
}

}  // namespace
}  // namespace aibo_driver::walk
