#include "node/joints/motion_state_publisher.h"

#include <gmock/gmock.h>

namespace aibo_driver::node {
namespace {

using aibo_client::EndedHow;
using aibo_client::MotorState;
using aibo_client::PostureNow;
using Kind = movement::Movement::Kind;

const ros::Time kNow(1800000000, 0);
const movement::SteadyTime kSteadyNow{std::chrono::seconds(50)};

MotionState messageOf(const movement::Mover::State& state) {
  return toMessage(state, kSteadyNow, kNow);
}

TEST(MotionStateMessage, SaysThatNothingMoves) {
  const MotionState message = messageOf({});
  EXPECT_THAT(message.movements, testing::IsEmpty());
  EXPECT_THAT(message.ended, testing::IsEmpty());
  EXPECT_EQ(message.text, "nothing moves the robot");
  EXPECT_EQ(message.header.stamp, kNow);
}

TEST(MotionStateMessage, NamesWhatMovesAndUntilWhen) {
  movement::Mover::State state;
  state.movements = {
      {Kind::kCommand, "", "/sliders", {"mouth"}, {}, 42},
      {Kind::kTrajectory, "", "/planner", {"head_pan", "neck_tilt"}, kSteadyNow + std::chrono::seconds(2)},
      {Kind::kMotion, "NOD.MTN", "", {}, kSteadyNow - std::chrono::seconds(2)},
      {Kind::kWalk, "to x 1.00 m", "/navigator", {}, {}},
      {Kind::kWalk, "", "/teleop", {}, {}},
      {Kind::kPosture, "sit", "", {}, {}}};
  const MotionState message = messageOf(state);
  ASSERT_THAT(message.movements, testing::SizeIs(6));
  EXPECT_EQ(message.movements[0].order, 42U);
  EXPECT_EQ(message.movements[0].source, "/sliders");
  EXPECT_TRUE(message.movements[0].end.isZero());
  EXPECT_THAT(message.movements[1].joints, testing::ElementsAre("head_pan", "neck_tilt"));
  EXPECT_EQ(message.movements[1].end, kNow + ros::Duration(2));
  EXPECT_EQ(message.movements[2].name, "NOD.MTN");
  EXPECT_EQ(message.movements[2].end, kNow) << "nothing ends in the past";
  EXPECT_EQ(message.text,
            "moved by /sliders (command of mouth) and /planner (trajectory of head_pan, neck_tilt) and motion NOD.MTN "
            "and /navigator (walk to x 1.00 m) and /teleop (walk) and posture sit");
}

TEST(MotionStateMessage, SaysHowTheLatestMovementsEnded) {
  movement::Mover::State state;
  state.ended = {{{Kind::kMotion, "NOD.MTN", "", {}, {}}, EndedHow::kDone, ""}};
  EXPECT_EQ(messageOf(state).text, "nothing moves the robot; last ended: motion NOD.MTN, done");
  state.ended.push_back(
      {{Kind::kLookAt, "", "/look_at", {"head_pan"}, {}}, EndedHow::kNotReached, "head_pan is 0.50 rad off"});
  const MotionState message = messageOf(state);
  ASSERT_THAT(message.ended, testing::SizeIs(2));
  EXPECT_EQ(message.ended[1].movement.kind, Movement::LOOK_AT);
  EXPECT_EQ(message.ended[1].movement.source, "/look_at");
  EXPECT_EQ(message.ended[1].how, EndedMovement::NOT_REACHED);
  EXPECT_EQ(message.ended[1].reason, "head_pan is 0.50 rad off");
  EXPECT_EQ(message.text, "nothing moves the robot; last ended: look_at of head_pan: head_pan is 0.50 rad off");
}

TEST(MotionStateMessage, SeveralTellOfEndsThatDoNotFitIntoOne) {
  movement::Mover::State state;
  constexpr int kEnds = 20;
  for (int i = 0; i < kEnds; ++i) {
    state.ended.push_back({{Kind::kMotion, std::to_string(i), "", {}, {}}, EndedHow::kDone, ""});
  }
  for (const int fresh : {0, 1, 8, 9, 16, 17, kEnds}) {
    const auto messages = toMessages(state, static_cast<std::size_t>(fresh), kSteadyNow, kNow);
    EXPECT_THAT(messages, testing::SizeIs(std::max(1, (fresh + 7) / 8))) << fresh;
    std::set<std::string> told;
    for (const MotionState& message : messages) {
      EXPECT_THAT(message.ended, testing::SizeIs(kEndsInMessage)) << fresh;
      for (const EndedMovement& end : message.ended) {
        told.insert(end.movement.name);
      }
    }
    for (int i = kEnds - fresh; i < kEnds; ++i) {
      EXPECT_EQ(told.count(std::to_string(i)), 1U) << i << " of " << fresh;
    }
    EXPECT_EQ(messages.back().ended.back().movement.name, "19");
  }
}

// The numbers are the same on both sides.
TEST(MotionStateMessage, HasTheNumbersOfTheMessages) {
  EXPECT_EQ(static_cast<int>(Kind::kCommand), +Movement::COMMAND);
  EXPECT_EQ(static_cast<int>(Kind::kTrajectory), +Movement::TRAJECTORY);
  EXPECT_EQ(static_cast<int>(Kind::kMotion), +Movement::MOTION);
  EXPECT_EQ(static_cast<int>(Kind::kWalk), +Movement::WALK);
  EXPECT_EQ(static_cast<int>(Kind::kPosture), +Movement::POSTURE);
  EXPECT_EQ(static_cast<int>(Kind::kLookAt), +Movement::LOOK_AT);
  EXPECT_EQ(static_cast<int>(MotorState::kOff), +RobotState::OFF);
  EXPECT_EQ(static_cast<int>(MotorState::kOn), +RobotState::ON);
  EXPECT_EQ(static_cast<int>(PostureNow::kStanding), +RobotState::STANDING);
  EXPECT_EQ(static_cast<int>(PostureNow::kSitting), +RobotState::SITTING);
  EXPECT_EQ(static_cast<int>(PostureNow::kLying), +RobotState::LYING);
  EXPECT_EQ(static_cast<int>(PostureNow::kWalking), +RobotState::WALKING);
  EXPECT_EQ(static_cast<int>(PostureNow::kFallen), +RobotState::FALLEN);
  EXPECT_EQ(static_cast<int>(PostureNow::kCarried), +RobotState::CARRIED);
}

TEST(RobotStateMessage, SaysWhatTheRobotCanDo) {
  movement::Mover::State state;
  EXPECT_EQ(toMessage(state).motors, RobotState::UNKNOWN);
  EXPECT_FALSE(toMessage(state).stopped);
  state.robot = {MotorState::kOff, PostureNow::kLying};
  state.stopped_by = "/panel";
  const RobotState message = toMessage(state);
  EXPECT_EQ(message.motors, RobotState::OFF);
  EXPECT_EQ(message.posture, RobotState::LYING);
  EXPECT_TRUE(message.stopped);
  EXPECT_EQ(message.stopped_by, "/panel");
}

}  // namespace
}  // namespace aibo_driver::node
