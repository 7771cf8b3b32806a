// Orders, and the truth about them: which ones move the robot, when a stop or a posture came between, and how each
// ends.

#include <aibo_driver/MotionState.h>
#include <aibo_driver/PlayMotion.h>
#include <aibo_driver/RobotState.h>
#include <aibo_driver/StopMotion.h>
#include <geometry_msgs/Twist.h>
#include <gmock/gmock.h>
#include <nav_msgs/Odometry.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <future>
#include <map>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "support/ros/joint_messages.h"
#include "support/ros/joint_user.h"

namespace {

using aibo_driver::EndedMovement;
using aibo_driver::MotionState;
using aibo_driver::Movement;
using aibo_driver::PlayMotion;
using aibo_driver::RobotState;
using geometry_msgs::Twist;
using sensor_msgs::JointState;
using std::chrono::milliseconds;
using std_srvs::Trigger;
using test_support::command;
using test_support::JointUser;
using test_support::kQuick;
using test_support::kSafetyNet;
using test_support::TopicListener;
using test_support::trajectory;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

// More than the noise of a joint that stands.
constexpr double kStill = 0.02;  // rad

std::vector<std::string> parametersFor(const std::string& name_space) {
  std::vector<std::string> parameters = kQuick;
  parameters.push_back("/tf:=" + name_space + "/tf");  // all tests share a master
  return parameters;
}

// A robot, its driver, and a user who watches what becomes of his orders.
class OrderUser : public JointUser {
 public:
  explicit OrderUser(const std::string& name_space, const std::vector<std::string>& robot_options = {})
      : JointUser(name_space, parametersFor(name_space), robot_options),
        states(name_space + "/motion_state"),
        robot_states(name_space + "/robot_state") {
    EXPECT_TRUE(states.waitForCount(1).size() > 0);
  }

  // From any posture to a walk in which the legs move.
  bool walks() {
    steer(0.1);
    const auto is_walk = [](const MotionState& state) {
      return std::any_of(state.movements.begin(), state.movements.end(),
                         [](const Movement& movement) { return movement.kind == Movement::WALK; });
    };
    states.clear();
    joints.messages().clear();
    return states.waitFor(is_walk) != nullptr && waitForKneeSpeed();
  }

  bool waitForKneeSpeed() {
    return joints.messages().waitFor([](const JointState& state) {
      return std::abs(test_support::speedOf(state, "left_front_knee").value_or(0)) > 0.3;
    }) != nullptr;
  }

  // The longest way of any joint in the next time.
  double wayWithin(milliseconds time) {
    const ros::Time begin = ros::Time::now();
    const auto is_later = [&begin](const JointState& message) { return message.header.stamp >= begin; };
    joints.messages().clear();
    std::this_thread::sleep_for(time);  // the time is what is tested
    EXPECT_TRUE(joints.messages().waitFor(is_later));
    std::map<std::string, std::pair<double, double>> ranges;
    for (const auto& message : joints.messages().waitForCount(1)) {
      if (!is_later(*message)) {
        continue;  // a busy computer was late with it
      }
      for (std::size_t i = 0; i < message->name.size(); ++i) {
        auto [range, is_new] = ranges.try_emplace(message->name[i], message->position[i], message->position[i]);
        range->second.first = std::min(range->second.first, message->position[i]);
        range->second.second = std::max(range->second.second, message->position[i]);
      }
    }
    double longest = 0;
    for (const auto& range : ranges) {
      longest = std::max(longest, range.second.second - range.second.first);
    }
    return longest;
  }

  // Braking takes its time, and a computer that is busy takes longer.
  bool comesToRest() {
    const auto end = std::chrono::steady_clock::now() + kSafetyNet;
    while (wayWithin(milliseconds(500)) > kStill) {
      if (std::chrono::steady_clock::now() > end) {
        return false;
      }
    }
    return true;
  }

  // The first movement of this kind that has ended since states.clear(), in this way if one is given.
  EndedMovement waitForEnd(std::uint8_t kind, std::optional<std::uint8_t> how = std::nullopt) {
    EndedMovement end;
    end.how = 99;
    states.waitFor([&](const MotionState& state) {
      for (const EndedMovement& each : state.ended) {
        if (each.movement.kind == kind && each.how == how.value_or(each.how)) {
          end = each;
          return true;
        }
      }
      return false;
    });
    return end;
  }

  bool waitForMovement(std::uint8_t kind) {
    return states.waitFor([kind](const MotionState& state) {
      return std::any_of(state.movements.begin(), state.movements.end(),
                         [kind](const Movement& movement) { return movement.kind == kind; });
    }) != nullptr;
  }

  PlayMotion::Response play(const std::string& name, int repetitions) {
    PlayMotion::Request request;
    request.name = name;
    request.repetitions = static_cast<std::uint16_t>(repetitions);
    return call<PlayMotion>("play_motion", request);
  }

  TopicListener<MotionState> states;
  TopicListener<RobotState> robot_states;
};

// With each version of the protocol.
class OrdersTest : public ::testing::TestWithParam<std::string> {
 protected:
  static std::vector<std::string> options() { return {"--protocol-version", GetParam()}; }
  static std::string nameSpace(const std::string& name) { return "/" + name + GetParam(); }
};

INSTANTIATE_TEST_SUITE_P(Versions, OrdersTest, ::testing::Values("1", "2"));

TEST_P(OrdersTest, NothingMovesTheRobotBetweenStopAndRelease) {
  OrderUser user(nameSpace("latch"), options());
  user.publish("joint_command", command({{"head_pan", 1.0}}));
  ASSERT_TRUE(user.waitForPanBeyond(0.1));
  EXPECT_TRUE(user.call<Trigger>("stop").success);
  const auto is_stopped = [](const RobotState& state) {
    return state.stopped != 0 && state.stopped_by == ros::this_node::getName();
  };
  EXPECT_TRUE(user.robot_states.waitFor(is_stopped));
  EXPECT_THAT(user.driver.output(), Not(HasSubstr("command of head_pan ends early"))) << "it was meant to";
  EXPECT_TRUE(user.comesToRest());
  user.states.clear();
  user.publish("joint_command", command({{"head_pan", -1.0}}));
  user.publish("joint_trajectory", trajectory({{"head_pan", -1.0}}, 2.0));
  EXPECT_FALSE(user.play("nod", 1).success);
  EXPECT_LT(user.wayWithin(milliseconds(1500)), kStill);
  const std::string reason = "stopped by " + ros::this_node::getName() + "; call release";
  for (const std::uint8_t kind : {Movement::COMMAND, Movement::TRAJECTORY, Movement::MOTION}) {
    EXPECT_EQ(user.waitForEnd(kind, EndedMovement::REFUSED).reason, reason);
  }
  EXPECT_TRUE(user.call<Trigger>("release").success);
  EXPECT_LT(user.wayWithin(milliseconds(500)), kStill) << "nothing starts by itself";
  user.publish("joint_command", command({{"head_pan", -0.5}}));
  EXPECT_TRUE(user.joints.waitForPosition("head_pan", -0.5));
  EXPECT_TRUE(user.comesToRest());
  EXPECT_TRUE(user.call<Trigger>("stop").success);
  user.publish("joint_command", command({{"head_pan", 0.5}}));
  EXPECT_LT(user.wayWithin(milliseconds(500)), kStill) << "again";
}

TEST_P(OrdersTest, DoneIsMeasured) {
  OrderUser user(nameSpace("done"), options());
  user.states.clear();
  user.publish("joint_command", command({{"head_pan", 0.5}}));
  EXPECT_EQ(user.waitForEnd(Movement::COMMAND).how, EndedMovement::DONE);
  EXPECT_NEAR(user.joints.position("head_pan"), 0.5, 0.05);
  user.publish("joint_trajectory", trajectory({{"head_pan", 0.0}}, 1.0));
  EXPECT_EQ(user.waitForEnd(Movement::TRAJECTORY).how, EndedMovement::DONE);
  EXPECT_NEAR(user.joints.position("head_pan"), 0.0, 0.05);
}

TEST_P(OrdersTest, AJointThatIsBlockedIsNamed) {
  OrderUser user(nameSpace("jam"), options());
  user.robot.type("jam head_pan");
  user.states.clear();
  user.publish("joint_command", command({{"head_pan", 0.8}}));
  const EndedMovement end = user.waitForEnd(Movement::COMMAND);
  EXPECT_THAT(end.how, ::testing::AnyOf(EndedMovement::NOT_REACHED, EndedMovement::REFUSED));
  EXPECT_THAT(end.reason, HasSubstr("head_pan"));
}

TEST_P(OrdersTest, WhatWaitedWhileTheDriverWasFrozenDoesNotMoveTheRobot) {
  OrderUser user(nameSpace("frozen"), options());
  ros::Publisher& commands = user.publisherOf<JointState>("joint_command");
  user.states.clear();
  user.driver.signal(SIGSTOP);
  std::this_thread::sleep_for(milliseconds(300));
  std::vector<std::string> joints = {"head_pan", "head_tilt", "neck_tilt"};
  for (const char* leg : {"left_front_", "left_hind_", "right_front_", "right_hind_"}) {
    for (const char* part : {"rotator", "elevator", "knee"}) {
      joints.push_back(std::string(leg) + part);
    }
  }
  for (const std::string& joint : joints) {
    commands.publish(command({{joint, 0.5}}));
  }
  std::this_thread::sleep_for(milliseconds(1200));
  user.driver.signal(SIGCONT);
  for (const std::string& joint : joints) {
    EXPECT_TRUE(user.states.waitFor([&joint](const MotionState& state) {
      return std::any_of(state.ended.begin(), state.ended.end(), [&joint](const EndedMovement& end) {
        return end.movement.joints == std::vector<std::string>{joint} && end.how == EndedMovement::REFUSED;
      });
    })) << joint;
  }
  ASSERT_TRUE(user.waitForConnection(aibo_driver::Connection::CONNECTED));
  EXPECT_LT(user.wayWithin(milliseconds(700)), kStill);
  commands.publish(command({{"head_pan", 0.5}}));
  EXPECT_TRUE(user.joints.waitForPosition("head_pan", 0.5)) << "what comes later does";
}

TEST(Orders, AStopHoldsForARobotThatIsSteered) {
  OrderUser user("/steered");
  ASSERT_TRUE(user.walks());
  EXPECT_TRUE(user.call<Trigger>("stop").success);
  EXPECT_TRUE(user.comesToRest());
  EXPECT_LT(user.wayWithin(milliseconds(1500)), kStill);
  EXPECT_TRUE(user.call<Trigger>("release").success);
  EXPECT_LT(user.wayWithin(milliseconds(1000)), kStill) << "nobody has let go";
  user.steer(0);
  user.joints.messages().clear();
  EXPECT_FALSE(user.joints.messages().waitForCount(20).empty()) << "meanwhile the driver hears that the user lets go";
  EXPECT_TRUE(user.walks());
}

TEST(Orders, PosturesAreTakenUnderAStreamOfVelocities) {
  OrderUser user("/postures");
  ASSERT_TRUE(user.walks());
  for (const std::string name : {"sit", "rest"}) {
    const auto answer = user.call<Trigger>(name);
    EXPECT_TRUE(answer.success) << answer.message;
  }
  EXPECT_TRUE(user.setMotors(true).success);
  EXPECT_LT(user.wayWithin(milliseconds(1000)), 0.3) << "it does not walk off; the joints may stiffen";
  EXPECT_EQ(user.call<Trigger>("stand").success, true);
}

TEST(Orders, ARobotThatWasLiftedDoesNotWalkByItself) {
  OrderUser user("/lifted");
  TopicListener<nav_msgs::Odometry> odometry("/lifted/odom");
  EXPECT_TRUE(user.call<Trigger>("stand").success);
  user.robot.type("lift on");
  EXPECT_TRUE(odometry.waitFor([](const nav_msgs::Odometry& odom) {
    return odom.pose.covariance[0] > 0.9;  // m^2: it may be put down elsewhere
  }));
  user.robot_states.clear();
  user.robot.type("lift off");
  const auto stands = [](const RobotState& state) { return state.posture == RobotState::STANDING; };
  ASSERT_TRUE(user.robot_states.waitFor(stands));
  ASSERT_TRUE(user.walks());
  user.states.clear();
  user.robot.type("lift on");
  EXPECT_EQ(user.waitForEnd(Movement::WALK, EndedMovement::FELL).how, EndedMovement::FELL);
  user.robot.type("lift off");
  EXPECT_TRUE(user.comesToRest());
  EXPECT_LT(user.wayWithin(milliseconds(1000)), kStill);
}

TEST(Orders, ALegThatWasCommandedInAWalkStaysThere) {
  OrderUser user("/leg");
  ASSERT_TRUE(user.walks());
  user.states.clear();
  user.publish("joint_command", command({{"left_front_rotator", 0.2}}));
  EXPECT_EQ(user.waitForEnd(Movement::WALK, EndedMovement::REPLACED).how, EndedMovement::REPLACED);
  EXPECT_EQ(user.waitForEnd(Movement::COMMAND).how, EndedMovement::DONE);
  EXPECT_TRUE(user.comesToRest());
  EXPECT_LT(user.wayWithin(milliseconds(1000)), kStill);
  EXPECT_NEAR(user.joints.position("left_front_rotator"), 0.2, 0.05);
}

TEST(Orders, StandIsNeverRefusedForWhatWasAnsweredBefore) {
  OrderUser user("/persistent");
  for (int i = 0; i < 5; ++i) {
    EXPECT_TRUE(user.setMotors(true).success);
    const auto first = user.call<Trigger>("stand");
    EXPECT_TRUE(first.success) << first.message;
    EXPECT_TRUE(user.call<Trigger>("stop").success);
    EXPECT_TRUE(user.call<Trigger>("release").success);
    const auto second = user.call<Trigger>("stand");
    EXPECT_TRUE(second.success) << second.message;
  }
}

TEST(Orders, ASlowMemoryStickHoldsUpNothingElse) {
  OrderUser user("/slow_stick", {"--stick-time", "1500"});
  user.publisherOf<JointState>("joint_command");
  PlayMotion::Response answer;
  const auto player = std::async(std::launch::async, [&] { answer = user.play("nod", 1); });
  ASSERT_TRUE(user.proxy.waitForRequest("P", kSafetyNet));
  user.publish("joint_command", command({{"left_front_knee", 0.5}}));
  EXPECT_TRUE(user.joints.waitForPosition("left_front_knee", 0.5));
  user.states.clear();
  player.wait();
  EXPECT_TRUE(answer.success) << answer.message;
}

TEST(Orders, AMotionThatMayOrMayNotPlayIsSaidToUntilItIsKnown) {
  OrderUser user("/may_or_may_not", {"--stick-time", "3000"});
  user.states.clear();
  const auto answer = user.play("nod", 1);
  EXPECT_FALSE(answer.success);
  EXPECT_THAT(answer.message, StartsWith("NOD.MTN may or may not play"));
  EXPECT_TRUE(user.waitForMovement(Movement::MOTION));
  EXPECT_EQ(user.waitForEnd(Movement::MOTION).how, EndedMovement::DONE);
  user.states.clear();
  EXPECT_THAT(user.play("fly", 1).message, StartsWith("FLY.MTN may or may not play"));
  EXPECT_EQ(user.waitForEnd(Movement::MOTION, EndedMovement::REFUSED).movement.name, "FLY.MTN");
}

TEST(Orders, AMotionIsStoppedByStopMotion) {
  OrderUser user("/stop_motion");
  ASSERT_TRUE(user.play("nod", 100).success);
  const auto answer = user.call<aibo_driver::StopMotion>("stop_motion");
  EXPECT_TRUE(answer.success) << answer.message;
  EXPECT_EQ(user.waitForEnd(Movement::MOTION, EndedMovement::STOPPED).how, EndedMovement::STOPPED);
}

TEST(Orders, WithoutMotorsAreRefusedAndSaidTo) {
  OrderUser user("/limp");
  const ros::Time before = ros::Time::now();
  EXPECT_TRUE(user.setMotors(false).success);
  const auto off = user.robot_states.waitFor([](const RobotState& state) { return state.motors == RobotState::OFF; });
  EXPECT_TRUE(off && off->header.stamp >= before);
  user.states.clear();
  user.publish("joint_command", command({{"head_pan", 0.5}}));
  const EndedMovement commanded = user.waitForEnd(Movement::COMMAND);
  EXPECT_EQ(commanded.how, EndedMovement::REFUSED);
  EXPECT_THAT(commanded.reason, HasSubstr("motors"));
  user.publish("joint_trajectory", trajectory({{"head_pan", 0.5}}, 1.0));
  const EndedMovement followed = user.waitForEnd(Movement::TRAJECTORY);
  EXPECT_EQ(followed.how, EndedMovement::REFUSED);
  EXPECT_EQ(followed.reason, commanded.reason);
}

}  // namespace
