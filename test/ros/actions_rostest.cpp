// The actions play_motion and follow_joint_trajectory.

#include <aibo_driver/EndedMovement.h>
#include <aibo_driver/PlayMotionAction.h>
#include <control_msgs/FollowJointTrajectoryAction.h>
#include <ros/callback_queue.h>
#include <std_srvs/Trigger.h>

#include <list>

#include "node/goal_server.h"
#include "ros/goal_watch.h"
#include "ros/joint_user.h"

namespace {

using aibo_driver::EndedMovement;
using aibo_driver::PlayMotionAction;
using control_msgs::FollowJointTrajectoryGoal;
using Result = control_msgs::FollowJointTrajectoryResult;
using test_support::JointUser;
using test_support::kQuick;
using test_support::trajectory;
using ::testing::HasSubstr;
using State = actionlib::TerminalState;

using PlayGoal = test_support::GoalWatch<PlayMotionAction>;
using FollowGoal = test_support::GoalWatch<control_msgs::FollowJointTrajectoryAction>;

class PlayUser : public JointUser {
 public:
  explicit PlayUser(const std::string& name_space, const std::vector<std::string>& parameters = kQuick,
                    const std::vector<std::string>& robot_options = {})
      : JointUser(name_space, parameters, robot_options), client(name_space + "/play_motion") {
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
  explicit FollowUser(const std::string& name_space)
      : JointUser(name_space, kQuick, {}, AIBO_DRIVER_NODE_WITH_ALL), client(name_space + "/follow_joint_trajectory") {
    EXPECT_TRUE(client.waitForActionServerToStart(ros::Duration(60)));
  }

  static FollowJointTrajectoryGoal goal(const test_support::Posture& posture, double seconds) {
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

TEST(PlayMotionGoal, SucceedsAtTheEndOfTheMotionAndTellsTheTimeMeanwhile) {
  PlayUser user("/play", {"_motion_speed_limit:=0.7"});
  const ros::SteadyTime begin = ros::SteadyTime::now();
  const auto goal = PlayGoal::begin(user.client, PlayUser::nod(0));  // it plays at least once
  EXPECT_GT(goal->waitForFeedback()->time.toSec(), 0);
  EXPECT_LE(goal->waitForFeedback()->time.toSec(), (ros::SteadyTime::now() - begin).toSec());
  ASSERT_EQ(goal->waitForEnd(), State::SUCCEEDED);
  EXPECT_TRUE(goal->result()->success);
  EXPECT_EQ(goal->result()->end, EndedMovement::DONE);
  EXPECT_THAT(goal->result()->message, HasSubstr("It was played to its end: 4 steps are too fast"));
}

TEST(PlayMotionGoal, IsRejectedIfTheMotionDoesNotBegin) {
  PlayUser user("/play_nothing");
  PlayGoal::Goal missing = PlayUser::nod(1);
  missing.name = "missing";
  PlayGoal goal(user.client, missing);
  EXPECT_EQ(goal.waitForEnd(), State::REJECTED);
  EXPECT_THAT(goal.result()->message, HasSubstr("Nothing was played: "));
}

TEST(PlayMotionGoal, SucceedsAtOnceWithAServerThatDoesNotReportTheEnd) {
  PlayUser user("/play1", kQuick, {"--protocol-version", "1"});
  EXPECT_TRUE(user.becomesTrue([&user] {
    PlayGoal goal(user.client, PlayUser::nod(100));
    return goal.waitForEnd() == State::SUCCEEDED && goal.result()->end == EndedMovement::UNKNOWN;
  }));
}

TEST(PlayMotionGoal, SaysHowTheMotionEndedEarly) {
  PlayUser user("/play_ended");
  const std::tuple<const char*, std::function<void(PlayGoal&)>, State::StateEnum, int> rows[] = {
      {"it is cancelled", [](PlayGoal& goal) { goal.cancel(); }, State::PREEMPTED, EndedMovement::STOPPED},
      {"a command to a joint of the motion",
       [&user](PlayGoal& goal) {
         user.becomesTrue([&] {
           user.publish("joint_command", test_support::command({{"neck_tilt", -0.1}}));
           std::this_thread::sleep_for(std::chrono::milliseconds(100));
           return goal.result() != nullptr;
         });
       },
       State::PREEMPTED, EndedMovement::REPLACED},
      {"a stop", [&](PlayGoal&) { user.call<std_srvs::Trigger>("stop"); }, State::ABORTED, EndedMovement::STOPPED},
      {"the connection is lost",
       [&](PlayGoal&) {
         user.proxy.setWelcome(test_support::Welcome::kRefuse);
         user.proxy.endConnections(test_support::Action::kReset);
       },
       State::ABORTED, EndedMovement::LOST},
  };
  for (const auto& [name, happen, state, how] : rows) {
    user.call<std_srvs::Trigger>("release");
    const auto goal = PlayGoal::begin(user.client, PlayUser::nod(100));
    happen(*goal);
    EXPECT_EQ(goal->waitForEnd(), state) << name;
    ASSERT_TRUE(goal->result()) << name;
    EXPECT_EQ(goal->result()->end, how) << name;
    EXPECT_NE(goal->result()->message, "") << name;
  }
}

// Each repetition wakes several of the driver's threads.
TEST(Actions, RepeatTheirStateEveryFiveSecondsOrAsOftenAsTheUserLikes) {
  ros::param::set("/all_quick/actionlib_status_frequency", 10.0);
  for (const auto& [name_space, expected] : {std::pair("/usual_actions", 0.2), {"/all_quick/actions", 10.0}}) {
    const PlayUser user(name_space);
    std::string name;
    double frequency = 0;
    EXPECT_TRUE(ros::param::search(name_space, "actionlib_status_frequency", name));
    EXPECT_TRUE(ros::param::get(name, frequency));
    EXPECT_EQ(frequency, expected) << name_space;
  }
}

TEST(Actions, RejectGoalsThatAreTooManyOrTooLong) {
  using Action = aibo_driver::node::GoalServer<PlayMotionAction>;
  ros::CallbackQueue queue;
  ros::NodeHandle handle("/bounded");
  handle.setCallbackQueue(&queue);
  ros::AsyncSpinner thread(1, &queue);
  aibo_driver::node::ActionKind<PlayMotionAction> kind;
  kind.name = "do";
  kind.begin = [](const auto&, const auto&) {
    const auto go_on = [](const auto& publish) {
      publish({});
      return std::optional<aibo_driver::node::GoalEnd<PlayMotionAction>>();
    };
    return aibo_driver::node::Activity<PlayMotionAction>{"", [](const auto&) {}, go_on};
  };
  kind.refuse = [](const std::exception& error) {
    aibo_driver::node::GoalEnd<PlayMotionAction> end;
    end.text = end.result.message = std::string("Nothing was done: ") + error.what();
    return end;
  };
  Action action(handle, kind);
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
  EXPECT_THAT(too_many.result()->message, HasSubstr("Nothing was done: 32 goals are already active"));
  thread.stop();
}

TEST(FollowGoal, IsFollowedWithFeedbackAndWithinTolerances) {
  FollowUser user("/follow");
  FollowJointTrajectoryGoal request =
      FollowUser::goal({{"head_pan", 0.5}, {"head_tilt", -0.2}, {"neck_tilt", -1.0}}, 1.0);
  request.goal_tolerance = {tolerance("head_pan", 0.03), tolerance("head_tilt", -1)};  // the neck is in its way
  request.path_tolerance = {tolerance("head_pan", 0), tolerance("neck_tilt", -1)};
  request.path_tolerance[0].acceleration = 1e-9;  // none of these counts
  const ros::SteadyTime begin = ros::SteadyTime::now();
  const auto goal = FollowGoal::begin(user.client, request);
  const auto feedback = goal->waitForFeedback();
  ASSERT_TRUE(feedback);
  ASSERT_THAT(feedback->joint_names, ::testing::ElementsAre("head_pan", "head_tilt", "neck_tilt"));
  const auto& [error, desired, actual] = std::tie(feedback->error, feedback->desired, feedback->actual);
  EXPECT_NEAR(error.positions.at(2), desired.positions.at(2) - actual.positions.at(2), 1e-9);
  EXPECT_NEAR(error.velocities.at(2), desired.velocities.at(2) - actual.velocities.at(2), 1e-9);
  ASSERT_EQ(goal->waitForEnd(), State::SUCCEEDED) << goal->result()->error_string;
  EXPECT_EQ(goal->result()->error_code, Result::SUCCESSFUL);
  EXPECT_LE(goal->feedbacks(), 20 * (ros::SteadyTime::now() - begin).toSec() + 2);
  EXPECT_NEAR(user.joints.position("head_pan"), 0.5, 0.05);
}

TEST(FollowGoal, ThatEndsEarlySaysHowAndItsOtherJointsHold) {
  FollowUser user("/follow_ended");
  std::unique_ptr<FollowGoal> newer;
  const std::tuple<const char*, std::function<void(FollowGoal&)>, State::StateEnum, int> rows[] = {
      {"a newer goal for one of its joints",
       [&](FollowGoal&) {
         newer = FollowGoal::begin(user.client, FollowUser::goal({{"head_pan", 0.0}}, 1.0));
       },
       State::PREEMPTED, Result::SUCCESSFUL},
      {"it is cancelled", [](FollowGoal& goal) { goal.cancel(); }, State::PREEMPTED, Result::SUCCESSFUL},
      {"a stop", [&](FollowGoal&) { user.call<std_srvs::Trigger>("stop"); }, State::ABORTED, Result::INVALID_GOAL},
  };
  for (const auto& [name, happen, state, code] : rows) {
    const auto goal = FollowGoal::begin(user.client, FollowUser::goal({{"head_pan", 1.4}, {"neck_tilt", -1.0}}, 14.0));
    happen(*goal);
    EXPECT_EQ(goal->waitForEnd(), state) << name;
    ASSERT_TRUE(goal->result()) << name;
    EXPECT_EQ(goal->result()->error_code, code) << name;
    EXPECT_TRUE(user.joints.waitForSpeedBelow("neck_tilt", 0.03)) << name;
    EXPECT_GT(user.joints.position("neck_tilt"), -0.9) << name;
  }
}

// What the tolerances mean is in the unit tests. The robot knows whole microradians, so it cannot arrive there.
TEST(FollowGoal, OutsideItsTolerancesIsAbortedWithItsCode) {
  FollowUser user("/follow_tolerances");
  FollowJointTrajectoryGoal path = FollowUser::goal({{"head_pan", 1.4}}, 7.0);
  path.path_tolerance = {tolerance("head_pan", 0.0001)};
  FollowJointTrajectoryGoal speed = FollowUser::goal({{"head_pan", -1.4}}, 7.0);
  speed.path_tolerance = {tolerance("head_pan", 0)};
  speed.path_tolerance[0].velocity = 0.0001;
  FollowJointTrajectoryGoal end = FollowUser::goal({{"head_pan", 0.5000005}}, 0.5);
  end.goal_tolerance = {tolerance("head_pan", 1e-9)};
  FollowJointTrajectoryGoal sooner = end;
  sooner.goal_time_tolerance = ros::Duration(0.7);
  const std::tuple<FollowJointTrajectoryGoal, int, double> rows[] = {
      {path, Result::PATH_TOLERANCE_VIOLATED, 0},
      {speed, Result::PATH_TOLERANCE_VIOLATED, 0},
      {end, Result::GOAL_TOLERANCE_VIOLATED, 0.5 + 2},
      {sooner, Result::GOAL_TOLERANCE_VIOLATED, 0.5 + 0.7},
  };
  for (const auto& [request, code, least_seconds] : rows) {
    const ros::SteadyTime begin = ros::SteadyTime::now();
    FollowGoal goal(user.client, request);
    ASSERT_EQ(goal.waitForEnd(), State::ABORTED);
    EXPECT_GT((ros::SteadyTime::now() - begin).toSec(), least_seconds - 0.1);
    EXPECT_EQ(goal.result()->error_code, code) << goal.result()->error_string;
  }
}

TEST(FollowGoal, ThatCannotBeFollowedIsRejectedWithItsCode) {
  FollowUser user("/follow_rejected");
  FollowJointTrajectoryGoal old = FollowUser::goal({{"head_pan", 1.0}}, 1.0);
  old.trajectory.header.stamp = ros::Time::now() - ros::Duration(10);
  FollowJointTrajectoryGoal other = FollowUser::goal({{"head_pan", 1.0}}, 1.0);
  other.path_tolerance = {tolerance("neck_tilt", 1)};
  const std::tuple<const char*, FollowJointTrajectoryGoal, int> rows[] = {
      {"an unknown joint", FollowUser::goal({{"third_leg", 1.0}}, 1.0), Result::INVALID_JOINTS},
      {"it is too old", old, Result::OLD_HEADER_TIMESTAMP},
      {"it is too fast", FollowUser::goal({{"head_pan", 1.0}}, 0.01), Result::INVALID_GOAL},
      {"a tolerance for a joint that it does not move", other, Result::INVALID_GOAL},
  };
  for (const auto& [name, request, code] : rows) {
    FollowGoal goal(user.client, request);
    EXPECT_EQ(goal.waitForEnd(), State::REJECTED) << name;
    ASSERT_TRUE(goal.result()) << name;
    EXPECT_EQ(goal.result()->error_code, code) << name;
  }
}

}  // namespace
