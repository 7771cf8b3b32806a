// Stopping the robot, trajectories that follow each other, and what is reported about all that moves.

#include <aibo_driver/MotionState.h>
#include <aibo_driver/PlayMotion.h>
#include <gmock/gmock.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <future>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "support/ros/joint_messages.h"
#include "support/ros/joint_user.h"
#include "support/ros/motion_states.h"

namespace {

using aibo_driver::EndedMovement;
using aibo_driver::MotionState;
using aibo_driver::Movement;
using aibo_driver::PlayMotion;
using sensor_msgs::JointState;
using std_srvs::Trigger;
using test_support::command;
using test_support::JointListener;
using test_support::JointUser;
using test_support::kQuick;
using test_support::kSafetyNet;
using test_support::lastEnd;
using test_support::Process;
using test_support::TopicListener;
using test_support::trajectory;
using ::testing::HasSubstr;
using ::testing::Not;
using trajectory_msgs::JointTrajectory;

// Without a slow approach, at 3 rad/s at most.
const std::vector<std::string> kFast{"_stream_on_start:=false", "_approach_speed:=20"};

JointState commandAtSpeed(const std::string& joint, double position, double speed) {
  JointState message = command({{joint, position}});
  message.velocity = {speed};
  return message;
}

PlayMotion::Response play(JointUser& user, const std::string& name, int repetitions = 1) {
  PlayMotion::Request request;
  request.name = name;
  request.repetitions = static_cast<std::uint16_t>(repetitions);
  return user.call<PlayMotion>("play_motion", request);
}

// What all servers have to do, with each version of the protocol.
class StopTest : public ::testing::TestWithParam<std::string> {
 protected:
  std::vector<std::string> options() { return {"--protocol-version", GetParam()}; }
  std::string nameSpace(const std::string& name) { return "/" + name + GetParam(); }

  // Positions of the head's pan in the next half second, and longer with a server that reports it once a second.
  static std::vector<double> watchPan(JointUser& user) {
    std::vector<double> positions;
    user.joints.messages().clear();
    user.joints.messages().waitForCount(45);
    for (const auto& message : user.joints.messages().waitForCount(1)) {
      if (const auto position = test_support::positionOf(*message, "head_pan")) {
        positions.push_back(*position);
      }
    }
    return positions;
  }
};

INSTANTIATE_TEST_SUITE_P(Versions, StopTest, ::testing::Values("1", "2"));

TEST_P(StopTest, HoldsASlowCommandAtOnce) {
  JointUser user(nameSpace("slow"), kFast, options());
  user.publish("joint_command", commandAtSpeed("head_pan", 1.0, 0.05));
  ASSERT_TRUE(user.waitForPanBeyond(0.03));
  user.publish("joint_trajectory", JointTrajectory());
  const std::vector<double> after = watchPan(user);
  ASSERT_FALSE(after.empty());
  EXPECT_LT(after.back(), 0.2);
  EXPECT_NEAR(after.back(), after[after.size() / 2], 0.01) << "it stands";
}

TEST_P(StopTest, HoldsACommandThatHasJustBeenSent) {
  JointUser user(nameSpace("just_sent"), kFast, options());
  user.publish("joint_command", commandAtSpeed("head_pan", 1.0, 0.1));
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  const auto answer = user.call<Trigger>("stop");
  EXPECT_TRUE(answer.success) << answer.message;
  EXPECT_LT(watchPan(user).back(), 0.3);
}

TEST_P(StopTest, DoesNotDriveAFastJointBackwards) {
  JointUser user(nameSpace("fast"), kFast, options());
  user.publish("joint_command", command({{"head_pan", -1.5}}));
  ASSERT_TRUE(user.joints.waitForPosition("head_pan", -1.5));
  user.publish("joint_command", command({{"head_pan", 1.5}}));
  ASSERT_TRUE(user.waitForPanBeyond(-1.3));
  user.call<Trigger>("stop");
  const std::vector<double> after = watchPan(user);
  double highest = -2;
  for (const double position : after) {
    EXPECT_GT(position, highest - JointListener::kTolerance);
    highest = std::max(highest, position);
  }
}

TEST_P(StopTest, DoesNotDriveATrajectoryBackwards) {
  JointUser user(nameSpace("trajectory"), kFast, options());
  user.publish("joint_trajectory", trajectory({{"head_pan", 1.4}}, 1.4));
  ASSERT_TRUE(user.waitForPanBeyond(0.1));
  user.publish("joint_trajectory", JointTrajectory());
  const std::vector<double> after = watchPan(user);
  EXPECT_GT(after.back(), 0.1);
  for (std::size_t i = 1; i < after.size(); ++i) {
    EXPECT_GT(after[i], after[i - 1] - JointListener::kTolerance);
  }
}

TEST_P(StopTest, EndsMotions) {
  JointUser user(nameSpace("nod"), kFast, options());
  const auto played = play(user, "nod", 100);
  ASSERT_TRUE(played.success) << played.message;
  user.joints.messages().clear();
  ASSERT_TRUE(user.joints.messages().waitFor(
      [](const JointState& state) { return test_support::speedOf(state, "neck_tilt").value_or(0) > 0.1; }));
  EXPECT_TRUE(user.call<Trigger>("stop").success);
  EXPECT_TRUE(user.joints.waitForSpeedBelow("neck_tilt", 0.03));
  const double first = user.joints.position("neck_tilt");
  user.joints.messages().clear();
  user.joints.messages().waitForCount(45);
  EXPECT_NEAR(user.joints.position("neck_tilt"), first, JointListener::kTolerance);
}

TEST(Stop, WaitsForNothingElse) {
  JointUser user("/urgent", kQuick);
  user.proxy.setMute(true);
  std::atomic<bool> played{false};
  const auto player = std::async(std::launch::async, [&] {
    play(user, "nod");
    played = true;
  });
  ASSERT_TRUE(user.proxy.waitForRequest("P", kSafetyNet));
  Trigger::Response answer;
  const auto stopper = std::async(std::launch::async, [&] { answer = user.call<Trigger>("stop"); });
  ASSERT_TRUE(user.proxy.waitForRequest("I", kSafetyNet));
  EXPECT_FALSE(played);
  user.proxy.setMute(false);
  player.wait();
  stopper.wait();
  EXPECT_TRUE(answer.success) << answer.message;
}

TEST(Motors, DoNotWaitBehindPlayMotion) {
  JointUser user("/motors_urgent", kQuick);
  user.proxy.setMute(true);
  std::atomic<bool> played{false};
  const auto player = std::async(std::launch::async, [&] {
    play(user, "nod");
    played = true;
  });
  ASSERT_TRUE(user.proxy.waitForRequest("P", kSafetyNet));
  const auto switcher = std::async(std::launch::async, [&] { user.setMotors(false); });
  EXPECT_TRUE(user.proxy.waitForRequest("O", kSafetyNet));
  const auto stopper = std::async(std::launch::async, [&] { user.call<Trigger>("stop"); });
  EXPECT_TRUE(user.proxy.waitForRequest("I", kSafetyNet)) << "nor does a stop wait behind them";
  EXPECT_FALSE(played);
  user.proxy.setMute(false);
  player.wait();
  switcher.wait();
  stopper.wait();
}

TEST(MotionStateTopic, SaysWhatMovesTheRobotAndHowItEnded) {
  JointUser user("/state", kQuick);
  TopicListener<MotionState> states("/state/motion_state");
  EXPECT_TRUE(states.waitFor([](const MotionState& state) { return state.movements.empty(); })) << "it is latched";
  user.publish("joint_trajectory", trajectory({{"head_pan", 0.5}}, 1.0));
  const auto moving = states.waitFor([](const MotionState& state) { return !state.movements.empty(); });
  ASSERT_TRUE(moving);
  EXPECT_EQ(moving->movements[0].kind, Movement::TRAJECTORY);
  EXPECT_EQ(moving->movements[0].source, ros::this_node::getName());
  EXPECT_GT(moving->movements[0].end, moving->header.stamp);
  EXPECT_LE((moving->movements[0].end - moving->header.stamp).toSec(), 1.05);
  EXPECT_TRUE(states.waitFor([](const MotionState& state) {
    return state.movements.empty() && lastEnd(state).movement.kind == Movement::TRAJECTORY &&
           lastEnd(state).how == EndedMovement::DONE;
  }));
  user.publish("joint_command", commandAtSpeed("head_pan", 0.0, 1.0));
  EXPECT_TRUE(states.waitFor([](const MotionState& state) {
    return !state.movements.empty() && state.movements[0].kind == Movement::COMMAND;
  }));
  EXPECT_TRUE(states.waitFor([](const MotionState& state) {
    return state.movements.empty() && lastEnd(state).movement.kind == Movement::COMMAND &&
           lastEnd(state).how == EndedMovement::DONE;
  }));
  EXPECT_LT(states.count(), 30u) << "only when something changes";
  EXPECT_THAT(user.driver.output(), Not(HasSubstr("ends early"))) << "what is done needs no warning";
}

// A message has eight ends, so the first ones are no longer in the last message.
TEST(MotionStateTopic, SaysEachEndOnceAndInOrder) {
  JointUser user("/ends", kQuick);
  TopicListener<MotionState> states("/ends/motion_state");
  ASSERT_TRUE(states.waitForNext());
  constexpr int kLast = 19;
  for (int i = 10; i <= kLast; ++i) {
    user.publish("joint_command", command({{"eye_" + std::to_string(i), 0}}));
  }
  const auto numberIn = [](const MotionState& state) {
    const std::string reason = lastEnd(state).reason;
    const std::size_t place = reason.find("eye_");
    return place == std::string::npos ? 0 : std::stoi(reason.substr(place + 4));
  };
  EXPECT_TRUE(states.waitFor([&](const MotionState& state) { return numberIn(state) == kLast; }));
  int before = 0;
  for (const auto& state : states.waitForCount(0)) {
    EXPECT_GE(numberIn(*state), before);
    before = numberIn(*state);
  }
}

TEST(MotionStateTopic, SaysAllEndsOfAStop) {
  JointUser user("/many_ends", kQuick);
  TopicListener<MotionState> states("/many_ends/motion_state");
  ASSERT_TRUE(states.waitForNext());
  std::set<std::string> moved{"head_pan"};
  for (const std::string leg : {"left_front", "left_hind", "right_front", "right_hind"}) {
    moved.insert({leg + "_rotator", leg + "_elevator"});
  }
  for (const std::string& joint : moved) {
    user.publish("joint_command", commandAtSpeed(joint, 1.2, 0.05));
  }
  ASSERT_TRUE(states.waitFor([&](const MotionState& state) { return state.movements.size() == moved.size(); }));
  EXPECT_TRUE(user.call<Trigger>("stop").success);
  std::set<std::string> ended;
  states.waitFor([&](const MotionState& state) {
    for (const EndedMovement& end : state.ended) {
      if (end.how == EndedMovement::STOPPED) {
        ended.insert(end.movement.joints.begin(), end.movement.joints.end());
      }
    }
    return ended == moved;
  });
  EXPECT_EQ(ended, moved) << "a message has eight";
}

TEST(MotionStateTopic, SaysThatACommandEndedAMotion) {
  JointUser user("/motion_lost", kQuick);
  TopicListener<MotionState> states("/motion_lost/motion_state");
  ASSERT_TRUE(play(user, "nod", 100).success);
  EXPECT_TRUE(states.waitFor(
      [](const MotionState& state) { return !state.movements.empty() && state.movements[0].name == "NOD.MTN"; }));
  user.publish("joint_command", command({{"neck_tilt", -0.1}}));
  const auto ended =
      states.waitFor([](const MotionState& state) { return lastEnd(state).movement.kind == Movement::MOTION; });
  ASSERT_TRUE(ended);
  EXPECT_EQ(lastEnd(*ended).movement.name, "NOD.MTN");
  EXPECT_EQ(lastEnd(*ended).how, EndedMovement::REPLACED);
  user.waitForWarning("motion NOD.MTN ends early");
}

TEST(LookAround, PausesWhileAnythingElseMovesTheRobot) {
  JointUser user("/look", kQuick);
  TopicListener<MotionState> states("/look/motion_state");
  Process look_around({AIBO_LOOK_AROUND, "__ns:=/look"});
  const auto looks_around = [](const MotionState& state) {
    return !state.movements.empty() && state.movements[0].source == "/look/aibo_look_around";
  };
  ASSERT_TRUE(states.waitFor(looks_around));
  user.publish("joint_command", commandAtSpeed("left_front_knee", 1.5, 0.1));
  const auto has_only_a_command = [](const MotionState& state) {
    return state.movements.size() == 1 && state.movements[0].kind == Movement::COMMAND;
  };
  ASSERT_TRUE(states.waitFor(has_only_a_command)) << "its glance ends, and no other begins";
  std::this_thread::sleep_for(std::chrono::milliseconds(500));
  states.clear();
  user.publish("joint_trajectory", JointTrajectory());
  EXPECT_TRUE(states.waitFor([](const MotionState& state) {
    return state.movements.size() == 1 && state.movements[0].kind == Movement::TRAJECTORY;
  })) << "then it goes on";
  user.publish("joint_command", command({{"head_pan", 0.3}}));
  ASSERT_TRUE(states.waitFor(has_only_a_command));
  ASSERT_TRUE(states.waitFor([](const MotionState& state) { return state.movements.empty(); }));
  states.clear();
  user.publish("joint_command", commandAtSpeed("left_front_knee", 0.5, 2));
  ASSERT_TRUE(states.waitFor(has_only_a_command));
  ASSERT_TRUE(states.waitFor([](const MotionState& state) { return state.movements.empty(); }));
  states.clear();
  const std::chrono::milliseconds longer_than_after_a_knee(1500);
  EXPECT_FALSE(states.waitFor(looks_around, longer_than_after_a_knee)) << "somebody has pointed the head";
}

}  // namespace
