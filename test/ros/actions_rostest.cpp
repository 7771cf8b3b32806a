// The actions play_motion and follow_joint_trajectory.

#include <aibo_driver/EndedMovement.h>
#include <aibo_driver/MotionState.h>
#include <aibo_driver/PlayMotion.h>
#include <aibo_driver/PlayMotionAction.h>
#include <aibo_driver/RobotState.h>
#include <control_msgs/FollowJointTrajectoryAction.h>
#include <gmock/gmock.h>
#include <ros/callback_queue.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

#include <atomic>
#include <cstddef>
#include <list>
#include <optional>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "node/followed_action.h"
#include "support/ros/goal_watch.h"
#include "support/ros/joint_messages.h"
#include "support/ros/joint_user.h"
#include "support/ros/topic_listener.h"

namespace {

using aibo_driver::EndedMovement;
using aibo_driver::PlayMotionAction;
using aibo_driver::RobotState;
using control_msgs::FollowJointTrajectoryAction;
using control_msgs::FollowJointTrajectoryGoal;
using control_msgs::FollowJointTrajectoryResult;
using test_support::command;
using test_support::GoalWatch;
using test_support::JointListener;
using test_support::JointUser;
using test_support::kQuick;
using test_support::kSafetyNet;
using test_support::Posture;
using test_support::TopicListener;
using test_support::trajectory;
using ::testing::HasSubstr;
using State = actionlib::TerminalState;

using PlayGoal = GoalWatch<PlayMotionAction>;
using FollowGoal = GoalWatch<FollowJointTrajectoryAction>;

class PlayUser : public JointUser {
 public:
  explicit PlayUser(const std::string& name_space, const std::vector<std::string>& robot_options = {})
      : JointUser(name_space, kQuick, robot_options), client(name_space + "/play_motion") {
    EXPECT_TRUE(client.waitForActionServerToStart(ros::Duration(60)));
  }

  static PlayGoal::Goal nod(int repetitions) {
    PlayGoal::Goal goal;
    goal.name = "nod";
    goal.repetitions = static_cast<std::uint16_t>(repetitions);
    return goal;
  }

  PlayGoal::Client client;
};

class FollowUser : public JointUser {
 public:
  explicit FollowUser(const std::string& name_space, const std::vector<std::string>& robot_options = {})
      : JointUser(name_space, kQuick, robot_options, AIBO_DRIVER_NODE_WITH_ALL),
        client(name_space + "/follow_joint_trajectory") {
    EXPECT_TRUE(client.waitForActionServerToStart(ros::Duration(60)));
  }

  static FollowJointTrajectoryGoal goal(const Posture& posture, double seconds) {
    FollowJointTrajectoryGoal goal;
    goal.trajectory = trajectory(posture, seconds);
    return goal;
  }

  FollowGoal::Client client;
};

control_msgs::JointTolerance tolerance(const std::string& joint, double position) {
  control_msgs::JointTolerance tolerance;
  tolerance.name = joint;
  tolerance.position = position;
  return tolerance;
}

TEST(PlayMotionGoal, EndsWithTheMotion) {
  PlayUser user("/play");
  PlayGoal goal(user.client, PlayUser::nod(0));  // it plays at least once
  const auto feedback = goal.waitForFeedback();
  ASSERT_TRUE(feedback);
  EXPECT_LT(feedback->time, ros::Duration(30));
  ASSERT_EQ(goal.waitForEnd(), State::SUCCEEDED);
  EXPECT_TRUE(goal.result()->success);
  EXPECT_EQ(goal.result()->end, EndedMovement::DONE);
  EXPECT_EQ(goal.result()->message, "It was played to its end.");
  const ros::SteadyTime begin = ros::SteadyTime::now();
  PlayGoal next(user.client, PlayUser::nod(0));
  const auto feedback_of_next = next.waitForFeedback();
  ASSERT_TRUE(feedback_of_next);
  EXPECT_LE(feedback_of_next->time.toSec(), (ros::SteadyTime::now() - begin).toSec())
      << "the time of each goal begins at 0";
}

// Each repetition wakes several of the driver's threads.
TEST(Actions, RepeatTheirStateOnceASecondOrAsOftenAsTheUserLikes) {
  double frequency = 0;
  {
    const PlayUser user("/usual_actions");
    EXPECT_TRUE(ros::param::get("/usual_actions/actionlib_status_frequency", frequency));
    EXPECT_EQ(frequency, 1);
  }
  {
    ros::param::set("/all_quick/actionlib_status_frequency", 10.0);
    const PlayUser user("/all_quick/actions");
    EXPECT_FALSE(ros::param::has("/all_quick/actions/actionlib_status_frequency")) << "it would hide the user's";
  }
  ros::param::set("/quick_actions/actionlib_status_frequency", 10.0);
  const PlayUser user("/quick_actions");
  EXPECT_TRUE(ros::param::get("/quick_actions/actionlib_status_frequency", frequency));
  EXPECT_EQ(frequency, 10);
}

// The robot may have done it before it hears of the end, and what is cancelled may be impossible to stop.
TEST(Actions, FollowEachGoalToItsEndAndAGoalThatWasCancelledSucceedsIfItIsDoneAllTheSame) {
  using aibo_driver::node::ActionWay;
  using aibo_driver::node::Followed;
  using End = aibo_driver::node::GoalEnd<PlayMotionAction>;
  ros::CallbackQueue queue;
  ros::NodeHandle handle("/followed");
  handle.setCallbackQueue(&queue);
  ros::AsyncSpinner thread(1, &queue);
  std::atomic<End::State> state{};
  std::atomic<int> over{0};  // goals with at most this many repetitions are over
  std::atomic<bool> can_stop{true};
  ActionWay<PlayMotionAction> way;
  way.name = "do";
  way.begin = [&](const auto& goal, const auto&) {
    const auto stop = [&](const auto&) {
      over = 1;
      if (!can_stop) {
        throw std::runtime_error("it goes on");
      }
    };
    const auto look = [&, number = goal.repetitions](const auto& publish) -> std::optional<End> {
      if (number <= over) {
        return End{state, {}, ""};
      }
      publish({});
      return std::nullopt;
    };
    return Followed<PlayMotionAction>{"", stop, look};
  };
  aibo_driver::node::FollowedAction<PlayMotionAction> action(handle, way);
  thread.start();
  PlayGoal::Client client("/followed/do");
  ASSERT_TRUE(client.waitForActionServerToStart(ros::Duration(60)));
  for (const auto& [end, alone, cancelled] : {std::tuple(End::State::kSucceeded, State::SUCCEEDED, State::SUCCEEDED),
                                              std::tuple(End::State::kCanceled, State::PREEMPTED, State::PREEMPTED),
                                              std::tuple(End::State::kAborted, State::ABORTED, State::PREEMPTED)}) {
    state = end;
    over = 1;
    EXPECT_EQ(PlayGoal(client, PlayUser::nod(1)).waitForEnd(), alone);
    for (const bool stops : {true, false}) {
      can_stop = stops;
      over = 0;
      PlayGoal goal(client, PlayUser::nod(1));
      ASSERT_TRUE(goal.waitForFeedback());
      goal.cancel();
      EXPECT_EQ(goal.waitForEnd(), cancelled) << stops;
    }
  }
  over = 0;
  PlayGoal first(client, PlayUser::nod(1));
  PlayGoal second(client, PlayUser::nod(2));
  EXPECT_TRUE(first.waitForFeedback() && second.waitForFeedback());
  over = 1;
  EXPECT_EQ(first.waitForEnd(), State::ABORTED);
  over = 2;
  EXPECT_EQ(second.waitForEnd(), State::ABORTED);
  thread.stop();
}

TEST(Actions, RejectGoalsThatAreTooManyOrTooLong) {
  using Action = aibo_driver::node::FollowedAction<PlayMotionAction>;
  ros::CallbackQueue queue;
  ros::NodeHandle handle("/bounded");
  handle.setCallbackQueue(&queue);
  ros::AsyncSpinner thread(1, &queue);
  aibo_driver::node::ActionWay<PlayMotionAction> way;
  way.name = "do";
  way.begin = [](const auto&, const auto&) {
    const auto go_on = [](const auto& publish) {
      publish({});
      return std::optional<aibo_driver::node::GoalEnd<PlayMotionAction>>();
    };
    return aibo_driver::node::Followed<PlayMotionAction>{"", [](const auto&) {}, go_on};
  };
  way.refuse = aibo_driver::node::refuseWith<PlayMotionAction>("Nothing was done");
  Action action(handle, way);
  thread.start();
  PlayGoal::Client client("/bounded/do");
  ASSERT_TRUE(client.waitForActionServerToStart(ros::Duration(30)));
  PlayGoal::Goal long_name;
  long_name.name.assign(Action::kMostBytesOfGoal, 'x');
  PlayGoal too_long(client, long_name);
  ASSERT_EQ(too_long.waitForEnd(), State::REJECTED);
  EXPECT_THAT(too_long.result()->message, HasSubstr("at most 1048576 bytes are allowed"));
  std::list<PlayGoal> goals;
  for (std::size_t i = 0; i < Action::kMostGoals; ++i) {
    EXPECT_TRUE(goals.emplace_back(client, PlayUser::nod(1)).waitForFeedback()) << i;
  }
  PlayGoal too_many(client, PlayUser::nod(1));
  ASSERT_EQ(too_many.waitForEnd(), State::REJECTED);
  EXPECT_THAT(too_many.result()->message, HasSubstr("Nothing was done: 32 goals go on already"));
  thread.stop();
}

TEST(PlayMotionGoal, ThatIsCancelledStopsTheMotion) {
  PlayUser user("/play_cancelled");
  PlayGoal goal(user.client, PlayUser::nod(100));
  ASSERT_TRUE(goal.waitForFeedback());
  aibo_driver::PlayMotion::Request wag;
  wag.name = "wag";
  wag.repetitions = 100;
  ASSERT_TRUE(user.call<aibo_driver::PlayMotion>("play_motion", wag).success);
  goal.cancel();
  ASSERT_EQ(goal.waitForEnd(), State::PREEMPTED);
  EXPECT_EQ(goal.result()->end, EndedMovement::STOPPED);
  TopicListener<aibo_driver::MotionState> states("/play_cancelled/motion_state");
  EXPECT_TRUE(states.waitFor([](const aibo_driver::MotionState& state) {
    return !state.ended.empty() && state.ended.back().movement.name == "NOD.MTN" && state.movements.size() == 1;
  })) << "the other motion plays on";
}

TEST(PlayMotionGoal, SaysWhyTheMotionEndedEarly) {
  PlayUser user("/play_ended");
  PlayGoal goal(user.client, PlayUser::nod(100));
  ASSERT_TRUE(goal.waitForFeedback());
  user.publish("joint_command", command({{"neck_tilt", -0.1}}));
  ASSERT_EQ(goal.waitForEnd(), State::PREEMPTED);
  EXPECT_EQ(goal.result()->end, EndedMovement::REPLACED);
  EXPECT_THAT(goal.result()->message, HasSubstr("neck_tilt"));
}

TEST(PlayMotionGoal, ThatIsStoppedIsAborted) {
  PlayUser user("/play_stopped");
  PlayGoal goal(user.client, PlayUser::nod(100));
  ASSERT_TRUE(goal.waitForFeedback());
  EXPECT_TRUE(user.call<std_srvs::Trigger>("stop").success);
  ASSERT_EQ(goal.waitForEnd(), State::ABORTED);
  EXPECT_EQ(goal.result()->end, EndedMovement::STOPPED);
}

TEST(PlayMotionGoal, OfAMotionThatIsNotThereIsRejected) {
  PlayUser user("/play_rejected");
  PlayGoal::Goal request;
  request.name = "fly";
  PlayGoal goal(user.client, request);
  ASSERT_EQ(goal.waitForEnd(), State::REJECTED);
  EXPECT_THAT(goal.result()->message, HasSubstr("Nothing was played"));
  PlayGoal nameless(user.client, PlayGoal::Goal());
  ASSERT_EQ(nameless.waitForEnd(), State::REJECTED);
  EXPECT_THAT(nameless.result()->message, HasSubstr("give the name of a motion"));
}

TEST(PlayMotionGoal, OfAVersion1ServerSucceedsWhenItHasBegun) {
  PlayUser user("/play_1", {"--protocol-version", "1"});
  PlayGoal goal(user.client, PlayUser::nod(100));
  ASSERT_EQ(goal.waitForEnd(), State::SUCCEEDED);
  EXPECT_EQ(goal.result()->end, EndedMovement::UNKNOWN);
}

TEST(FollowGoal, IsFollowedWithFeedbackAndWithinTolerances) {
  FollowUser user("/follow");
  FollowJointTrajectoryGoal request = FollowUser::goal({{"head_pan", 0.5}, {"neck_tilt", -1.0}}, 1.0);
  request.path_tolerance = {tolerance("head_pan", 0.3)};
  request.goal_tolerance = {tolerance("head_pan", 0.03)};
  request.trajectory.header.stamp = ros::Time::now() + ros::Duration(1);
  FollowGoal goal(user.client, request);
  const auto feedback = goal.waitForFeedback();
  ASSERT_TRUE(feedback);
  ASSERT_THAT(feedback->joint_names, ::testing::ElementsAre("head_pan", "neck_tilt"));
  for (const std::size_t i : {0U, 1U}) {
    const auto& [error, desired, actual] = std::tie(feedback->error, feedback->desired, feedback->actual);
    EXPECT_NEAR(error.positions.at(i), desired.positions.at(i) - actual.positions.at(i), 1e-9);
    EXPECT_NEAR(error.velocities.at(i), desired.velocities.at(i) - actual.velocities.at(i), 1e-9);
  }
  EXPECT_LT(feedback->desired.velocities.at(1), -0.3) << "each joint has its own";
  EXPECT_NEAR(feedback->desired.velocities.at(0), 0.5, 0.05);
  EXPECT_GT(feedback->header.stamp, request.trajectory.header.stamp);
  ASSERT_EQ(goal.waitForEnd(), State::SUCCEEDED);
  EXPECT_EQ(goal.result()->error_code, FollowJointTrajectoryResult::SUCCESSFUL);
  EXPECT_NEAR(user.joints.position("head_pan"), 0.5, 0.05);
}

TEST(FollowGoal, ThatIsCancelledHoldsItsJoints) {
  for (const std::string version : {"1", "2"}) {
    FollowUser user("/follow_cancelled" + version, {"--protocol-version", version});
    FollowGoal goal(user.client, FollowUser::goal({{"head_pan", 1.4}}, 7.0));
    ASSERT_TRUE(user.waitForPanBeyond(0.1));
    goal.cancel();
    ASSERT_EQ(goal.waitForEnd(), State::PREEMPTED);
    EXPECT_EQ(goal.result()->error_code, FollowJointTrajectoryResult::SUCCESSFUL);
    EXPECT_EQ(goal.result()->error_string, "the goal was cancelled");
    EXPECT_TRUE(user.joints.waitForSpeedBelow("head_pan", 0.03));
    EXPECT_LT(user.joints.position("head_pan"), 1.0);
  }
}

TEST(FollowGoal, IsAbortedAndHoldsAllItsJointsIfOneLeavesItsPath) {
  FollowUser user("/follow_path");
  // The joint before it has no tolerance.
  FollowJointTrajectoryGoal request = FollowUser::goal({{"head_pan", 1.4}, {"neck_tilt", -1.0}}, 7.0);
  request.path_tolerance = {tolerance("neck_tilt", 0.0001)};
  FollowGoal goal(user.client, request);
  ASSERT_EQ(goal.waitForEnd(), State::ABORTED);
  EXPECT_EQ(goal.result()->error_code, FollowJointTrajectoryResult::PATH_TOLERANCE_VIOLATED);
  EXPECT_THAT(goal.result()->error_string, HasSubstr("neck_tilt is"));
  EXPECT_TRUE(user.joints.waitForSpeedBelow("head_pan", 0.03));
  EXPECT_LT(user.joints.position("head_pan"), 1.0);
}

TEST(FollowGoal, IsAbortedIfAJointDoesNotKeepItsSpeed) {
  FollowUser user("/follow_speed");
  user.robot.type("jam head_pan");
  FollowJointTrajectoryGoal request = FollowUser::goal({{"head_pan", 1.4}}, 1.0);
  request.path_tolerance = {tolerance("head_pan", 0)};
  request.path_tolerance[0].velocity = 1;
  FollowGoal goal(user.client, request);
  ASSERT_EQ(goal.waitForEnd(), State::ABORTED);
  EXPECT_EQ(goal.result()->error_code, FollowJointTrajectoryResult::PATH_TOLERANCE_VIOLATED);
  EXPECT_THAT(goal.result()->error_string,
              ::testing::ContainsRegex("head_pan is 1\\.[345].* rad/s from its speed; 1\\."));
}

TEST(FollowGoal, IsAbortedIfAJointDoesNotArrive) {
  FollowUser user("/follow_end");
  // The robot knows whole microradians, so it cannot arrive at this position.
  FollowJointTrajectoryGoal request = FollowUser::goal({{"head_pan", 0.5000005}}, 0.5);
  request.goal_tolerance = {tolerance("head_pan", 1e-9)};
  request.goal_time_tolerance = ros::Duration(0.7);
  const ros::WallTime begin = ros::WallTime::now();
  FollowGoal goal(user.client, request);
  ASSERT_EQ(goal.waitForEnd(), State::ABORTED);
  EXPECT_GT((ros::WallTime::now() - begin).toSec(), 1.2);
  EXPECT_EQ(goal.result()->error_code, FollowJointTrajectoryResult::GOAL_TOLERANCE_VIOLATED);
}

TEST(FollowGoal, IsAbortedIfAJointStillMovesAtItsEnd) {
  FollowUser user("/follow_moving");
  FollowJointTrajectoryGoal request;
  bool still_moves = false;
  for (int i = 0; i < 30 && !still_moves; ++i) {  // on a busy computer, the joint may stop before it is looked at
    request = FollowUser::goal({{"head_pan", i % 2 == 0 ? 0.5 : -0.5}}, 0.5);
    request.goal_tolerance = {tolerance("head_pan", -1)};
    request.goal_tolerance[0].velocity = 0.001;
    request.goal_time_tolerance = ros::Duration(0.001);
    FollowGoal goal(user.client, request);
    still_moves = goal.waitForEnd() == State::ABORTED &&
                  goal.result()->error_string.find("head_pan still moves with") != std::string::npos;
  }
  EXPECT_TRUE(still_moves);
}

TEST(FollowGoal, IsPreemptedByANewerOneForItsJointsOnly) {
  FollowUser user("/follow_two");
  FollowGoal head(user.client, FollowUser::goal({{"head_pan", 1.0}}, 4.0));
  FollowGoal knee(user.client, FollowUser::goal({{"left_front_knee", 0.5}}, 1.0));
  ASSERT_TRUE(user.waitForPanBeyond(0.1));
  FollowGoal back(user.client, FollowUser::goal({{"head_pan", 0.0}}, 1.0));
  EXPECT_EQ(head.waitForEnd(), State::PREEMPTED);
  EXPECT_EQ(back.waitForEnd(), State::SUCCEEDED);
  EXPECT_EQ(knee.waitForEnd(), State::SUCCEEDED);
}

TEST(FollowGoal, ThatIsCancelledLeavesTheOthersAlone) {
  FollowUser user("/follow_one");
  FollowGoal head(user.client, FollowUser::goal({{"head_pan", 0.5}}, 2.0));
  FollowGoal knee(user.client, FollowUser::goal({{"left_front_knee", 0.5}}, 2.0));
  ASSERT_TRUE(knee.waitForFeedback());
  knee.cancel();
  EXPECT_EQ(knee.waitForEnd(), State::PREEMPTED);
  EXPECT_EQ(head.waitForEnd(), State::SUCCEEDED);
}

TEST(FollowGoal, IsPreemptedByANewerOneForOneOfItsJoints) {
  FollowUser user("/follow_part");
  FollowGoal both(user.client, FollowUser::goal({{"head_pan", 1.0}, {"left_front_knee", 1.0}}, 4.0));
  ASSERT_TRUE(user.waitForPanBeyond(0.1));
  FollowGoal back(user.client, FollowUser::goal({{"head_pan", 0.0}}, 1.0));
  ASSERT_EQ(both.waitForEnd(), State::PREEMPTED);
  EXPECT_EQ(both.result()->error_string, "a newer trajectory moves some of its joints");
  EXPECT_EQ(back.waitForEnd(), State::SUCCEEDED);
}

TEST(FollowGoal, ThatCannotBeFollowedIsRejectedWithItsCode) {
  FollowUser user("/follow_rejected");
  FollowGoal unknown(user.client, FollowUser::goal({{"third_leg", 1.0}}, 1.0));
  ASSERT_EQ(unknown.waitForEnd(), State::REJECTED);
  EXPECT_EQ(unknown.result()->error_code, FollowJointTrajectoryResult::INVALID_JOINTS);
  FollowJointTrajectoryGoal many = FollowUser::goal({}, 1.0);
  many.trajectory.joint_names.assign(1001, "head_pan");
  many.trajectory.points[0].positions.assign(1001, 1.0);
  FollowGoal long_one(user.client, many);
  ASSERT_EQ(long_one.waitForEnd(), State::REJECTED);
  EXPECT_EQ(long_one.result()->error_code, FollowJointTrajectoryResult::INVALID_JOINTS);
  EXPECT_THAT(long_one.result()->error_string, HasSubstr("at most 1000 names are allowed"));
  FollowJointTrajectoryGoal old = FollowUser::goal({{"head_pan", 1.0}}, 1.0);
  old.trajectory.header.stamp = ros::Time::now() - ros::Duration(10);
  FollowGoal late(user.client, old);
  ASSERT_EQ(late.waitForEnd(), State::REJECTED);
  EXPECT_EQ(late.result()->error_code, FollowJointTrajectoryResult::OLD_HEADER_TIMESTAMP);
  FollowGoal fast(user.client, FollowUser::goal({{"head_pan", 1.0}}, 0.01));
  ASSERT_EQ(fast.waitForEnd(), State::REJECTED);
  EXPECT_EQ(fast.result()->error_code, FollowJointTrajectoryResult::INVALID_GOAL);
  for (const auto tolerances :
       {&FollowJointTrajectoryGoal::path_tolerance, &FollowJointTrajectoryGoal::goal_tolerance}) {
    FollowJointTrajectoryGoal request = FollowUser::goal({{"head_pan", 1.0}}, 1.0);
    request.*tolerances = {tolerance("head_pan", 1), tolerance("neck_tilt", 1)};
    FollowGoal other(user.client, request);
    ASSERT_EQ(other.waitForEnd(), State::REJECTED);
    EXPECT_EQ(other.result()->error_code, FollowJointTrajectoryResult::INVALID_GOAL);
    EXPECT_EQ(other.result()->error_string, "it has a tolerance for neck_tilt, which it does not move");
  }
}

TEST(FollowGoal, OfAJointThatDoesNotMoveFails) {
  FollowUser user("/follow_jammed");
  user.robot.type("jam head_pan");
  FollowJointTrajectoryGoal request = FollowUser::goal({{"head_pan", 0.8}}, 1.0);
  request.goal_tolerance = {tolerance("head_pan", 0)};  // the usual one
  const ros::WallTime begin = ros::WallTime::now();
  FollowGoal goal(user.client, request);
  ASSERT_EQ(goal.waitForEnd(), State::ABORTED);
  EXPECT_GT((ros::WallTime::now() - begin).toSec(), 3) << "a joint has two seconds more to arrive";
  EXPECT_EQ(goal.result()->error_code, FollowJointTrajectoryResult::GOAL_TOLERANCE_VIOLATED);
  EXPECT_THAT(goal.result()->error_string, HasSubstr("head_pan"));
  request.goal_tolerance = {tolerance("head_pan", -1)};  // none
  request.goal_tolerance[0].velocity = -1;
  request.path_tolerance = request.goal_tolerance;
  FollowGoal anywhere(user.client, request);
  EXPECT_EQ(anywhere.waitForEnd(), State::SUCCEEDED);
}

TEST(FollowGoal, WithoutMotorsFails) {
  FollowUser user("/follow_limp");
  EXPECT_TRUE(user.setMotors(false).success);
  FollowGoal goal(user.client, FollowUser::goal({{"head_pan", 0.8}}, 1.0));
  ASSERT_THAT(goal.waitForEnd(), ::testing::AnyOf(State::ABORTED, State::REJECTED)) << "the robot may be quick";
  EXPECT_THAT(goal.result()->error_string, HasSubstr("motors are off"));
}

TEST(FollowGoal, IsAbortedByStopAndTheNextOneWithTheConnection) {
  FollowUser user("/follow_stopped");
  FollowGoal goal(user.client, FollowUser::goal({{"head_pan", 1.0}}, 4.0));
  ASSERT_TRUE(goal.waitForFeedback());
  EXPECT_TRUE(user.call<std_srvs::Trigger>("stop").success);
  ASSERT_EQ(goal.waitForEnd(), State::ABORTED);
  EXPECT_EQ(goal.result()->error_code, FollowJointTrajectoryResult::INVALID_GOAL);
  EXPECT_THAT(goal.result()->error_string, HasSubstr("called stop"));
  EXPECT_TRUE(user.call<std_srvs::Trigger>("release").success);
  FollowGoal next(user.client, FollowUser::goal({{"head_pan", 1.0}}, 14.0));
  ASSERT_TRUE(next.waitForFeedback());
  user.robot.kill();
  ASSERT_EQ(next.waitForEnd(), State::ABORTED);
  EXPECT_EQ(next.result()->error_code, FollowJointTrajectoryResult::INVALID_GOAL);
  EXPECT_THAT(next.result()->error_string, HasSubstr("connection to the robot was lost"));
  const auto is_unknown = [](const RobotState& each) { return each.motors == RobotState::UNKNOWN; };
  EXPECT_TRUE(TopicListener<RobotState>("/follow_stopped/robot_state").waitFor(is_unknown)) << "it is latched";
}

}  // namespace
