// Orders to the joints: which of them move the robot, at which speeds, and how they end.

#include <aibo_driver/PlayMotion.h>
#include <aibo_driver/RobotState.h>
#include <std_msgs/Float64.h>
#include <std_srvs/Trigger.h>

#include <array>
#include <csignal>
#include <future>

#include "robot_model/robot_model.h"
#include "ros/joint_user.h"

namespace {

using aibo_driver::EndedMovement;
using aibo_driver::MotionState;
using aibo_driver::Movement;
using aibo_driver::PlayMotion;
using aibo_driver::RobotState;
using geometry_msgs::Twist;
using std::chrono::milliseconds;
using std_srvs::Trigger;
using test_support::command;
using test_support::DriverUser;
using test_support::JointUser;
using test_support::TopicListener;
using test_support::trajectory;
using trajectory_msgs::JointTrajectory;

// More than the noise of a joint that stands.
constexpr double kStill = 0.02;  // rad

// A robot, its driver, and a user who watches how the orders end.
class OrderUser : public JointUser {
 public:
  explicit OrderUser(const std::string& name_space, const std::vector<std::string>& robot_options = {},
                     const std::vector<std::string>& parameters = test_support::kQuick)
      : JointUser(name_space, parameters, robot_options),
        states(name_space + "/motion_state"),
        robot_states(name_space + "/robot_state") {}

  // The longest way in the next time of a joint that is commanded here.
  double wayWithin(milliseconds time) {
    const auto position_of = [this](const char* joint) {
      const double position = joints.position(joint);
      EXPECT_FALSE(std::isnan(position)) << joint;
      return position;
    };
    const auto positions = [&] {
      return std::array{position_of("head_pan"), position_of("neck_tilt"), position_of("tail_pan")};
    };
    const auto before = positions();
    std::this_thread::sleep_for(time);  // the time is what is tested
    const auto after = positions();
    return std::max({std::abs(after[0] - before[0]), std::abs(after[1] - before[1]), std::abs(after[2] - before[2])});
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
    return user.joints.messages().waitFor(
               [](const auto& state) { return test_support::positionOf(state, "head_pan") > 0.1; },
               std::chrono::seconds(5)) != nullptr;
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

// Orders wait in the sockets of a driver that is frozen. Afterwards, none of them reaches the robot.
void expectOldOrdersToBeRefused(DriverUser* user, TopicListener<MotionState>* states) {
  user->publisherOf<sensor_msgs::JointState>("joint_command");
  user->publisherOf<JointTrajectory>("joint_trajectory");
  user->publisherOf<Twist>("cmd_vel");
  for (const int freeze : {600, 1000, 3000}) {
    const std::uint64_t newest = test_support::lastEnd(*states->waitForCount(1).back()).movement.order;
    user->driver.signal(SIGSTOP);
    std::this_thread::sleep_for(milliseconds(50));
    user->publish("joint_command", command({{"head_pan", 0.5}}));
    user->publish("joint_trajectory", trajectory({{"tail_pan", 0.5}}, 1.0));
    user->publish("cmd_vel", DriverUser::twist(0.1));
    std::this_thread::sleep_for(milliseconds(freeze - 50));
    user->driver.signal(SIGCONT);
    for (const auto kind : {Movement::COMMAND, Movement::TRAJECTORY, Movement::WALK}) {
      EXPECT_TRUE(states->waitFor([&](const MotionState& state) {
        return std::any_of(state.ended.begin(), state.ended.end(), [&](const EndedMovement& each) {
          return each.movement.kind == kind && each.movement.order > newest && each.how == EndedMovement::REFUSED;
        });
      })) << static_cast<int>(kind)
          << " after " << freeze << " ms";
    }
    EXPECT_EQ(user->proxy.requestsFromDriver("JS").size(), 0U) << freeze << " ms";
  }
}

TEST_P(OrdersTest, ThatWaitedWhileTheDriverWasFrozenDoNotMoveTheRobot) {
  OrderUser user(nameSpace("frozen"), options());
  expectOldOrdersToBeRefused(&user, &user.states);
  EXPECT_LT(user.wayWithin(milliseconds(700)), kStill);
  EXPECT_TRUE(user.reaches({{"head_pan", 0.5}}, "joint_command", command({{"head_pan", 0.5}}))) << "later ones do";
  DriverUser unmeasured(nameSpace("unmeasured"), {"_stream_on_start:=false", "_telemetry_rate:=0"}, options());
  TopicListener<MotionState> states(nameSpace("unmeasured") + "/motion_state");
  expectOldOrdersToBeRefused(&unmeasured, &states);
}

// A call of play_motion that is not answered ends after 2 s. A computer that is so slow gets another chance.
TEST(StopAndMotors, WaitForNoOtherCall) {
  bool overtake = false;
  for (int attempt = 0; attempt < 5 && !overtake; ++attempt) {
    OrderUser user("/urgent");
    user.proxy.setMute(true);
    const auto player = std::async(std::launch::async, [&user] { user.play("nod"); });
    ASSERT_TRUE(user.proxy.waitForRequest("P"));
    const auto switcher = std::async(std::launch::async, [&user] { user.setMotors(false); });
    EXPECT_TRUE(user.proxy.waitForRequest("O"));
    const auto stopper = std::async(std::launch::async, [&user] { user.call<Trigger>("stop"); });
    EXPECT_TRUE(user.proxy.waitForRequest("I"));
    overtake = player.wait_for(milliseconds(0)) == std::future_status::timeout;
    user.proxy.setMute(false);
    stopper.wait();
    user.call<Trigger>("release");
  }
  EXPECT_TRUE(overtake);
}

// Two encoder steps within 32 ms, and the settling of the servo.
constexpr double kSpeedTolerance = 0.12;  // rad/s

// Each joint at another fraction between its limits. From 0.5 to 0.7 no part of the body is in the way of another.
TEST(PositionControllers, MoveEveryJoint) {
  test_support::Posture posture;
  const robot_model::RobotModel& ers7 = *robot_model::findRobotModel("ERS-7");
  for (int i = 0; i < ers7.number_of_joints; ++i) {
    const robot_model::Joint& joint = ers7.joints[i];
    const double fraction = 0.5 + 0.01 * ((7 * i) % 20);
    posture[joint.name] = (joint.lowest + fraction * (joint.highest - joint.lowest)) / 1e6;
  }
  JointUser user("/controllers");
  EXPECT_TRUE(user.reaches(posture, [&] {
    for (const auto& [joint, position] : posture) {
      std_msgs::Float64 message;
      message.data = position;
      user.publish(joint + "_position_controller/command", message);
    }
  }));
}

TEST(SpeedLimits, OfTheParametersAreThoseOfCommandsAndMotions) {
  OrderUser user(
      "/limits", {},
      {"_stream_on_start:=false", "_joint_speed_limit:=1.5", "_approach_speed:=0.2", "_motion_speed_limit:=0.3"});
  EXPECT_TRUE(user.reaches({{"head_pan", 0.3}}, "joint_command", command({{"head_pan", 0.3}})));
  EXPECT_LE(user.joints.highestSpeed("head_pan"), 0.2 + kSpeedTolerance) << "of the first movement";
  EXPECT_TRUE(user.reaches({{"head_pan", 1.0}}, "joint_command", command({{"head_pan", 1.0}})));
  EXPECT_LE(user.joints.highestSpeed("head_pan"), 1.5 + kSpeedTolerance);
  ASSERT_TRUE(user.play("nod").success);
  ASSERT_TRUE(user.joints.messages().waitFor(
      [](const auto& state) { return test_support::speedOf(state, "neck_tilt").value_or(0) > 0.2; }));
  EXPECT_TRUE(user.joints.waitForSpeedBelow("neck_tilt", 0.03));
  EXPECT_LE(user.joints.highestSpeed("neck_tilt"), 0.3 + kSpeedTolerance);
}

}  // namespace
