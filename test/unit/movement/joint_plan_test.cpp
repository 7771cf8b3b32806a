#include "movement/joint_plan.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "aibo_driver/exceptions.h"

namespace aibo_driver::movement {
namespace {

using std::chrono::duration;
using std::chrono::duration_cast;
using std::chrono::milliseconds;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using SteadyTime = JointPlan::SteadyTime;

constexpr int kPan = 2;
constexpr int kMouth = 4;
constexpr double kLookahead = 0.096;

// Time is counted from 100 s on, because a measurement that was never made is from 0.
class JointPlanTest : public ::testing::Test {
 protected:
  JointPlanTest() { measure(0); }

  static SteadyTime at(double seconds) {
    return SteadyTime() + duration_cast<SteadyTime::duration>(duration<double>(100 + seconds));
  }

  void measure(double time, double pan = 0) {
    Telemetry telemetry;
    telemetry.arrival = at(time);
    telemetry.joints = {{kPan, pan}, {kMouth, -0.5}};
    measured_.update(telemetry);
  }

  static TrajectoryRequest pan(const std::vector<TrajectoryRequest::Point>& points) { return {{"head_pan"}, points}; }
  static TrajectoryRequest both(double pan, double mouth, double time) {
    return {{"head_pan", "mouth"}, {{time, {pan, mouth}, {}}}};
  }

  std::shared_ptr<const MovementFate> add(const TrajectoryRequest& request, double start, double now) {
    double stretch = 0;
    auto fate = plan_.add(request, "test", at(start), at(now), milliseconds(300), &stretch);
    advance(now);
    return fate;
  }

  std::string refusal(const TrajectoryRequest& request, double start, double now) {
    try {
      add(request, start, now);
    } catch (const InvalidArgumentException& error) {
      return error.what();
    }
    return "accepted";
  }

  void advance(double now) {
    std::map<int, double> sent;
    for (const JointStep& step : plan_.advance(at(now))) {
      for (const auto& [id, order] : step.orders) {
        EXPECT_TRUE(sent.emplace(id, order.position).second) << "joint " << id << " is sent to two places";
        sent_[id] = order.position;
      }
    }
  }

  // As the driver does, from one time to another, with measurements.
  void run(double from, double to) {
    for (double now = from; now <= to + 1e-9; now += 0.032) {
      measure(now);
      advance(now);
    }
  }

  double wanted(const MovementFate& fate, double now) { return plan_.wantedBy(fate, at(now)).at(0).position; }
  double velocity(const MovementFate& fate, double now) { return plan_.wantedBy(fate, at(now)).at(0).velocity; }

  JointTable table_{"ERS-7", 3.0};
  MeasuredJoints measured_{table_};
  JointPlan plan_{table_, measured_, false};
  std::map<int, double> sent_;  // where each joint was sent last
};

TEST_F(JointPlanTest, ANewTrajectoryTakesOverWithThePlannedPositionAndVelocity) {
  const auto first = add(pan({{2, {1}, {}}}), 0, 0);
  run(0, 1);
  EXPECT_NEAR(velocity(*first, 1), 0.5, 1e-9);
  const auto second = add(pan({{1, {-0.2}, {0}}}), 1, 1);
  EXPECT_EQ(first->end, MovementEnd::kReplaced);
  EXPECT_NEAR(wanted(*second, 1), 0.5, 1e-6) << "not where it was measured, which is 0";
  EXPECT_NEAR(velocity(*second, 1), 0.5, 1e-6);
  EXPECT_NEAR(wanted(*second, 1.05), 0.5 + 0.05 * 0.5, 0.01) << "it goes on before it turns";
}

TEST_F(JointPlanTest, TakesOverWithAVelocityAlsoWithoutVelocitiesInTheRequest) {
  add(pan({{2, {1}, {}}}), 0, 0);
  run(0, 1);
  const auto same = add(pan({{1, {1}, {}}}), 1, 1);
  EXPECT_NEAR(wanted(*same, 1.1), 0.55, 1e-6) << "the rest of the same line";
  const auto back = add(pan({{1, {0}, {}}}), 1, 1);
  EXPECT_NEAR(velocity(*back, 1), 0.5, 1e-6);
}

TEST_F(JointPlanTest, AFutureStartLeavesTheOldOneRunningUntilThen) {
  const auto old = add(pan({{4, {1}, {}}}), 0, 0);
  const auto later = add(pan({{1, {0}, {0}}}), 2, 0);
  run(0, 1.984);
  EXPECT_FALSE(old->end);
  EXPECT_NEAR(wanted(*old, 1.984), 1.984 / 4, 1e-6);
  EXPECT_LE(sent_[kPan], 0.5 + 0.25 * kLookahead) << "what is sent ahead is the new one's already";
  run(2.016, 2.016);
  EXPECT_EQ(old->end, MovementEnd::kReplaced);
  EXPECT_NEAR(wanted(*later, 2.016), 0.5 + 0.016 * 0.25, 1e-3);
  EXPECT_NEAR(velocity(*later, 2.016), 0.25 - 4 * 0.016, 1e-3) << "a cubic that turns";
}

TEST_F(JointPlanTest, WhatIsSentShortlyBeforeANewStartIsTheNewOnes) {
  add(pan({{1, {1}, {}}}), 0, 0);
  add(pan({{1, {0}, {0}}}), 0.5, 0);
  double highest = 0;
  for (double now = 0; now < 1; now += 0.032) {
    run(now, now);
    highest = std::max(highest, sent_[kPan]);
  }
  EXPECT_LT(highest, 0.5 + 0.08) << "a cubic from 0.5 rad at 1 rad/s back to 0 goes on to 0.574";
}

TEST_F(JointPlanTest, PassedPointsAreLeftOut) {
  const auto late = add(pan({{0.3, {0.4}, {}}, {0.6, {0.2}, {}}, {1.0, {-0.3}, {}}}), -0.5, 0);
  run(0, 0.096);
  EXPECT_NEAR(wanted(*late, 0.05), 0.1, 1e-6) << "half of the way to the second point";
  run(0.128, 0.48);
  EXPECT_NEAR(sent_[kPan], -0.3, 1e-6);
  EXPECT_THAT(refusal(pan({{0.3, {0.4}, {}}}), -0.02, 0.48), HasSubstr("its last point was 0.200 s ago"));
}

TEST_F(JointPlanTest, DisjointTrajectoriesRunSideBySide) {
  const auto head = add(pan({{1, {0.5}, {}}}), 0, 0);
  const auto mouth = add({{"mouth"}, {{1, {-0.2}, {}}}}, 0, 0);
  EXPECT_THAT(plan_.movements(at(0.1)), SizeIs(2));
  run(0, 1.1);
  EXPECT_EQ(head->end, MovementEnd::kDone);
  EXPECT_EQ(mouth->end, MovementEnd::kDone);
  EXPECT_NEAR(sent_[kPan], 0.5, 1e-9);
  EXPECT_NEAR(sent_[kMouth], -0.2, 1e-9);
  EXPECT_TRUE(plan_.empty());
}

TEST_F(JointPlanTest, ATrajectoryTakesOnlyTheJointsThatItNames) {
  const auto old = add(both(0.5, -0.2, 1), 0, 0);
  run(0, 0.192);
  plan_.takeEnded();
  const auto head = add(pan({{0.5, {-0.2}, {}}}), 0.192, 0.192);
  EXPECT_FALSE(old->end);
  EXPECT_TRUE(old->partly_replaced);
  const auto ended = plan_.takeEnded();
  ASSERT_THAT(ended, SizeIs(1));
  EXPECT_THAT(ended[0].movement.joints, ElementsAre("head_pan"));
  EXPECT_EQ(ended[0].how, MovementEnd::kReplaced);
  EXPECT_THAT(ended[0].reason, HasSubstr("goes on for mouth"));
  run(0.224, 1.1);
  EXPECT_EQ(old->end, MovementEnd::kDone);
  EXPECT_NEAR(sent_[kPan], -0.2, 1e-9);
  EXPECT_NEAR(sent_[kMouth], -0.2, 1e-9);
  EXPECT_EQ(head->end, MovementEnd::kDone);
}

TEST_F(JointPlanTest, AnEarlierStartReplacesWhatWaits) {
  const auto later = add(both(0.5, -0.2, 1), 5, 0);
  const auto sooner = add(pan({{1, {-0.2}, {}}}), 1, 0);
  EXPECT_FALSE(later->end);
  EXPECT_TRUE(later->partly_replaced);
  const auto at_once = add(both(0, -0.4, 1), 0, 0);
  EXPECT_EQ(later->end, MovementEnd::kReplaced);
  EXPECT_EQ(sooner->end, MovementEnd::kReplaced);
  EXPECT_FALSE(at_once->end);
}

TEST_F(JointPlanTest, ACommandEndsTheTrajectoriesOfItsJoint) {
  const auto running = add(both(0.5, -0.2, 1), 0, 0);
  const auto waiting = add(pan({{1, {0}, {}}}), 5, 0);
  const auto other = add({{"mouth"}, {{1, {-0.2}, {}}}}, 6, 0);
  plan_.command({{kPan, {0.2, 1.0}}}, "test", at(0.1));
  EXPECT_EQ(running->end, MovementEnd::kReplaced);
  EXPECT_EQ(running->reason, "head_pan was commanded to go elsewhere");
  EXPECT_EQ(waiting->end, MovementEnd::kReplaced);
  EXPECT_FALSE(other->end);
}

TEST_F(JointPlanTest, ATrajectoryBeginsOnTheWayOfACommandWithItsVelocity) {
  plan_.command({{kPan, {1.0, 0.5}}}, "test", at(0));
  const auto fate = add(pan({{1, {1}, {0}}}), 0.2, 0.2);
  EXPECT_NEAR(wanted(*fate, 0.2), 0.1, 1e-6);
  EXPECT_NEAR(velocity(*fate, 0.2), 0.5, 1e-6);
  const auto ended = plan_.takeEnded();
  ASSERT_THAT(ended, SizeIs(1));
  EXPECT_EQ(ended[0].movement.kind, Movement::Kind::kCommand);
  EXPECT_EQ(ended[0].how, MovementEnd::kReplaced);
}

TEST_F(JointPlanTest, ATrajectoryBeginsAtRestWhereACommandHasArrived) {
  plan_.command({{kPan, {0.1, 1.0}}}, "test", at(0));
  const auto fate = add(pan({{1, {1}, {0}}}), 0.15, 0.15);
  EXPECT_NEAR(wanted(*fate, 0.15), 0.1, 1e-6) << "not yet measured there";
  EXPECT_NEAR(velocity(*fate, 0.15), 0, 1e-6);
}

TEST_F(JointPlanTest, RefusesATrajectoryOfJointsThatWereNotMeasuredLately) {
  EXPECT_EQ(refusal(pan({{1, {0.5}, {}}}), 0.25, 0.25), "accepted");
  EXPECT_THAT(refusal(pan({{1, {0.5}, {}}}), 0.75, 0.75),
              AllOf(HasSubstr("head_pan was last measured 0.8 s ago"), HasSubstr("allowed is 0.3 s")));
}

TEST_F(JointPlanTest, ATrajectoryThatCannotBeginWhenItsTimeComesSaysWhy) {
  const auto fate = add(pan({{1, {0.5}, {}}}), 2, 0);
  advance(1.95);
  EXPECT_EQ(fate->end, MovementEnd::kRefused);
  EXPECT_THAT(fate->reason, HasSubstr("was last measured"));
  EXPECT_THAT(sent_, IsEmpty());
}

TEST_F(JointPlanTest, HoldsACommandedJointOnItsWay) {
  measure(0, 0.9);
  plan_.command({{kPan, {0.1, 0.5}}}, "test", at(0));
  measure(0.5, 0.88);
  EXPECT_NEAR(plan_.holdingOrders(at(0.5)).at(kPan).position, 0.65, 1e-6);
  EXPECT_NEAR(plan_.holdingOrders(at(0.5)).at(kPan).speed, 0.5, 1e-9);
  EXPECT_NEAR(plan_.holdingOrders(at(2)).at(kPan).position, 0.1, 1e-6) << "it may still wait for the link";
  EXPECT_THAT(plan_.holdingOrders(at(4)), IsEmpty());
}

TEST_F(JointPlanTest, ANewCommandBeginsWhereTheOldOneIs) {
  plan_.command({{kPan, {1.0, 1.0}}}, "test", at(0));
  plan_.command({{kPan, {0.0, 1.0}}}, "test", at(0.5));
  EXPECT_NEAR(plan_.holdingOrders(at(0.7)).at(kPan).position, 0.3, 1e-6);
}

TEST_F(JointPlanTest, HoldsAJointOfATrajectoryWhereItWasSent) {
  const auto head = add(pan({{1, {1}, {}}}), 0, 0);
  const auto mouth = add({{"mouth"}, {{1, {-0.2}, {}}}}, 0, 0);
  run(0, 0.32);
  const JointOrders orders = plan_.holdingOrders(at(0.34));
  EXPECT_NEAR(orders.at(kPan).position, sent_[kPan], 1e-9) << "not back to where it is";
  EXPECT_THAT(orders, SizeIs(2));
  EXPECT_THAT(plan_.holdingOrders(at(0.34), mouth.get()), SizeIs(1));
  EXPECT_THAT(plan_.jointsOf(*head), ElementsAre(kPan));
}

TEST_F(JointPlanTest, EndsAll) {
  const auto running = add(pan({{1, {1}, {}}}), 0, 0);
  const auto waiting = add(pan({{1, {1}, {}}}), 5, 0);
  plan_.command({{kMouth, {-0.1, 0.1}}}, "test", at(0));
  plan_.endAll(MovementEnd::kStopped, "stop was called");
  EXPECT_EQ(running->end, MovementEnd::kStopped);
  EXPECT_EQ(waiting->end, MovementEnd::kStopped);
  EXPECT_THAT(plan_.takeEnded(), SizeIs(3));
  EXPECT_TRUE(plan_.empty());
  EXPECT_THAT(plan_.advance(at(0.1)), IsEmpty());
  EXPECT_THAT(plan_.holdingOrders(at(0.1)), IsEmpty());
}

TEST_F(JointPlanTest, SaysWhatMoves) {
  EXPECT_THAT(plan_.movements(at(0)), IsEmpty());
  plan_.command({{kMouth, {-0.1, 0.4}}}, "user", at(0));
  add(pan({{2, {1}, {}}}), 0, 0);
  const std::vector<Movement> movements = plan_.movements(at(0.1));
  ASSERT_THAT(movements, SizeIs(2));
  EXPECT_EQ(movements[0].kind, Movement::Kind::kCommand);
  EXPECT_EQ(movements[0].source, "user");
  EXPECT_THAT(movements[0].joints, ElementsAre("mouth"));
  EXPECT_EQ(movements[1].kind, Movement::Kind::kTrajectory);
  EXPECT_NEAR(duration<double>(*movements[1].end - at(0)).count(), 2, 1e-6);
  run(0, 1.2);
  EXPECT_THAT(plan_.movements(at(1.2)), SizeIs(1)) << "the mouth has arrived";
  const auto ended = plan_.takeEnded();
  ASSERT_THAT(ended, SizeIs(1));
  EXPECT_EQ(ended[0].how, MovementEnd::kDone);
}

TEST_F(JointPlanTest, ResumesAfterAHoldUp) {
  const auto fate = add(pan({{2, {1}, {}}}), 0, 0);
  run(0, 0.512);
  measure(1.5);
  advance(1.5);
  EXPECT_NEAR(wanted(*fate, 1.5), 0.512 / 2 + 0.016, 0.002);
}

}  // namespace
}  // namespace aibo_driver::movement
