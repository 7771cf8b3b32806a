// Orders, and the truth about them: which ones move the robot, when a stop or a posture came between, and how each
// ends.

#include <aibo_driver/MotionState.h>
#include <aibo_driver/PlayMotion.h>
#include <aibo_driver/RobotState.h>
#include <gmock/gmock.h>
#include <ros/ros.h>
#include <std_srvs/Trigger.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <future>
#include <map>
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
using sensor_msgs::JointState;
using std::chrono::milliseconds;
using std_srvs::Trigger;
using test_support::command;
using test_support::JointUser;
using test_support::kQuick;
using test_support::kSafetyNet;
using test_support::TopicListener;
using test_support::trajectory;

// More than the noise of a joint that stands.
constexpr double kStill = 0.02;  // rad

// A robot, its driver, and a user who watches what becomes of his orders.
class OrderUser : public JointUser {
 public:
  explicit OrderUser(const std::string& name_space, const std::vector<std::string>& robot_options = {})
      : JointUser(name_space, kQuick, robot_options),
        states(name_space + "/motion_state"),
        robot_states(name_space + "/robot_state") {}

  // The longest way of any joint in the next time.
  double wayWithin(milliseconds time) {
    const ros::Time begin = ros::Time::now();
    const auto is_later = [&begin](const JointState& message) { return message.header.stamp >= begin; };
    joints.messages().clear();
    std::this_thread::sleep_for(time);  // the time is what is tested
    EXPECT_TRUE(joints.messages().waitFor(is_later));
    std::map<std::string, std::pair<double, double>> ranges;
    for (const auto& message : joints.messages().waitForCount(1)) {
      for (std::size_t i = 0; is_later(*message) && i < message->name.size(); ++i) {
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
    return becomesTrue([this] { return wayWithin(milliseconds(500)) <= kStill; });
  }

  // Whether a movement of this kind ends so.
  MotionState::ConstPtr waitForEnd(std::uint8_t kind, std::uint8_t how, const std::string& reason = "") {
    return states.waitFor([&](const MotionState& state) {
      return std::any_of(state.ended.begin(), state.ended.end(), [&](const EndedMovement& each) {
        return each.movement.kind == kind && each.how == how && each.reason.find(reason) != std::string::npos;
      });
    });
  }

  PlayMotion::Response play(const std::string& name) {
    PlayMotion::Request request;
    request.name = name;
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
  ASSERT_TRUE(user.becomesTrue([&user] {
    user.publish("joint_trajectory", trajectory({{"head_pan", 1.4}}, 14.0));
    return user.waitForPanBeyond(0.1, std::chrono::seconds(5));
  }));
  EXPECT_TRUE(user.call<Trigger>("stop").success);
  EXPECT_TRUE(user.robot_states.waitFor(
      [](const RobotState& state) { return state.stopped != 0 && state.stopped_by == ros::this_node::getName(); }));
  EXPECT_TRUE(user.comesToRest());
  user.publish("joint_command", command({{"head_pan", -1.0}}));
  user.publish("joint_trajectory", trajectory({{"head_pan", -1.0}}, 2.0));
  EXPECT_FALSE(user.play("nod").success);
  const std::string reason = "stopped by " + ros::this_node::getName() + "; call release";
  EXPECT_TRUE(user.waitForEnd(Movement::COMMAND, EndedMovement::REFUSED, reason));
  EXPECT_TRUE(user.waitForEnd(Movement::TRAJECTORY, EndedMovement::REFUSED, reason));
  EXPECT_LT(user.wayWithin(milliseconds(500)), kStill);
  EXPECT_TRUE(user.call<Trigger>("release").success);
  EXPECT_LT(user.wayWithin(milliseconds(500)), kStill) << "nothing starts by itself";
  EXPECT_TRUE(user.reaches({{"head_pan", -0.5}}, "joint_command", command({{"head_pan", -0.5}})));
}

TEST_P(OrdersTest, AreDoneWhenTheJointIsMeasuredThere) {
  OrderUser user(nameSpace("done"), options());
  EXPECT_TRUE(user.reaches({{"head_pan", 0.5}}, "joint_command", command({{"head_pan", 0.5}})));
  EXPECT_TRUE(user.waitForEnd(Movement::COMMAND, EndedMovement::DONE));
  EXPECT_TRUE(user.reaches({{"head_pan", 0.0}}, "joint_trajectory", trajectory({{"head_pan", 0.0}}, 1.0)));
  EXPECT_TRUE(user.waitForEnd(Movement::TRAJECTORY, EndedMovement::DONE));
}

TEST_P(OrdersTest, ThatWaitedWhileTheDriverWasFrozenDoNotMoveTheRobot) {
  OrderUser user(nameSpace("frozen"), options());
  user.publisherOf<JointState>("joint_command");
  user.driver.signal(SIGSTOP);
  std::this_thread::sleep_for(milliseconds(300));
  user.publish("joint_command", command({{"head_pan", 0.5}}));
  user.publish("joint_command", command({{"left_front_knee", 0.5}}));
  std::this_thread::sleep_for(milliseconds(1200));  // longer than 0.5 s
  user.driver.signal(SIGCONT);
  EXPECT_TRUE(user.waitForEnd(Movement::COMMAND, EndedMovement::REFUSED));
  EXPECT_LT(user.wayWithin(milliseconds(700)), kStill);
  EXPECT_TRUE(user.reaches({{"head_pan", 0.5}}, "joint_command", command({{"head_pan", 0.5}}))) << "later ones do";
}

TEST(Orders, AreRefusedWithoutMotors) {
  OrderUser user("/limp");
  EXPECT_TRUE(user.setMotors(false).success);
  EXPECT_TRUE(user.robot_states.waitFor([](const RobotState& state) { return state.motors == RobotState::OFF; }));
  user.publish("joint_command", command({{"head_pan", 0.5}}));
  EXPECT_TRUE(user.waitForEnd(Movement::COMMAND, EndedMovement::REFUSED));
  EXPECT_TRUE(user.setMotors(true).success);
  EXPECT_TRUE(user.reaches({{"head_pan", 0.5}}, "joint_command", command({{"head_pan", 0.5}})));
}

TEST(Orders, GoOnWhileTheMemoryStickIsSlow) {
  OrderUser user("/slow_stick", {"--stick-time", "1500"});
  PlayMotion::Response answer;
  const auto player = std::async(std::launch::async, [&] { answer = user.play("nod"); });
  ASSERT_TRUE(user.proxy.waitForRequest("P", kSafetyNet));
  EXPECT_TRUE(user.reaches({{"left_front_knee", 0.5}}, "joint_command", command({{"left_front_knee", 0.5}})));
}

// A call of play_motion that is not answered ends after 2 s. A computer that is so slow gets another chance.
TEST(StopAndMotors, WaitForNoOtherCall) {
  bool overtake = false;
  for (int attempt = 0; attempt < 5 && !overtake; ++attempt) {
    OrderUser user("/urgent");
    user.proxy.setMute(true);
    const auto player = std::async(std::launch::async, [&user] { user.play("nod"); });
    ASSERT_TRUE(user.proxy.waitForRequest("P", kSafetyNet));
    const auto switcher = std::async(std::launch::async, [&user] { user.setMotors(false); });
    EXPECT_TRUE(user.proxy.waitForRequest("O", kSafetyNet));
    const auto stopper = std::async(std::launch::async, [&user] { user.call<Trigger>("stop"); });
    EXPECT_TRUE(user.proxy.waitForRequest("I", kSafetyNet));
    overtake = player.wait_for(milliseconds(0)) == std::future_status::timeout;
    user.proxy.setMute(false);
    stopper.wait();
    user.call<Trigger>("release");
  }
  EXPECT_TRUE(overtake);
}

}  // namespace
