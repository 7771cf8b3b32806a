// Goals to walk to, as an action and as a topic, and postures as an action.

#include <aibo_driver/EndedMovement.h>
#include <aibo_driver/GoToAction.h>
#include <aibo_driver/MotionState.h>
#include <aibo_driver/TakePostureAction.h>
#include <geometry_msgs/PoseStamped.h>
#include <gmock/gmock.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <iterator>
#include <memory>
#include <string>

#include "support/ros/goal_watch.h"
#include "support/ros/joint_user.h"
#include "support/ros/motion_states.h"

namespace {

using aibo_driver::EndedMovement;
using aibo_driver::GoToAction;
using aibo_driver::MotionState;
using aibo_driver::TakePostureAction;
using geometry_msgs::PoseStamped;
using nav_msgs::Odometry;
using test_support::GoalWatch;
using test_support::JointUser;
using test_support::kSafetyNet;
using test_support::lastEnd;
using test_support::TopicListener;
using State = actionlib::TerminalState;
using Going = GoalWatch<GoToAction>;
using Taking = GoalWatch<TakePostureAction>;

PoseStamped poseAt(double x, double y = 0, double yaw = 0) {
  PoseStamped pose;
  pose.header.frame_id = "rex/odom";
  pose.pose.position.x = x;
  pose.pose.position.y = y;
  pose.pose.orientation.z = std::sin(yaw / 2);
  pose.pose.orientation.w = std::cos(yaw / 2);
  return pose;
}

Going::Goal goalAt(double x, double y = 0, double yaw = 0) {
  Going::Goal goal;
  goal.pose = poseAt(x, y, yaw);
  return goal;
}

Taking::Goal postureOf(const std::string& posture) {
  Taking::Goal goal;
  goal.posture = posture;
  return goal;
}

class GoalUser : public JointUser {
 public:
  explicit GoalUser(const std::string& name_space)
      : JointUser(name_space, {"_stream_on_start:=false"}),
        go_to(name_space + "/go_to"),
        take_posture(name_space + "/take_posture"),
        odom(name_space + "/odom"),
        state(name_space + "/motion_state") {
    EXPECT_TRUE(go_to.waitForActionServerToStart(ros::Duration(60)));
    EXPECT_TRUE(take_posture.waitForActionServerToStart(ros::Duration(60)));
  }

  bool isAt(double x, double y, double yaw, std::chrono::seconds patience = kSafetyNet) {
    odom.clear();
    const auto is_there = [=](const Odometry& each) {
      const auto& pose = each.pose.pose;
      const double turn = std::remainder(2 * std::atan2(pose.orientation.z, pose.orientation.w) - yaw, 2 * M_PI);
      return std::hypot(pose.position.x - x, pose.position.y - y) < 0.05 && std::abs(turn) < 0.1;
    };
    return odom.waitFor(is_there, patience) != nullptr;
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

TEST(Goal, SucceedsWhenTheRobotIsThere) {
  GoalUser user("/goes");
  EXPECT_TRUE(user.goes(goalAt(0.35, 0.1, 1.5)));
  EXPECT_TRUE(user.isAt(0.35, 0.1, 1.5));
}

TEST(Goal, SaysWhatIsLeftAndIsPreemptedWhenItIsCancelled) {
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
  EXPECT_TRUE(user.state.waitFor([&there](const MotionState& each) {
    return each.movements.empty() && lastEnd(each).reason == there->result()->message;
  })) << "motion_state says the same";
}

TEST(Goal, OnTheTopicReplacesTheOneOfTheAction) {
  GoalUser user("/replaces");
  const auto there = user.setOff(goalAt(2));
  ASSERT_TRUE(there);
  EXPECT_TRUE(user.becomesTrue([&user] {
    user.publish("goal", poseAt(0.6));
    return user.isAt(0.6, 0, 0, std::chrono::seconds(15));
  }));
  EXPECT_EQ(there->waitForEnd(), State::PREEMPTED);
  EXPECT_EQ(there->result()->end, EndedMovement::REPLACED);
}

TEST(TakePosture, SucceedsWhenTheRobotHasTakenItAndIsPreemptedWhenItIsCancelled) {
  GoalUser user("/takes");
  const auto sits = Taking::begin(user.take_posture, postureOf("sit"));
  EXPECT_EQ(sits->waitForEnd(), State::SUCCEEDED);
  EXPECT_EQ(sits->result()->end, EndedMovement::DONE);
  const auto stands = Taking::begin(user.take_posture, postureOf("stand"));
  stands->cancel();
  EXPECT_EQ(stands->waitForEnd(), State::PREEMPTED);
  EXPECT_EQ(stands->result()->end, EndedMovement::STOPPED);
  Taking wrong(user.take_posture, postureOf("dance"));
  EXPECT_EQ(wrong.waitForEnd(), State::REJECTED);
}

}  // namespace
