#include "movement/joint_plan.h"

#include <gmock/gmock.h>

#include <cmath>
#include <optional>

#include "aibo_client/exceptions.h"

namespace aibo_driver::movement {

using aibo_client::EndedHow;

namespace {

using std::chrono::duration;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr int kPan = 2;
constexpr int kMouth = 4;
constexpr int kTailPan = 51;
constexpr double kLookahead = 0.096;

// Time is counted from 100 s on, because a measurement that was never made is from 0.
class JointPlanTest : public ::testing::Test {
 protected:
  JointPlanTest() {
    table_.setSpeedScale(0.5);
    measure(0);
  }

  static SteadyTime at(double seconds) {
    return SteadyTime() + std::chrono::duration_cast<SteadyTime::duration>(duration<double>(100 + seconds));
  }

  void measure(double time, double pan = 0, double mouth = -0.5) {
    aibo_client::Telemetry telemetry;
    telemetry.arrival = at(time);
    telemetry.joints = {{kPan, pan}, {kMouth, mouth}, {kTailPan, 0.2}};
    measured_.update(telemetry);
  }

  static TrajectoryRequest pan(const std::vector<TrajectoryRequest::Point>& points) { return {{"head_pan"}, points}; }
  static TrajectoryRequest both(double pan, double mouth, double time) {
    return {{"head_pan", "mouth"}, {{time, {pan, mouth}, {}}}};
  }

  MovementId add(const TrajectoryRequest& request, double start, double now, const Arrival& arrival = measured()) {
    plan_.add(++last_id_, request, arrival, at(start), at(now), std::chrono::milliseconds(300));
    advance(now);
    return last_id_;
  }

  static Arrival measured() {
    Arrival arrival;
    arrival.is_measured = true;
    return arrival;
  }

  MovementId command(const JointTargets& targets, double now) {
    plan_.command(++last_id_, targets, at(now));
    return last_id_;
  }

  // How a movement has ended; nothing while it goes on.
  std::optional<EndedHow> endOf(MovementId id) {
    for (const JointPlan::End& end : plan_.takeEnded()) {
      EXPECT_TRUE(ends_.emplace(end.id, end).second) << "a movement ends once";
    }
    const auto found = ends_.find(id);
    return found == ends_.end() ? std::nullopt : std::optional<EndedHow>(found->second.how);
  }

  std::string reasonOf(MovementId id) { return endOf(id) ? ends_.at(id).reason : "it goes on"; }

  std::string refusal(const TrajectoryRequest& request, double start, double now) {
    try {
      add(request, start, now);
    } catch (const aibo_client::InvalidArgumentException& error) {
      return error.what();
    }
    return "accepted";
  }

  void advance(double now) {
    std::map<int, double> sent;
    for (const JointStep& step : plan_.advance(at(now))) {
      EXPECT_LE(step.duration, JointPlan::kLookahead);
      for (const auto& [id, target] : step.targets) {
        const std::size_t joint = *table_.findById(id);
        EXPECT_EQ(target.id, id);
        EXPECT_EQ(target.speed, table_.speedLimit(joint));
        EXPECT_THAT(plan_.jointsOf(step.movement), testing::Contains(table_[joint].name));
        EXPECT_TRUE(sent.emplace(id, target.position).second) << "joint " << id << " is sent to two places";
        sent_[id] = target.position;
      }
    }
  }

  // As the driver does, from one time to another, with measurements.
  void run(double from, double to, double pan = 0) {
    for (double now = from; now <= to + 1e-9; now += 0.032) {
      measure(now, pan);
      advance(now);
    }
  }

  // The same with joints that are where they were sent.
  void follow(double from, double to) {
    for (double now = from; now <= to + 1e-9; now += 0.032) {
      measure(now, sent_.count(kPan) > 0 ? sent_[kPan] : 0, sent_.count(kMouth) > 0 ? sent_[kMouth] : -0.5);
      advance(now);
    }
  }

  double wanted(MovementId id, double now) { return plan_.wantedBy(id, at(now)).at(0).position; }
  double velocity(MovementId id, double now) { return plan_.wantedBy(id, at(now)).at(0).velocity; }

  JointTable table_{"ERS-7", 6.0};
  MeasuredJoints measured_{table_};
  JointPlan plan_{table_, measured_};
  std::map<int, double> sent_;  // where each joint was sent last
  std::map<MovementId, JointPlan::End> ends_;
  MovementId last_id_ = 40;
};

TEST_F(JointPlanTest, ANewTrajectoryTakesOverWithThePlannedPositionAndVelocity) {
  const auto first = add(pan({{2, {1}, {}}}), 0, 0);
  run(0, 1);
  EXPECT_NEAR(velocity(first, 1), 0.5, 1e-9);
  const auto second = add(pan({{1, {-0.2}, {0}}}), 1, 1);
  EXPECT_EQ(endOf(first), EndedHow::kReplaced);
  EXPECT_NEAR(wanted(second, 1), 0.5, 1e-6) << "not where it was measured, which is 0";
  EXPECT_NEAR(velocity(second, 1), 0.5, 1e-6);
  EXPECT_NEAR(wanted(second, 1.05), 0.5 + 0.05 * 0.5, 0.01) << "it goes on before it turns";
}

TEST_F(JointPlanTest, AFutureStartLeavesTheOldOneRunningUntilThen) {
  const auto old = add(pan({{4, {1}, {}}}), 0, 0);
  const auto later = add(pan({{1, {0}, {0}}}), 2, 0);
  run(0, 1.888);
  EXPECT_FALSE(endOf(old));
  EXPECT_NEAR(wanted(old, 1.888), 1.888 / 4, 1e-6);
  run(1.92, 1.984);
  EXPECT_EQ(endOf(old), EndedHow::kReplaced) << "what is sent ahead is the new one's";
  EXPECT_LE(sent_[kPan], 0.5 + 0.25 * kLookahead);
  EXPECT_THAT(plan_.wantedBy(later, at(1.984)), IsEmpty()) << "it has not begun";
  run(2.016, 2.016);
  EXPECT_NEAR(wanted(later, 2.016), 0.5 + 0.016 * 0.25, 1e-3);
  EXPECT_NEAR(velocity(later, 2.016), 0.25 - 4 * 0.016, 1e-3) << "a cubic that turns";
}

TEST_F(JointPlanTest, PassedPointsAreLeftOut) {
  const auto late = add(pan({{0.3, {0.4}, {}}, {0.6, {0.2}, {}}, {1.0, {-0.3}, {}}}), -0.5, 0);
  run(0, 0.096);
  EXPECT_NEAR(wanted(late, 0.05), 0.1, 1e-6) << "half of the way to the second point";
  run(0.128, 0.48);
  EXPECT_NEAR(sent_[kPan], -0.3, 1e-6);
  EXPECT_THAT(refusal(pan({{0.3, {0.4}, {}}}), -0.02, 0.48), HasSubstr("its last point was 0.200 s ago"));
}

TEST_F(JointPlanTest, ATrajectoryThatLosesAJointEndsAndItsOtherJointsStop) {
  const auto old = add(both(0.5, -0.2, 1), 0, 0);
  run(0, 0.192);
  const double mouth = sent_[kMouth];
  const auto head = add(pan({{0.5, {-0.2}, {}}}), 0.192, 0.192);
  EXPECT_EQ(endOf(old), EndedHow::kReplaced);
  EXPECT_EQ(reasonOf(old), "a newer trajectory moves its joints");
  follow(0.224, 1.1);
  EXPECT_EQ(sent_[kMouth], mouth);
  EXPECT_EQ(endOf(head), EndedHow::kDone);
}

TEST_F(JointPlanTest, ALaterStartTakesNothingFromWhatWaits) {
  const auto sooner = add(pan({{1, {0.5}, {}}}), 1, 0);
  const auto later = add(pan({{1, {0}, {}}}), 5, 0);
  EXPECT_NE(refusal(pan({{1, {9}, {}}}), 0.5, 0), "accepted");
  EXPECT_THAT(plan_.jointsOf(sooner), ElementsAre("head_pan")) << "nor does one that is refused";
  EXPECT_THAT(plan_.jointsOf(later), ElementsAre("head_pan"));
}

TEST_F(JointPlanTest, AnEarlierStartReplacesWhatWaitsOfItsJoints) {
  const auto later = add(both(0.5, -0.2, 1), 5, 0);
  const auto other = add({{"tail_pan"}, {{1, {0.1}, {}}}}, 5, 0);
  const auto sooner = add(pan({{1, {-0.2}, {}}}), 1, 0);
  EXPECT_EQ(endOf(later), EndedHow::kReplaced);
  const auto at_once = add(both(0.2, -0.4, 1), 0, 0);
  EXPECT_EQ(endOf(sooner), EndedHow::kReplaced);
  EXPECT_FALSE(endOf(other));
  follow(0.032, 1.2);
  EXPECT_EQ(endOf(at_once), EndedHow::kDone);
  EXPECT_NEAR(sent_[kPan], 0.2, 1e-9);
  EXPECT_NEAR(sent_[kMouth], -0.4, 1e-9);
}

TEST_F(JointPlanTest, AtMostTwoTrajectoriesOfAJointWait) {
  const auto head = [this](double start) { return refusal(pan({{1, {0}, {}}}), start, 0); };
  EXPECT_EQ(head(50), "accepted");
  EXPECT_EQ(head(51), "accepted");
  EXPECT_EQ(head(52), "2 trajectories of head_pan already wait for their start, and no more are accepted");
  EXPECT_THAT(refusal(both(0, -0.2, 1), 52, 0), HasSubstr("of head_pan already wait"));
  EXPECT_EQ(refusal({{"mouth"}, {{1, {-0.2}, {}}}}, 52, 0), "accepted");
  EXPECT_EQ(head(0), "accepted") << "what begins at once does not wait";
  EXPECT_EQ(head(60), "accepted");
  EXPECT_EQ(head(70), "accepted");
  EXPECT_EQ(head(65), "accepted") << "it replaces the one at 70";
  EXPECT_EQ(head(65), "accepted") << "also with the same start";
  EXPECT_THAT(head(70), HasSubstr("of head_pan already wait"));
}

TEST_F(JointPlanTest, AtMost32TrajectoriesWait) {
  aibo_client::Telemetry telemetry;
  telemetry.arrival = at(0);
  for (const JointProperties& joint : table_.joints()) {
    telemetry.joints.push_back({joint.id, joint.lowest});
  }
  measured_.update(telemetry);
  const auto wait = [this](std::size_t joint, double start) {
    return refusal({{table_[joint].name}, {{1, {table_[joint].lowest}, {}}}}, start, 0);
  };
  for (std::size_t i = 0; i < 32; ++i) {
    EXPECT_EQ(wait(i / 2, 10 + static_cast<double>(i)), "accepted");
  }
  EXPECT_EQ(wait(17, 50), "32 trajectories already wait for their start, and no more are accepted");
  EXPECT_EQ(wait(17, 0), "accepted") << "what begins at once does not wait";
  EXPECT_EQ(wait(0, 5), "accepted") << "it replaces two";
  EXPECT_EQ(wait(17, 50), "accepted");
}

TEST_F(JointPlanTest, SendsNoJointBeyondItsLimit) {
  add(pan({{1, {1.5364}, {}}}), 0, 0);
  run(0, 1);
  EXPECT_LE(sent_[kPan], 1.535891) << "88 degrees; somebody has rounded them";
}

TEST_F(JointPlanTest, ATrajectoryBeginsOnTheWayOfACommandWithItsVelocity) {
  const auto commanded = command({{kPan, {kPan, 1.0, 0.5}}}, 0);
  const auto fate = add(pan({{1, {1}, {0}}}), 0.2, 0.2);
  EXPECT_NEAR(wanted(fate, 0.2), 0.1, 1e-6);
  EXPECT_NEAR(velocity(fate, 0.2), 0.5, 1e-6);
  EXPECT_THAT(plan_.jointsOf(commanded), IsEmpty());
  command({{kMouth, {kMouth, -0.9, 0.5}}}, 0.2);
  EXPECT_NEAR(velocity(add({{"mouth"}, {{1, {-0.9}, {0}}}}, 0.3, 0.3), 0.3), -0.5, 1e-6);
}

TEST_F(JointPlanTest, ATrajectoryBeginsWhereTheJointIsLongAfterACommand) {
  command({{kPan, {kPan, 0.1, 1.0}}}, 0);
  measure(5, 0.4);
  EXPECT_NEAR(wanted(add(pan({{1, {1}, {0}}}), 5, 5), 5), 0.4, 1e-6) << "somebody has moved it by hand";
}

TEST_F(JointPlanTest, ATrajectoryThatCannotBeginWhenItsTimeComesSaysWhy) {
  const auto fate = add(pan({{1, {0.5}, {}}}), 2, 0);
  advance(1.95);
  EXPECT_EQ(endOf(fate), EndedHow::kRefused);
  EXPECT_THAT(reasonOf(fate), HasSubstr("was last measured"));
  EXPECT_THAT(sent_, IsEmpty());
  aibo_client::Telemetry only_pan;
  only_pan.arrival = at(2);
  only_pan.joints = {{kPan, 0}};
  measured_.update(only_pan);
  EXPECT_THAT(refusal(both(0.5, -0.2, 1), 2, 2), HasSubstr("mouth was last measured")) << "each joint counts";
}

TEST_F(JointPlanTest, AJointWhoseCommandWasStoppedIsNotOnItsWayAnyMore) {
  const auto commanded = command({{kPan, {kPan, 1.0, 0.5}}}, 0);
  plan_.forget(commanded);
  EXPECT_THAT(plan_.holdingTargets(at(1)), IsEmpty()) << "another stop does not move it on";
  measure(1, 0.1);
  EXPECT_NEAR(wanted(add(pan({{1, {0.3}, {}}}), 1, 1), 1), 0.1, 1e-6) << "it begins where it is";
}

TEST_F(JointPlanTest, SaysWhatMovesUntilItIsMeasuredWhereItWasSent) {
  const auto head = add(pan({{2, {1}, {}}}), 0, 0);
  EXPECT_NEAR(duration<double>(*plan_.endOf(head) - at(0)).count(), 2, 1e-6);
  follow(0, 1.95);
  EXPECT_THAT(plan_.jointsOf(head), ElementsAre("head_pan"));
  EXPECT_TRUE(plan_.goesOnAfter(head, EndedHow::kDone)) << "all is sent, but not measured";
  follow(1.984, 2.1);
  EXPECT_EQ(endOf(head), EndedHow::kDone);
  EXPECT_TRUE(plan_.empty());
}

TEST_F(JointPlanTest, DoesNotKnowTheEndOfWhatNobodyMeasures) {
  const auto head = add(pan({{0.1, {0.01}, {}}}), 0, 0);
  for (double now = 0; now < 6.5; now += 0.032) {
    advance(now);
    EXPECT_FALSE(now < 5 && endOf(head)) << "a version 1 server may be silent for so long";
  }
  EXPECT_EQ(endOf(head), EndedHow::kUnknown) << "it is near its target since before";
  EXPECT_EQ(reasonOf(head), "no measurement of head_pan has come since");
}

TEST_F(JointPlanTest, IsDoneWhereEachJointIsWithin50MilliradiansOfItsTarget) {
  for (const auto& [place, how] : {std::pair(0.44, EndedHow::kNotReached), {0.451, EndedHow::kDone}}) {
    const double start = place * 100;  // seconds, after the last one
    measure(start, place);
    const auto moved = add(pan({{0.1, {0.5}, {}}}), start, start);
    run(start, start + 2.08, place);
    EXPECT_TRUE(how == EndedHow::kDone || !endOf(moved)) << "it may need 2 s more than planned";
    run(start + 2.112, start + 2.2, place);
    EXPECT_EQ(endOf(moved), how) << place;
  }
}

TEST_F(JointPlanTest, KeepsToTheTolerancesAndTheGraceOfATrajectory) {
  Arrival strict = measured();
  strict.tolerances["head_pan"].position = 0.001;
  strict.grace = std::chrono::milliseconds(200);
  const auto followed = add(pan({{1, {0.5}, {}}}), 0, 0, strict);
  follow(0, 0.992);
  run(1.024, 1.3, 0.502);
  EXPECT_EQ(endOf(followed), EndedHow::kNotReached);
  Arrival loose = measured();
  loose.tolerances["mouth"].position = 10;
  measure(1.5, 0.5);
  const auto pan_too = add(both(0.2, -0.2, 0.3), 1.5, 1.5, loose);
  run(1.5, 4);
  EXPECT_EQ(reasonOf(pan_too), "head_pan is 0.20 rad from where it was sent") << "the other joint has its own";
  strict.tolerances["head_pan"] = {0.1, 0.2};
  for (const bool is_fast : {false, true}) {
    const double start = is_fast ? 10 : 5;
    measure(start, 0.17);
    const auto moving = add(pan({{1, {0.2}, {}}}), start, start, strict);
    for (double now = start; now < start + 1.5; now += 0.032) {
      measure(now, 0.15 + (is_fast ? std::fmod(now, 0.1) : (now - start) / 100));
      advance(now);
    }
    EXPECT_EQ(endOf(moving), is_fast ? EndedHow::kNotReached : EndedHow::kDone);
    EXPECT_THAT(reasonOf(moving), HasSubstr(is_fast ? "head_pan still moves with" : ""));
  }
}

TEST_F(JointPlanTest, GoesOnAsPlannedAfterAStallOfUpTo200Milliseconds) {
  for (const auto& [stall, lost] : {std::pair(0.19, 0.0), {0.21, 0.21 - 0.032}}) {
    const double start = 100 * stall;  // after the last one
    measure(start);
    const auto id = add(pan({{2, {1}, {}}}), start, start);
    run(start, start + 0.512);
    measure(start + 0.512 + stall);
    advance(start + 0.512 + stall);
    EXPECT_NEAR(duration<double>(*plan_.endOf(id) - at(start)).count(), 2 + lost, 1e-3) << stall;
    plan_.forget(id);
  }
}

}  // namespace
}  // namespace aibo_driver::movement
