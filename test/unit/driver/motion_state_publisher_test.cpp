#include "ros/joints/motion_state_publisher.h"

#include <gmock/gmock.h>

namespace aibo_driver::node {
namespace {

using movement::MovementEnd;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using Kind = movement::Movement::Kind;

const ros::Time kNow(1800000000, 0);
const JointMover::SteadyTime kSteadyNow{std::chrono::seconds(50)};

MotionState messageOf(const JointMover::State& state) {
  return toMessage(state, kSteadyNow, kNow);
}

TEST(MotionStateMessage, SaysThatNothingMoves) {
  const MotionState message = messageOf({});
  EXPECT_THAT(message.movements, IsEmpty());
  EXPECT_EQ(message.last.kind, Movement::NONE);
  EXPECT_EQ(message.text, "nothing moves the robot");
  EXPECT_EQ(message.header.stamp, kNow);
}

TEST(MotionStateMessage, NamesWhatMovesAndUntilWhen) {
  JointMover::State state;
  state.movements = {
      {Kind::kCommand, "", "/sliders", {"mouth"}, {}},
      {Kind::kTrajectory, "", "/planner", {"head_pan", "neck_tilt"}, kSteadyNow + std::chrono::seconds(2)},
      {Kind::kMotion, "NOD.MTN", "", {}, {}}};
  const MotionState message = messageOf(state);
  ASSERT_THAT(message.movements, SizeIs(3));
  EXPECT_EQ(message.movements[0].kind, Movement::COMMAND);
  EXPECT_EQ(message.movements[0].source, "/sliders");
  EXPECT_TRUE(message.movements[0].end.isZero());
  EXPECT_EQ(message.movements[1].kind, Movement::TRAJECTORY);
  EXPECT_THAT(message.movements[1].joints, ElementsAre("head_pan", "neck_tilt"));
  EXPECT_EQ(message.movements[1].end, kNow + ros::Duration(2));
  EXPECT_EQ(message.movements[2].name, "NOD.MTN");
  EXPECT_EQ(message.text, "moved by command of mouth and trajectory of head_pan, neck_tilt and motion NOD.MTN");
}

TEST(MotionStateMessage, SaysHowTheLastMovementEnded) {
  JointMover::State state;
  state.last =
      movement::EndedMovement{{Kind::kMotion, "NOD.MTN", "", {}, {}}, MovementEnd::kReplaced, "mouth was commanded"};
  MotionState message = messageOf(state);
  EXPECT_EQ(message.last.name, "NOD.MTN");
  EXPECT_EQ(message.last_end, MotionState::REPLACED);
  EXPECT_EQ(message.last_reason, "mouth was commanded");
  EXPECT_EQ(message.text, "nothing moves the robot; last ended: motion NOD.MTN: mouth was commanded");
  state.last = movement::EndedMovement{{Kind::kMotion, "NOD.MTN", "", {}, {}}, MovementEnd::kDone, ""};
  EXPECT_EQ(messageOf(state).text, "nothing moves the robot; last ended: motion NOD.MTN, done");
}

}  // namespace
}  // namespace aibo_driver::node
