// Goals to walk to, as an action and as a topic, and postures as an action.

#include <aibo_driver/EndedMovement.h>
#include <aibo_driver/GoToAction.h>
#include <aibo_driver/MotionState.h>
#include <aibo_driver/TakePostureAction.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <geometry_msgs/PoseStamped.h>
#include <gmock/gmock.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "support/ros/goal_watch.h"
#include "support/ros/joint_messages.h"
#include "support/ros/joint_user.h"
#include "support/ros/motion_states.h"

namespace {

using aibo_driver::EndedMovement;
using aibo_driver::GoToAction;
using aibo_driver::MotionState;
using aibo_driver::Movement;
using aibo_driver::TakePostureAction;
using geometry_msgs::PoseStamped;
using nav_msgs::Odometry;
using std_srvs::Trigger;
using test_support::GoalWatch;
using test_support::JointUser;
using test_support::kSafetyNet;
using test_support::lastEnd;
using test_support::TopicListener;
using ::testing::HasSubstr;
using State = actionlib::TerminalState;
using Going = GoalWatch<GoToAction>;
using Taking = GoalWatch<TakePostureAction>;

PoseStamped poseAt(double x, double y = 0, double yaw = 0, const std::string& frame = "rex/odom") {
  PoseStamped pose;
  pose.header.frame_id = frame;
  pose.pose.position.x = x;
  pose.pose.position.y = y;
  pose.pose.orientation.z = std::sin(yaw / 2);
  pose.pose.orientation.w = std::cos(yaw / 2);
  return pose;
}

Going::Goal goalAt(double x, double y = 0, double yaw = 0, const std::string& frame = "rex/odom") {
  Going::Goal goal;
  goal.pose = poseAt(x, y, yaw, frame);
  return goal;
}

Taking::Goal postureOf(const std::string& posture) {
  Taking::Goal goal;
  goal.posture = posture;
  return goal;
}

class GoalUser : public JointUser {
 public:
  explicit GoalUser(const std::string& name_space, const std::vector<std::string>& robot_options = {})
      : JointUser(name_space, {"_stream_on_start:=false", "/tf:=" + name_space + "/tf"}, robot_options),
        go_to(name_space + "/go_to"),
        take_posture(name_space + "/take_posture"),
        odom(name_space + "/odom"),
        state(name_space + "/motion_state") {
    EXPECT_TRUE(go_to.waitForActionServerToStart(ros::Duration(60)));
    EXPECT_TRUE(take_posture.waitForActionServerToStart(ros::Duration(60)));
  }

  bool isAt(double x, double y, double yaw) {
    odom.clear();
    const auto is_there = [=](const Odometry& each) {
      const auto& pose = each.pose.pose;
      const double turn = std::remainder(2 * std::atan2(pose.orientation.z, pose.orientation.w) - yaw, 2 * M_PI);
      return std::hypot(pose.position.x - x, pose.position.y - y) < 0.05 && std::abs(turn) < 0.1;
    };
    return odom.waitFor(is_there) != nullptr;
  }

  // The motion state says the same as an action's result.
  template <typename ResultPtr>
  bool stateSays(const ResultPtr& result) {
    const auto is_it = [&result](const MotionState& each) {
      return each.movements.empty() && lastEnd(each).how == result->end && lastEnd(each).reason == result->message;
    };
    return state.waitFor(is_it) != nullptr;
  }

  // True if driver or robot has given a walk up because this computer held one of them up for half a second. They have
  // to, so a test that wants something else gives the goal again.
  static bool wasHeldUp(const Going& going) {
    const auto result = going.result();
    static const std::string kReasons[] = {"held up", "not said where it is for 0.5 s", "not steered for 500 ms"};
    return result && std::any_of(std::begin(kReasons), std::end(kReasons), [&result](const std::string& reason) {
             return result->message.find(reason) != std::string::npos;
           });
  }

  // Gives a goal that is ahead, and waits until the robot walks. Null if it does not.
  std::unique_ptr<Going> setOff(const Going::Goal& goal) {
    const auto walks = [](const Odometry& each) { return each.pose.pose.position.x > 0.1; };
    auto going = std::make_unique<Going>(go_to, goal);
    for (int second = 0; second < kSafetyNet.count(); ++second) {
      if (odom.waitFor(walks, std::chrono::seconds(1))) {
        return going;
      }
      if (wasHeldUp(*going)) {
        going = std::make_unique<Going>(go_to, goal);
      }
    }
    ADD_FAILURE() << (going->result() ? going->result()->message : "it does not walk");
    return nullptr;
  }

  // Whether the robot comes to a goal.
  bool goes(const Going::Goal& goal) {
    for (int attempt = 0; attempt < 5; ++attempt) {
      Going going(go_to, goal);
      const State::StateEnum end = going.waitForEnd();
      if (!wasHeldUp(going)) {
        EXPECT_EQ(end, State::SUCCEEDED) << (going.result() ? going.result()->message : "it does not end");
        return end == State::SUCCEEDED;
      }
    }
    return false;
  }

  Going::Client go_to;
  Taking::Client take_posture;
  TopicListener<Odometry> odom;
  TopicListener<MotionState> state;
};

TEST(Goal, TheRobotGoesToItAndToTheNext) {
  GoalUser user("/goes");
  Going there(user.go_to, goalAt(0.35, 0.1, 1.5));
  const auto feedback = there.waitForFeedback();
  ASSERT_TRUE(feedback);
  EXPECT_LT(feedback->distance, 0.4);
  EXPECT_EQ(there.waitForEnd(), State::SUCCEEDED);
  EXPECT_TRUE(there.result()->success);
  EXPECT_EQ(there.result()->end, EndedMovement::DONE);
  EXPECT_TRUE(user.isAt(0.35, 0.1, 1.5));
  Going next(user.go_to, goalAt(0.2, 0, 0, "rex/base_link"));
  EXPECT_EQ(next.waitForEnd(), State::SUCCEEDED);
  EXPECT_TRUE(user.isAt(0.35, 0.3, 1.5));
}

TEST(Goal, CancellingStopsTheRobotForTheReasonThatTheResultHas) {
  GoalUser user("/cancels");
  const auto there = user.setOff(goalAt(2, 0, 1));
  ASSERT_TRUE(there);
  const auto feedback = there->waitForFeedback();
  ASSERT_TRUE(feedback);
  EXPECT_GT(feedback->distance, 1.2);
  EXPECT_NEAR(feedback->turn, 1, 0.2);
  there->cancel();
  EXPECT_EQ(there->waitForEnd(), State::PREEMPTED);
  EXPECT_EQ(there->result()->end, EndedMovement::STOPPED);
  EXPECT_THAT(there->result()->message, HasSubstr("cancelled the goal"));
  EXPECT_TRUE(user.stateSays(there->result()));
}

TEST(Goal, ANewGoalOnTheTopicReplacesTheOneOfTheAction) {
  GoalUser user("/replaces");
  const auto there = user.setOff(goalAt(2));
  ASSERT_TRUE(there);
  user.publish("goal", poseAt(2));
  EXPECT_EQ(there->waitForEnd(), State::PREEMPTED);
  EXPECT_EQ(there->result()->end, EndedMovement::REPLACED);
  user.publish("goal", poseAt(0.6));  // replaces the one before it, too
  EXPECT_TRUE(user.state.waitFor([](const MotionState& each) {
    return !each.movements.empty() && each.movements[0].name.find("x 0.60") != std::string::npos;
  }));
  user.publish("goal", poseAt(5, 0, 0, "map"));  // is refused, and does not end the walk
  EXPECT_TRUE(user.isAt(0.6, 0, 0));
  EXPECT_TRUE(user.state.waitFor([](const MotionState& each) { return lastEnd(each).how == EndedMovement::DONE; }));
}

TEST(Goal, StopEndsItAndNothingResumesIt) {
  GoalUser user("/stops");
  const auto there = user.setOff(goalAt(2));
  ASSERT_TRUE(there);
  ASSERT_TRUE(user.call<Trigger>("stop").success);
  EXPECT_EQ(there->waitForEnd(), State::ABORTED);
  EXPECT_EQ(there->result()->end, EndedMovement::STOPPED);
  EXPECT_TRUE(user.stateSays(there->result()));
  Going refused(user.go_to, goalAt(2));
  EXPECT_EQ(refused.waitForEnd(), State::REJECTED);
  EXPECT_THAT(refused.result()->message, HasSubstr("call release"));
  ASSERT_TRUE(user.call<Trigger>("release").success);
  EXPECT_TRUE(user.goes(goalAt(0.1, 0, 0, "/rex/base_footprint"))) << "it goes to the new goal, not to the old one";
}

TEST(Goal, AnEdgeEndsItWithTheRobotsReason) {
  GoalUser user("/edge", {"--on-table"});
  Going there(user.go_to, goalAt(2));
  EXPECT_EQ(there.waitForEnd(), State::ABORTED);
  EXPECT_EQ(there.result()->end, EndedMovement::REFUSED);
  EXPECT_THAT(there.result()->message, HasSubstr("the floor ends ahead"));
  EXPECT_TRUE(user.stateSays(there.result()));
  EXPECT_TRUE(user.goes(goalAt(0.4))) << "it turns and goes back";
}

TEST(Goal, ARobotThatDoesNotSayWhereItIsStops) {
  GoalUser user("/unknown_place");
  const auto there = user.setOff(goalAt(2));
  ASSERT_TRUE(there);
  dynamic_reconfigure::Reconfigure::Request silence;
  silence.config.doubles.resize(1);
  silence.config.doubles[0].name = "telemetry_rate";
  user.call<dynamic_reconfigure::Reconfigure>("aibo_driver/set_parameters", silence);
  EXPECT_EQ(there->waitForEnd(), State::ABORTED);
  EXPECT_EQ(there->result()->end, EndedMovement::STOPPED);
  EXPECT_EQ(there->result()->message, "the robot has not said where it is for 0.5 s");
  Going refused(user.go_to, goalAt(2));
  EXPECT_EQ(refused.waitForEnd(), State::REJECTED);
  EXPECT_THAT(refused.result()->message, HasSubstr("there is no odometry"));
}

TEST(Goal, ABrokenConnectionEndsItForGood) {
  GoalUser user("/breaks");
  const auto there = user.setOff(goalAt(2));
  ASSERT_TRUE(there);
  user.reconnect();
  EXPECT_EQ(there->waitForEnd(), State::ABORTED);
  EXPECT_EQ(there->result()->end, EndedMovement::LOST);
  EXPECT_TRUE(user.stateSays(there->result()));
  EXPECT_TRUE(user.goes(goalAt(0.1, 0, 0, "rex/base_link")));
}

TEST(TakePosture, EndsWhenTheRobotHasTakenIt) {
  GoalUser user("/takes");
  Taking sits(user.take_posture, postureOf("sit"));
  EXPECT_EQ(sits.waitForEnd(), State::SUCCEEDED);
  EXPECT_EQ(sits.result()->end, EndedMovement::DONE);
  Taking stands(user.take_posture, postureOf("stand"));
  ASSERT_TRUE(stands.waitForFeedback());
  stands.cancel();
  EXPECT_EQ(stands.waitForEnd(), State::PREEMPTED);
  EXPECT_EQ(stands.result()->end, EndedMovement::STOPPED);
  EXPECT_TRUE(user.stateSays(stands.result()));
  sensor_msgs::JointState slow = test_support::command({{"head_pan", 0.5}});
  slow.velocity = {0.05};
  user.publish("joint_command", slow);
  ASSERT_TRUE(user.waitForPanBeyond(0.02));  // the robot has it, so the posture does not overrule it
  Taking again(user.take_posture, postureOf("stand"));
  ASSERT_TRUE(again.waitForFeedback());
  again.cancel();
  EXPECT_EQ(again.waitForEnd(), State::PREEMPTED);
  EXPECT_TRUE(user.waitForPanBeyond(0.15)) << "it ends nobody else's movement";
  Taking wrong(user.take_posture, postureOf("dance"));
  EXPECT_EQ(wrong.waitForEnd(), State::REJECTED);
  EXPECT_THAT(wrong.result()->message, HasSubstr("there are stand, sit and rest"));
  Taking rests(user.take_posture, postureOf("rest"));
  EXPECT_EQ(rests.waitForEnd(), State::SUCCEEDED);
}

}  // namespace
