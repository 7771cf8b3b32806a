// Walking by cmd_vel and to goals, the odometry, and postures as an action.

#include <aibo_driver/EndedMovement.h>
#include <aibo_driver/GoToAction.h>
#include <aibo_driver/TakePostureAction.h>
#include <nav_msgs/Odometry.h>
#include <std_srvs/Trigger.h>
#include <tf2_msgs/TFMessage.h>

#include <cmath>

#include "protocol/big_endian.h"
#include "ros/goal_watch.h"
#include "ros/joint_user.h"

namespace {

using aibo_driver::EndedMovement;
using aibo_driver::MotionState;
using aibo_driver::Movement;
using nav_msgs::Odometry;
using test_support::JointUser;
using test_support::lastEnd;
using test_support::TopicListener;
using State = actionlib::TerminalState;
using Going = test_support::GoalWatch<aibo_driver::GoToAction>;
using Taking = test_support::GoalWatch<aibo_driver::TakePostureAction>;

// Parameters of a driver in whose namespace tf is, because all tests share a master.
std::vector<std::string> quickWith(const std::string& name_space, std::vector<std::string> more = {}) {
  more.insert(more.end(), test_support::kQuick.begin(), test_support::kQuick.end());
  more.push_back("/tf:=" + name_space + "/tf");
  return more;
}

bool moves(const MotionState& state, int kind) {
  return std::any_of(state.movements.begin(), state.movements.end(),
                     [kind](const Movement& movement) { return movement.kind == kind; });
}

// A robot, its driver, and somebody who can steer it.
class Walker : public JointUser {
 public:
  explicit Walker(const std::string& name_space, const std::vector<std::string>& parameters = {},
                  const std::vector<std::string>& robot_options = {})
      : JointUser(name_space, quickWith(name_space, parameters), robot_options),
        odom(name_space + "/odom"),
        state(name_space + "/motion_state") {}

  // How the walk has ended.
  MotionState::ConstPtr waitForEnd() {
    return state.waitFor([](const MotionState& each) {
      return !moves(each, Movement::WALK) && lastEnd(each).movement.kind == Movement::WALK;
    });
  }

  // From the stand to a walk in which the feet move.
  bool walks(double forward) {
    state.clear();
    odom.clear();
    steer(forward);
    return odom.waitFor([=](const Odometry& each) { return std::abs(each.twist.twist.linear.x - forward) < 0.02; }) !=
           nullptr;
  }

  // The time that the driver let pass between its last two velocities for the robot, in the robot's frames: each has
  // the last frame in which it counts.
  unsigned framesBeforeLastVelocity() const {
    const std::vector<test_support::Message> sent = proxy.requestsFromDriver("S");
    const auto last = [&sent](std::size_t back) {
      return protocol::decodeBigEndian32(sent.at(sent.size() - back).payload.data());
    };
    return last(1) - last(2);
  }

  bool stands() {
    odom.clear();
    return odom.waitFor([](const Odometry& each) { return each.twist.twist.linear.x == 0; }) != nullptr;
  }

  TopicListener<Odometry> odom;
  TopicListener<MotionState> state;
};

TEST(Walk, GoesWithTheVelocityAndStopsWhenNoneComes) {
  Walker walker("/walk", {"_cmd_vel_timeout:=0.3"});
  TopicListener<tf2_msgs::TFMessage> tf("/walk/tf");
  ASSERT_TRUE(walker.call<std_srvs::Trigger>("stand").success);
  ASSERT_TRUE(walker.walks(0.1));
  const auto odom = walker.odom.waitFor([](const Odometry& each) { return each.pose.pose.position.x > 0.1; });
  ASSERT_TRUE(odom);
  EXPECT_EQ(odom->header.frame_id, "rex/odom");
  EXPECT_EQ(odom->child_frame_id, "rex/base_footprint");
  EXPECT_TRUE(tf.waitFor([&odom](const tf2_msgs::TFMessage& each) {
    const auto& transform = each.transforms.front();
    return transform.child_frame_id == odom->child_frame_id && transform.header.stamp == odom->header.stamp &&
           transform.transform.translation.x == odom->pose.pose.position.x &&
           transform.transform.translation.y == odom->pose.pose.position.y &&
           transform.transform.rotation == odom->pose.pose.orientation;
  }));
  // If this computer stalls the driver, the robot is first.
  EXPECT_TRUE(walker.becomesTrue([&walker] {
    EXPECT_TRUE(walker.walks(0.1));
    walker.letGo();
    const auto end = walker.waitForEnd();
    EXPECT_TRUE(end && lastEnd(*end).how == EndedMovement::STOPPED && walker.stands());
    return end && lastEnd(*end).reason == "no cmd_vel came for 0.3 s" && walker.framesBeforeLastVelocity() < 55;
  }));
}

// It walks back over the edge of a table. What makes it stand up is in the unit tests.
TEST(Walk, ARobotThatHasFallenGetsUpByItself) {
  Walker walker("/get_up", {"_get_up:=true", "_guard:=false"}, {"--on-table"});
  walker.steer(-0.15);
  const auto getting_up = walker.state.waitFor([](const MotionState& each) { return moves(each, Movement::POSTURE); });
  ASSERT_TRUE(getting_up);
  EXPECT_EQ(getting_up->movements[0].name, "stand");
}

TEST(Walk, ItsTransformsArePublishedUnlessTheyAreNotWanted) {
  for (const bool is_wanted : {true, false}) {
    const std::string value = is_wanted ? "true" : "false";
    Walker walker("/frames", {"_publish_footprint:=" + value, "_publish_odom_tf:=" + value});
    TopicListener<tf2_msgs::TFMessage> tf("/frames/tf");
    for (const char* const frame : {"rex/base_link", "rex/base_footprint"}) {
      EXPECT_TRUE(!is_wanted || tf.waitFor([frame](const tf2_msgs::TFMessage& each) {
        return each.transforms.front().child_frame_id == frame;
      })) << frame;
    }
    EXPECT_TRUE(walker.odom.waitForNext() && walker.joints.messages().waitForNext());
    EXPECT_TRUE(is_wanted || tf.count() == 0);
  }
}

TEST(Walk, IsMeasuredAlsoWhileNobodyListens) {
  JointUser user("/unheard", quickWith("/unheard"));
  EXPECT_TRUE(user.becomesTrue([&user] {
    for (int i = 0; i < 100; ++i) {
      user.publish("cmd_vel", JointUser::twist(0.1));
      EXPECT_TRUE(user.joints.messages().waitForNext());
    }
    const auto odom = TopicListener<Odometry>("/unheard/odom").waitForNext();
    return odom && odom->pose.pose.position.x > 0.02;
  }));
}

TEST(Walk, IsUnknownToVersion1AndTheRobotStandsWhereItBegan) {
  TopicListener<tf2_msgs::TFMessage> tf("/walk1/tf");
  Walker walker("/walk1", {}, {"--protocol-version", "1"});
  EXPECT_TRUE(tf.waitFor(
      [](const tf2_msgs::TFMessage& each) { return each.transforms[0].child_frame_id == "rex/base_footprint"; }));
  tf.waitForCount(tf.count() + 50);
  EXPECT_EQ(walker.odom.count(), 0u);
}

Going::Goal goalAt(double x, double y, double yaw) {
  Going::Goal goal;
  goal.pose.header.frame_id = "rex/odom";
  goal.pose.pose.position.x = x;
  goal.pose.pose.position.y = y;
  goal.pose.pose.orientation.z = std::sin(yaw / 2);
  goal.pose.pose.orientation.w = std::cos(yaw / 2);
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
        state(name_space + "/motion_state") {
    EXPECT_TRUE(go_to.waitForActionServerToStart(ros::Duration(60)));
    EXPECT_TRUE(take_posture.waitForActionServerToStart(ros::Duration(60)));
  }

  Going::Client go_to;
  Taking::Client take_posture;
  TopicListener<MotionState> state;
};

// A driver or a robot that stalls for half a second ends the walk. Then the goal is published again.
TEST(Goal, SucceedsWhenTheRobotIsThere) {
  GoalUser user("/goes");
  EXPECT_TRUE(
      user.becomesTrue([&user] { return Going(user.go_to, goalAt(0.35, 0.1, 1.5)).waitForEnd() == State::SUCCEEDED; }));
}

TEST(Goal, SaysWhatIsLeftAndIsPreemptedWhenItIsCancelled) {
  GoalUser user("/cancels");
  const auto there = Going::begin(user.go_to, goalAt(2, 0, 1));
  EXPECT_GT(there->waitForFeedback()->distance, 1.2);
  EXPECT_NEAR(there->waitForFeedback()->turn, 1, 0.2);
  there->cancel();
  EXPECT_EQ(there->waitForEnd(), State::PREEMPTED);
  EXPECT_EQ(there->result()->end, EndedMovement::STOPPED);
  EXPECT_TRUE(user.state.waitFor([&there](const MotionState& each) {
    return each.movements.empty() && lastEnd(each).reason == there->result()->message;
  })) << "motion_state says the same";
}

TEST(Goal, EndsWithTheConnectionAndNothingResumesIt) {
  GoalUser user("/loses");
  const auto there = Going::begin(user.go_to, goalAt(2, 0, 0));
  user.connection.clear();
  user.proxy.setWelcome(test_support::Welcome::kRefuse);
  user.proxy.endConnections(test_support::Action::kReset);
  EXPECT_EQ(there->waitForEnd(), State::ABORTED);
  EXPECT_EQ(there->result()->end, EndedMovement::LOST);
  EXPECT_TRUE(user.connection.waitFor([](const aibo_driver::Connection& each) {
    return each.state == aibo_driver::Connection::DISCONNECTED && !each.reason.empty() && !each.advice.empty() &&
           each.protocol_version == 0;
  }));
  user.connection.clear();
  user.proxy.heal();
  EXPECT_TRUE(user.waitForConnection(aibo_driver::Connection::CONNECTED));
  EXPECT_TRUE(user.state.waitForCount(0).back()->movements.empty());
}

TEST(TakePosture, SucceedsWhenTheRobotHasTakenIt) {
  GoalUser user("/takes");
  const auto sits = Taking::begin(user.take_posture, postureOf("sit"));
  EXPECT_EQ(sits->waitForEnd(), State::SUCCEEDED);
  EXPECT_EQ(sits->result()->end, EndedMovement::DONE);
  Taking wrong(user.take_posture, postureOf("dance"));
  EXPECT_EQ(wrong.waitForEnd(), State::REJECTED);
}

TEST(TakePosture, IsPreemptedWhenItIsCancelledAndTheLegsHold) {
  GoalUser user("/takes_not");
  const auto rests = Taking::begin(user.take_posture, postureOf("rest"));
  rests->cancel();
  EXPECT_EQ(rests->waitForEnd(), State::PREEMPTED);
  EXPECT_EQ(rests->result()->end, EndedMovement::STOPPED);
  const auto holds = user.proxy.requestsFromDriver("I");
  ASSERT_EQ(holds.size(), 1U);
  EXPECT_THAT(holds[0].payload, testing::ElementsAre(11, 12, 13, 21, 22, 23, 31, 32, 33, 41, 42, 43));
}

}  // namespace
