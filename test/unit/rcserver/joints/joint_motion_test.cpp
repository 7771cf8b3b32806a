#include "rcserver/joints/JointMotion.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cstdlib>
#include <random>
#include <vector>

namespace {

using ::testing::ElementsAre;

JointMotion standingAt(int position, int step_limit, int acceleration) {
  JointMotion motion;
  motion.LimitStep(step_limit);
  motion.LimitAcceleration(acceleration);
  motion.Place(position);
  return motion;
}

void advance(JointMotion& motion, int frames = 1) {
  for (int i = 0; i < frames; ++i) {
    motion.Advance(motion.WantedStep());
  }
}

// The steps until the joint stands.
std::vector<int> stepsOf(JointMotion& motion) {
  std::vector<int> steps;
  while (motion.FramesLeft() > 0 && steps.size() < 100000) {
    advance(motion);
    steps.push_back(motion.Step());
  }
  return steps;
}

// The fewest frames for a distance, found by trying all possible motions. Only for small numbers.
int fewestFramesBySearch(int step, int distance, int step_limit, int acceleration, int frames) {
  std::vector<std::vector<int>> reachable{{0, step}};
  for (int frame = 0; frame <= frames; ++frame) {
    std::vector<std::vector<int>> next;
    for (const auto& state : reachable) {
      if (state[0] == distance && std::abs(state[1]) <= acceleration) {
        return frame;
      }
      for (int change = -acceleration; change <= acceleration; ++change) {
        const int new_step = state[1] + change;
        const bool brakes = std::abs(new_step) <= std::abs(state[1]) - acceleration;
        if (std::abs(new_step) <= step_limit || brakes) {
          next.push_back({state[0] + new_step, new_step});
        }
      }
    }
    std::sort(next.begin(), next.end());
    next.erase(std::unique(next.begin(), next.end()), next.end());
    reachable = next;
  }
  return -1;
}

TEST(JointMotion, StandsWhereItIsPlaced) {
  JointMotion motion = standingAt(-1234, 100, 10);
  EXPECT_EQ(motion.FramesLeft(), 0);
  advance(motion);
  EXPECT_EQ(motion.Position(), -1234);
  EXPECT_EQ(motion.Step(), 0);
}

// Wherever a motion before it was interrupted, and whatever was left of it.
TEST(JointMotion, MovesTheSameWayAsOneThatNeverMoved) {
  for (int frames = 1; frames < 60; ++frames) {
    SCOPED_TRACE(frames);
    JointMotion used = standingAt(0, 100, 7);
    used.Aim(1003);
    used.Delay(71);
    advance(used, frames);
    used.Place(50);
    EXPECT_EQ(used.Step(), 0);
    EXPECT_EQ(used.WantedStep(), 0);
    JointMotion fresh = standingAt(50, 100, 7);
    for (JointMotion* motion : {&used, &fresh}) {
      motion->Aim(-754);
      motion->Delay(59);
    }
    EXPECT_EQ(stepsOf(used), stepsOf(fresh));
  }
}

TEST(JointMotion, SpeedsUpCruisesAndBrakes) {
  JointMotion motion = standingAt(0, 30, 10);
  motion.Aim(150);
  EXPECT_EQ(motion.FramesLeft(), 7);
  EXPECT_THAT(stepsOf(motion), ElementsAre(10, 20, 30, 30, 30, 20, 10));
  EXPECT_EQ(motion.Position(), 150);
}

TEST(JointMotion, ReversesWithoutAJump) {
  JointMotion motion = standingAt(0, 30, 10);
  motion.Aim(960);
  advance(motion, 5);
  ASSERT_EQ(motion.Position(), 120);
  motion.Aim(0);
  EXPECT_THAT(stepsOf(motion), ElementsAre(20, 10, 0, -10, -20, -30, -30, -30, -20, -10));
  EXPECT_EQ(motion.Position(), 0);
}

TEST(JointMotion, ReturnsToATargetThatIsTooNearToStopAt) {
  JointMotion motion = standingAt(0, 30, 10);
  motion.Aim(960);
  advance(motion, 3);
  ASSERT_EQ(motion.Position(), 60);
  motion.Aim(70);
  EXPECT_THAT(stepsOf(motion), ElementsAre(20, 10, 0, -10, -10));
  EXPECT_EQ(motion.Position(), 70);
}

TEST(JointMotion, StopsAsFastAsItsAccelerationAllows) {
  JointMotion motion = standingAt(0, 35, 10);
  motion.Aim(1170);
  advance(motion, 4);
  ASSERT_EQ(motion.Step(), 35);
  motion.Stop(1);
  EXPECT_THAT(stepsOf(motion), ElementsAre(25, 15, 5));
}

TEST(JointMotion, StopsFasterIfItsAccelerationIsLowAndThenKeepsToItAgain) {
  JointMotion motion = standingAt(0, 35, 1);
  motion.Aim(10000);
  advance(motion, 40);
  ASSERT_EQ(motion.Step(), 35);
  motion.Stop(10);
  EXPECT_THAT(stepsOf(motion), ElementsAre(25, 15, 5));
  advance(motion);
  motion.Aim(motion.Position() + 3);
  EXPECT_THAT(stepsOf(motion), ElementsAre(1, 1, 1));
}

TEST(JointMotion, SpreadsASlowMotionEvenlyOverItsTime) {
  JointMotion motion = standingAt(0, 1000, 100);
  motion.Aim(500);
  motion.Delay(5000);
  for (int frame = 1; frame <= 5000; ++frame) {
    advance(motion);
    ASSERT_NEAR(motion.Position(), frame * 0.1, 2) << "frame " << frame;
  }
  EXPECT_EQ(motion.Position(), 500);
}

TEST(JointMotion, BrakesToALowerSpeedLimit) {
  JointMotion motion = standingAt(0, 30, 10);
  motion.Aim(300);
  advance(motion, 4);
  ASSERT_EQ(motion.Step(), 30);
  motion.LimitStep(5);
  advance(motion);
  EXPECT_EQ(motion.Step(), 20);
  advance(motion);
  EXPECT_EQ(motion.Step(), 10);
  advance(motion);
  EXPECT_EQ(motion.Step(), 5);
  stepsOf(motion);
  EXPECT_EQ(motion.Position(), 300);
}

TEST(JointMotion, AppliesALowerAccelerationWhenItStands) {
  JointMotion motion = standingAt(0, 30, 10);
  motion.Aim(150);
  advance(motion, 3);
  motion.LimitAcceleration(1);
  EXPECT_THAT(stepsOf(motion), ElementsAre(30, 30, 20, 10));
  advance(motion);
  motion.Aim(154);
  EXPECT_THAT(stepsOf(motion), ElementsAre(1, 2, 1));
}

TEST(JointMotion, TakesAHigherAccelerationAtTheNextTarget) {
  JointMotion motion = standingAt(0, 30, 1);
  motion.Aim(960);
  advance(motion);
  ASSERT_EQ(motion.Step(), 1);
  motion.LimitAcceleration(10);
  motion.Aim(147);
  EXPECT_THAT(stepsOf(motion), ElementsAre(11, 21, 28, 28, 28, 20, 10));
}

TEST(JointMotion, GivesThePositionsThatItPassesWhileItBrakes) {
  JointMotion motion = standingAt(0, 30, 10);
  motion.Aim(-960);
  advance(motion, 3);
  ASSERT_EQ(motion.Position(), -60);
  EXPECT_EQ(motion.BrakingSpan().low, -90);
  EXPECT_EQ(motion.BrakingSpan().high, -60);
  EXPECT_EQ(motion.BrakingStep(), -20);
  EXPECT_EQ(motion.SpanAfter(-20).low, -90);
  EXPECT_EQ(motion.SpanAfter(-20).high, -80);
  EXPECT_EQ(motion.SpanAfter(-30).low, -120);
  EXPECT_EQ(motion.SpanAfter(-30).high, -90);
}

TEST(JointMotion, ArrivesInTheFewestFramesPossible) {
  std::mt19937 random(2);
  const auto between = [&random](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  for (int round = 0; round < 300; ++round) {
    const int acceleration = between(1, 3);
    const int first_limit = between(1, 6);
    JointMotion motion = standingAt(0, first_limit, acceleration);
    motion.Aim(between(-20, 20));
    const int frames = between(0, 6);
    advance(motion, frames);
    const int limit = between(1, 6);
    const int distance = between(-15, 15);
    motion.LimitStep(limit);
    motion.Aim(motion.Position() + distance);
    EXPECT_EQ(motion.FramesLeft(), fewestFramesBySearch(motion.Step(), distance, limit, acceleration, 60))
        << "step " << motion.Step() << ", distance " << distance << ", limit " << limit << ", acceleration "
        << acceleration;
  }
}

TEST(JointMotion, ArrivesInExactlyTheNumberOfFramesGiven) {
  std::mt19937 random(3);
  const auto between = [&random](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  for (int round = 0; round < 2000; ++round) {
    JointMotion motion = standingAt(between(-2000000, 2000000), between(1, 120000), between(1, 20000));
    motion.Aim(between(-2000000, 2000000));
    const int frames = between(0, 50);
    advance(motion, frames);
    motion.Aim(between(-2000000, 2000000));
    if (motion.FramesLeft() > 2000) {
      continue;
    }
    const int due = motion.FramesLeft() + between(0, 1) * between(0, 500);
    motion.Delay(due);
    for (int i = 0; i < due; ++i) {
      advance(motion);
      ASSERT_EQ(motion.FramesLeft(), due - i - 1);
    }
    ASSERT_EQ(motion.Position(), motion.Target());
    advance(motion);
    ASSERT_EQ(motion.Step(), 0);
  }
}

}  // namespace
