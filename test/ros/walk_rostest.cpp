// Walking by cmd_vel, the odometry, postures, and the programs that steer.

#include <aibo_driver/MotionState.h>
#include <fcntl.h>
#include <geometry_msgs/Twist.h>
#include <gmock/gmock.h>
#include <nav_msgs/Odometry.h>
#include <pty.h>
#include <ros/ros.h>
#include <sensor_msgs/Joy.h>
#include <std_srvs/Trigger.h>
#include <termios.h>
#include <tf2_msgs/TFMessage.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <ctime>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <regex>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "protocol/walk_requests.h"
#include "support/ros/joint_messages.h"
#include "support/ros/joint_user.h"
#include "support/ros/motion_states.h"
#include "support/scripted_server.h"
#include "support/temporary_folder.h"

namespace {

using aibo_driver::EndedMovement;
using aibo_driver::MotionState;
using aibo_driver::Movement;
using geometry_msgs::Twist;
using nav_msgs::Odometry;
using std_srvs::Trigger;
using test_support::command;
using test_support::JointUser;
using test_support::kQuick;
using test_support::kSafetyNet;
using test_support::lastEnd;
using test_support::Process;
using test_support::TopicListener;
using test_support::TopicPublishers;
using ::testing::AnyOf;
using ::testing::HasSubstr;

// Parameters of a driver in whose namespace tf is, because all tests share a master.
std::vector<std::string> quickWith(const std::string& name_space, std::vector<std::string> more = {}) {
  more.insert(more.end(), kQuick.begin(), kQuick.end());
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

  bool waitForWalk() {
    state.clear();
    return state.waitFor([](const MotionState& each) { return moves(each, Movement::WALK); }) != nullptr;
  }

  // How the walk has ended.
  MotionState::ConstPtr waitForEnd(int kind = Movement::WALK) {
    return state.waitFor(
        [kind](const MotionState& each) { return !moves(each, kind) && lastEnd(each).movement.kind == kind; });
  }

  // From the stand to a walk in which the feet move.
  bool walks(double forward) {
    state.clear();
    odom.clear();
    steer(forward);
    return odom.waitFor([=](const Odometry& each) { return std::abs(each.twist.twist.linear.x - forward) < 0.02; }) !=
           nullptr;
  }

  bool stands() {
    odom.clear();
    return odom.waitFor([](const Odometry& each) { return each.twist.twist.linear.x == 0; }) != nullptr;
  }

  TopicListener<Odometry> odom;
  TopicListener<MotionState> state;
};

// It says only how its walk has ended.
TEST(Walk, AFallOfARobotThatReportsNoPostureMakesTheOdometryUncertain) {
  namespace version2 = protocol::version2;
  test_support::ScriptedServer server;
  TopicListener<Odometry> odom("/no_posture/odom");
  const test_support::DriverProcess driver("/no_posture", server.port(), quickWith("/no_posture"));
  test_support::ScriptedPeer robot = server.accept();
  robot.agreeToTelemetry("F J T S E");
  unsigned frame = 0xFFFFFF00;
  const auto is_told = [&](const std::function<bool(double)>& is_so) {
    for (int i = 0; i < 300; ++i) {  // again, until the driver knows its first subscriber
      const auto telemetry = version2_frames::makeTelemetry(
          frame += 4, {{'W', version2::WALK_FORWARD, 0}, {'W', version2::WALK_LEFT, 0}, {'W', version2::WALK_TURN, 0}});
      robot.send(version2_frames::makeFrame('t', 0, telemetry));
      if (odom.waitFor([&](const Odometry& each) { return is_so(each.pose.covariance[0]); },
                       std::chrono::milliseconds(100))) {
        return true;
      }
    }
    return false;
  };
  ASSERT_TRUE(is_told([](double variance) { return variance == 0; }));
  robot.send(version2_frames::makeFrame(
      version2::END_PUSH, 0, version2_frames::makeEnd(version2::ENDED_WALK, version2::END_FELL, "walk", "it fell")));
  EXPECT_TRUE(is_told([](double variance) { return variance == 1; })) << "in m^2";
}

TEST(Walk, GoesWithTheVelocityAndStopsWhenNoneComes) {
  Walker walker("/walk");
  TopicListener<tf2_msgs::TFMessage> tf("/walk/tf");
  ASSERT_TRUE(walker.call<Trigger>("stand").success);
  ASSERT_TRUE(walker.walks(0.1));
  const auto odom = walker.odom.waitFor([](const Odometry& each) { return each.pose.pose.position.x > 0.1; });
  ASSERT_TRUE(odom);
  EXPECT_EQ(odom->header.frame_id, "rex/odom");
  EXPECT_EQ(odom->child_frame_id, "rex/base_footprint");
  EXPECT_LT(std::abs((ros::Time::now() - odom->header.stamp).toSec()), 20);
  EXPECT_TRUE(tf.waitFor([&odom](const tf2_msgs::TFMessage& each) {
    const auto& transform = each.transforms.front();
    return transform.child_frame_id == odom->child_frame_id && transform.header.stamp == odom->header.stamp &&
           transform.transform.translation.x == odom->pose.pose.position.x &&
           transform.transform.translation.y == odom->pose.pose.position.y &&
           transform.transform.rotation == odom->pose.pose.orientation;
  }));
  walker.letGo();
  const auto end = walker.waitForEnd();
  ASSERT_TRUE(end);
  EXPECT_EQ(lastEnd(*end).how, EndedMovement::STOPPED);
  // The driver and the robot watch, for the same time.
  EXPECT_THAT(lastEnd(*end).reason, AnyOf("no cmd_vel came for 0.5 s", "it was not steered for 500 ms"));
  EXPECT_TRUE(walker.stands());
}

TEST(Walk, IsStoppedByTheDriverEachTimeThatNoneComes) {
  Walker walker("/short", {"_cmd_vel_timeout:=0.2"});
  const auto limit = std::chrono::steady_clock::now() + kSafetyNet;
  for (int times = 0; times < 2;) {
    ASSERT_TRUE(walker.walks(0.1));
    walker.letGo();
    const auto end = walker.waitForEnd();
    ASSERT_TRUE(end);
    ASSERT_LT(std::chrono::steady_clock::now(), limit);
    // If this computer holds the driver up, the robot is first.
    times += lastEnd(*end).reason == "no cmd_vel came for 0.2 s" ? 1 : 0;
  }
}

TEST(Walk, IsStoppedByTheDriverIfOnlyNonsenseComes) {
  Walker walker("/nonsense", {"_cmd_vel_timeout:=0.2"});
  ASSERT_TRUE(walker.walks(0.1));
  walker.steer(std::nan(""));
  EXPECT_TRUE(walker.state.waitFor([](const MotionState& each) {
    return std::any_of(each.ended.begin(), each.ended.end(),
                       [](const EndedMovement& end) { return end.reason == "no cmd_vel came for 0.2 s"; });
  }));
}

TEST(Walk, EndsInAnOrderlyWayWithAVelocityOfZero) {
  Walker walker("/zero");
  ASSERT_TRUE(walker.walks(0.1)) << "it first stands up";
  walker.letGo();
  walker.publish("cmd_vel", JointUser::twist(0));
  const auto end = walker.waitForEnd();
  ASSERT_TRUE(end);
  EXPECT_EQ(lastEnd(*end).how, EndedMovement::DONE);
}

TEST(Walk, IsEndedByStopMotorsAndLegsButNotByTheHead) {
  Walker walker("/ended");
  ASSERT_TRUE(walker.walks(0.1));
  walker.publish("joint_command", command({{"head_pan", 0.5}}));
  ASSERT_TRUE(walker.waitForPanBeyond(0.4));
  ASSERT_TRUE(walker.waitForEnd(Movement::COMMAND));
  EXPECT_TRUE(moves(*walker.state.waitForCount(1).back(), Movement::WALK)) << "the head is free";
  walker.letGo();
  EXPECT_TRUE(walker.call<Trigger>("stop").success);
  ASSERT_TRUE(walker.waitForEnd());
  EXPECT_TRUE(walker.stands());
}

TEST(Walk, IsEndedByACommandToALeg) {
  Walker walker("/leg");
  ASSERT_TRUE(walker.walks(0.1));
  walker.letGo();
  walker.publish("joint_command", command({{"left_front_rotator", 0.0}}));
  const auto end = walker.waitForEnd();
  ASSERT_TRUE(end);
  EXPECT_EQ(lastEnd(*end).how, EndedMovement::REPLACED);
  EXPECT_THAT(lastEnd(*end).reason, HasSubstr("left_front_rotator"));
}

TEST(Walk, IsEndedByTheMotors) {
  Walker walker("/motors");
  ASSERT_TRUE(walker.walks(0.1));
  EXPECT_TRUE(walker.setMotors(false).success);
  EXPECT_TRUE(walker.waitForEnd());
  walker.waitForWarning("walk is refused: .* switched the motors off; let go first");
}

TEST(Walk, DoesNotGoOnAfterTheConnectionWasLost) {
  Walker walker("/lost");
  ASSERT_TRUE(walker.walks(0.1));
  walker.letGo();
  walker.reconnect();
  const auto end = walker.waitForEnd();
  ASSERT_TRUE(end);
  EXPECT_THAT(lastEnd(*end).reason, HasSubstr("the connection to the robot was lost"));
  EXPECT_TRUE(walker.stands());
  EXPECT_TRUE(walker.proxy.requestsFromDriver("S", 1).empty()) << "nothing is repeated";
  EXPECT_GT(walker.odom.waitForNext()->pose.pose.position.x, 0) << "the odometry goes on";
}

// It walks back over the edge of a table, and its steering goes on. What makes it stand up is in the unit tests.
TEST(Walk, ARobotThatHasFallenGetsUpByItself) {
  Walker walker("/get_up", {"_get_up:=true", "_guard:=false"}, {"--on-table"});
  walker.steer(-0.15);
  const auto getting_up = walker.state.waitFor([](const MotionState& each) { return moves(each, Movement::POSTURE); });
  ASSERT_TRUE(getting_up);
  EXPECT_EQ(getting_up->movements[0].name, "stand");
  walker.driver.waitForOutput("INFO.*The robot has fallen, and gets up", kSafetyNet);
  EXPECT_TRUE(walker.state.waitFor([](const MotionState& each) {
    return !each.ended.empty() && lastEnd(each).movement.kind == Movement::WALK &&
           lastEnd(each).reason == "the robot lies on its left side";
  }));
  walker.letGo();
  ASSERT_TRUE(walker.waitForEnd(Movement::POSTURE));
  walker.robot.type("lie feet");  // the simulated robot cannot turn over
  ASSERT_TRUE(walker.call<Trigger>("stand").success);
  ASSERT_TRUE(walker.walks(0.05));
  walker.state.clear();
  walker.robot.type("lie left");
  EXPECT_TRUE(walker.state.waitFor([](const MotionState& each) { return moves(each, Movement::POSTURE); }))
      << "after the next fall, too";
}

TEST(Walk, ARobotThatHasFallenStaysDownOnceAUserSwitchedItsMotorsOff) {
  Walker walker("/stay_down", {"_get_up:=true", "_guard:=false"}, {"--on-table"});
  walker.steer(-0.15);
  const auto fallen = walker.waitForEnd();
  ASSERT_TRUE(fallen);
  ASSERT_EQ(lastEnd(*fallen).how, EndedMovement::FELL);
  ASSERT_TRUE(walker.setMotors(false).success);
  walker.odom.clear();
  ASSERT_GE(walker.odom.waitForCount(60).size(), 60U) << "two seconds of the robot's time";
  constexpr std::chrono::milliseconds kNow{0};
  EXPECT_FALSE(walker.state.waitFor([](const MotionState& each) { return moves(each, Movement::POSTURE); }, kNow));
}

TEST(Walk, IsMeasuredAlsoWhileNobodyListens) {
  JointUser user("/unheard", quickWith("/unheard"));
  for (int i = 0; i < 100; ++i) {
    user.publish("cmd_vel", JointUser::twist(0.1));
    ASSERT_TRUE(user.joints.messages().waitForNext());
  }
  TopicListener<Odometry> odom("/unheard/odom");
  EXPECT_GT(odom.waitForNext()->pose.pose.position.x, 0.02);
}

TEST(Walk, HasAFrameForTheFloorWithTheStampOfTheBodys) {
  TopicListener<tf2_msgs::TFMessage> tf("/frames/tf");
  const Walker walker("/frames");
  const auto frames = tf.waitForCount(100);
  const auto stamps_of = [&frames](const std::string& parent, const std::string& child) {
    std::vector<ros::Time> stamps;
    for (const auto& message : frames) {
      for (const auto& each : message->transforms) {
        if (each.header.frame_id == parent && each.child_frame_id == child) {
          stamps.push_back(each.header.stamp);
        }
      }
    }
    return stamps;
  };
  const std::vector<ros::Time> floor = stamps_of("rex/odom", "rex/base_footprint");
  const std::vector<ros::Time> body = stamps_of("rex/base_footprint", "rex/base_link");
  std::size_t shared = 0;
  for (const ros::Time& stamp : body) {
    if (stamp < floor.back()) {
      EXPECT_NE(std::find(floor.begin(), floor.end(), stamp), floor.end());
      ++shared;
    }
  }
  EXPECT_GT(shared, 10u);
}

TEST(Walk, LeavesTheHeadToThoseWhoLookAround) {
  Walker walker("/look_walk");
  const Process look_around({AIBO_LOOK_AROUND, "__ns:=/look_walk"});
  ASSERT_TRUE(walker.walks(0.05)) << "so slowly that it does not reach the ball meanwhile";
  walker.state.clear();
  for (int glance = 0; glance < 2; ++glance) {
    EXPECT_TRUE(walker.state.waitFor(
        [](const MotionState& each) { return moves(each, Movement::WALK) && moves(each, Movement::TRAJECTORY); }));
    EXPECT_TRUE(walker.state.waitFor([](const MotionState& each) {
      return moves(each, Movement::WALK) && lastEnd(each).movement.kind == Movement::TRAJECTORY &&
             lastEnd(each).how == EndedMovement::DONE;
    }));
    walker.state.clear();
  }
}

TEST(Walk, IsUnknownToVersion1) {
  TopicListener<tf2_msgs::TFMessage> tf("/walk1/tf");
  Walker walker("/walk1", {}, {"--protocol-version", "1"});
  walker.publish("cmd_vel", JointUser::twist(0.1));
  walker.waitForWarning("walk is refused.*speaks version 1");
  const Trigger::Response response = walker.call<Trigger>("sit");
  EXPECT_FALSE(response.success);
  EXPECT_THAT(response.message, HasSubstr("speaks version 1"));
  EXPECT_EQ(walker.odom.count(), 0u);
  EXPECT_TRUE(tf.waitFor([](const tf2_msgs::TFMessage& each) {
    return each.transforms[0].child_frame_id == "rex/base_footprint" &&
           each.transforms[0].header.frame_id == "rex/odom";
  })) << "it stands where it began";
}

TEST(Posture, IsTakenAndSaidInTheMotionState) {
  Walker walker("/posture");
  for (const std::string name : {"sit", "stand", "rest"}) {
    const Trigger::Response response = walker.call<Trigger>(name);
    EXPECT_TRUE(response.success) << response.message;
    EXPECT_TRUE(walker.state.waitFor([&name](const MotionState& each) {
      return !each.movements.empty() && each.movements[0].kind == Movement::POSTURE && each.movements[0].name == name;
    }));
  }
}

TEST(Posture, IsEndedByAnotherOne) {
  Walker walker("/two_postures");
  std::thread other([&walker] {
    EXPECT_TRUE(walker.state.waitFor([](const MotionState& each) { return moves(each, Movement::POSTURE); }));
    EXPECT_TRUE(walker.call<Trigger>("stand").success) << "it does not wait";
  });
  const Trigger::Response response = walker.call<Trigger>("sit");
  other.join();
  EXPECT_FALSE(response.success);
  EXPECT_THAT(response.message, HasSubstr("The robot does not sit: "));
}

TEST(Posture, IsEndedByStop) {
  Walker walker("/posture_stop");
  std::thread stopper([&walker] {
    EXPECT_TRUE(walker.state.waitFor([](const MotionState& each) { return moves(each, Movement::POSTURE); }));
    EXPECT_TRUE(walker.call<Trigger>("stop").success);
  });
  const Trigger::Response response = walker.call<Trigger>("sit");
  stopper.join();
  EXPECT_FALSE(response.success);
  EXPECT_THAT(response.message, HasSubstr("The robot does not sit: "));
}

// A pseudo terminal, in which somebody types.
class Keyboard {
 public:
  Keyboard() : is_open_(::openpty(&keys_, &terminal_, name_, nullptr, nullptr) == 0) {}
  ~Keyboard() {
    ::close(keys_);
    ::close(terminal_);
  }

  Keyboard(const Keyboard&) = delete;
  Keyboard& operator=(const Keyboard&) = delete;

  /// False if the system gives no pseudo terminal, as in a container without /dev/pts.
  bool isOpen() const { return is_open_; }

  void type(char key) { EXPECT_EQ(::write(keys_, &key, 1), 1); }

  bool showsKeys() const {
    termios settings{};
    EXPECT_EQ(::tcgetattr(terminal_, &settings), 0);
    return (settings.c_lflag & ECHO) != 0;
  }

  /// The command line of a program that reads from it.
  std::vector<std::string> start(const std::string& command) const {
    return {"/bin/sh", "-c", "exec " + command + " < " + name_};
  }

 private:
  int keys_ = -1;
  int terminal_ = -1;
  char name_[64] = {};
  const bool is_open_;
};

bool goes(const Twist& twist) {
  return twist.linear.x != 0 || twist.linear.y != 0 || twist.angular.z != 0;
}

TEST(KeyboardTeleop, WalksWhileAKeyIsHeldDownAndLeavesTheTerminalAsItWas) {
  TopicListener<Twist> commands("/keys/cmd_vel");
  Keyboard keyboard;
  if (!keyboard.isOpen()) {
    GTEST_SKIP() << "this system gives no pseudo terminal: is /dev/pts mounted?";
  }
  Process teleop(keyboard.start(std::string(AIBO_TELEOP_KEYBOARD) + " __ns:=/keys"));
  teleop.waitForOutput("speeds: 0.100 m/s", kSafetyNet);
  EXPECT_FALSE(keyboard.showsKeys());
  keyboard.type('w');
  teleop.waitForOutput("speeds: 0.110 m/s", kSafetyNet);
  EXPECT_EQ(commands.count(), 0u) << "others may steer while no key is pressed";
  keyboard.type('i');
  ASSERT_TRUE(commands.waitFor([](const Twist& each) { return std::abs(each.linear.x - 0.11) < 1e-9; }));
  ASSERT_TRUE(commands.waitFor([](const Twist& each) { return !goes(each); })) << "the key was let go";
  EXPECT_GT(commands.count(), 2u) << "meanwhile it is repeated";
  commands.clear();
  keyboard.type(' ');
  ASSERT_TRUE(commands.waitFor([](const Twist& each) { return !goes(each); })) << "it stops a walk to a goal, too";
  commands.clear();
  keyboard.type('j');
  ASSERT_TRUE(commands.waitFor([](const Twist& each) { return each.angular.z == 0.5; }));
  keyboard.type(' ');
  ASSERT_TRUE(commands.waitFor([](const Twist& each) { return !goes(each); }));
  commands.clear();
  keyboard.type('J');
  ASSERT_TRUE(commands.waitFor([](const Twist& each) { return each.linear.y > 0; }));
  teleop.signal(SIGINT);
  EXPECT_EQ(teleop.waitForExit(kSafetyNet), 0);
  EXPECT_TRUE(commands.waitFor([](const Twist& each) { return !goes(each); })) << "it ends with a stop";
  EXPECT_TRUE(keyboard.showsKeys());
  for (const int end : {SIGTERM, SIGHUP}) {
    Process another(keyboard.start(std::string(AIBO_TELEOP_KEYBOARD) + " __ns:=/keys"));
    another.waitForOutput("speeds", kSafetyNet);
    another.signal(end);
    EXPECT_EQ(another.waitForExit(kSafetyNet), 0) << end;
    EXPECT_TRUE(keyboard.showsKeys()) << end;
  }
}

TEST(KeyboardTeleop, SaysOnceWhyAKeyDoesNotMoveTheRobot) {
  Keyboard keyboard;
  if (!keyboard.isOpen()) {
    GTEST_SKIP() << "this system gives no pseudo terminal: is /dev/pts mounted?";
  }
  MotionState state;
  const auto end = [&state](const char* source, const char* reason) {
    EndedMovement& ended = state.ended.emplace_back();
    ended.movement.kind = Movement::WALK;
    ended.movement.source = source;
    ended.how = EndedMovement::REFUSED;
    ended.reason = reason;
  };
  Process teleop(keyboard.start(std::string(AIBO_TELEOP_KEYBOARD) + " __ns:=/refused __name:=keys"));
  teleop.waitForOutput("speeds", kSafetyNet);
  TopicPublishers driver("/refused");
  end("/refused/keys", "before it listened");
  driver.publish("motion_state", state);
  for (const char* reason : {"the floor ends ahead", "the floor ends ahead; let go first", "it fell"}) {
    end("/refused/keys", reason);
    end("/another", "another's");
    driver.publish("motion_state", state);
  }
  teleop.waitForOutput("does not walk: the floor ends ahead.\n(.|\n)*does not walk: it fell\\.", kSafetyNet);
  EXPECT_THAT(teleop.output(), ::testing::Not(::testing::ContainsRegex("before|another|let go")));
}

TEST(KeyboardTeleop, EndsWithTheTerminal) {
  auto keyboard = std::make_unique<Keyboard>();
  if (!keyboard->isOpen()) {
    GTEST_SKIP() << "this system gives no pseudo terminal: is /dev/pts mounted?";
  }
  Process teleop(keyboard->start(std::string(AIBO_TELEOP_KEYBOARD) + " __ns:=/closed"));
  teleop.waitForOutput("speeds", kSafetyNet);
  keyboard.reset();
  teleop.waitForOutput("terminal was closed", kSafetyNet);
  EXPECT_EQ(teleop.waitForExit(kSafetyNet), 1);
}

TEST(KeyboardTeleop, RefusesSpeedsThatCannotBe) {
  for (const char* parameter : {"speed", "side_speed", "turn_speed", "key_timeout"}) {
    for (const char* value : {"-0.1", "61", "nan"}) {
      Process teleop({AIBO_TELEOP_KEYBOARD, "__ns:=/wrong_keys", std::string("_") + parameter + ":=" + value});
      teleop.waitForOutput(
          std::string("/aibo_teleop_keyboard/") + parameter + " is " + value + ".*; it must be a number, 0\\.\\.",
          kSafetyNet);
      EXPECT_EQ(teleop.waitForExit(kSafetyNet), 1);
      ros::param::del("/wrong_keys");
    }
  }
}

TEST(KeyboardTeleop, SaysThatItNeedsATerminalAndAMaster) {
  Process without_terminal({"/bin/sh", "-c", std::string("exec ") + AIBO_TELEOP_KEYBOARD + " < /dev/null"});
  without_terminal.waitForOutput("Start it in a terminal of its own", kSafetyNet);
  EXPECT_EQ(without_terminal.waitForExit(kSafetyNet), 1);
  Process without_master({AIBO_TELEOP_KEYBOARD}, {{"ROS_MASTER_URI", "http://127.0.0.1:1"}});
  without_master.waitForOutput("no ROS master at http://127.0.0.1:1", kSafetyNet);
  EXPECT_EQ(without_master.waitForExit(kSafetyNet), 1);
}

TEST(JoystickTeleop, EachAxisHasItsDirectionAndSpeedWithoutParameters) {
  TopicListener<Twist> commands("/usual/cmd_vel");
  TopicListener<sensor_msgs::JointState> heads("/usual/joint_command");
  TopicPublishers joystick("/usual");
  const Process teleop({AIBO_TELEOP_JOY, "__ns:=/usual", "/joy:=/usual/joy"});
  sensor_msgs::Joy joy;
  joy.axes = {0.28F, 0.55F, 1, 1, -0.55F, 1, -1};  // turn, forward, nothing, pan, tilt, nothing, left
  joy.buttons = {0, 0, 0, 0, 1, 0};
  sensor_msgs::JointState measured;
  measured.name = {"head_tilt", "head_pan"};
  measured.position = {0.2, 0.3};
  const auto end = std::chrono::steady_clock::now() + kSafetyNet;
  while (heads.count() < 2 && std::chrono::steady_clock::now() < end) {
    joystick.publish("joint_states", measured);
    joystick.publish("joy", joy);  // again, as joysticks do
    commands.waitForNext(std::chrono::milliseconds(50));
  }
  ASSERT_GE(heads.count(), 2U);
  const auto walk = commands.waitForCount(1).front();
  EXPECT_NEAR(walk->linear.x, 0.15 * 0.5, 1e-6);
  EXPECT_NEAR(walk->linear.y, -0.06, 1e-6);
  EXPECT_NEAR(walk->angular.z, 0.2, 1e-6);
  const auto head = heads.waitForCount(2)[1];
  EXPECT_EQ(head->velocity, std::vector<double>(2, 1.5));
  EXPECT_GT(head->position.at(0), 0.3);
  EXPECT_NEAR(head->position.at(0) - 0.3, -2 * (head->position.at(1) - 0.2), 1e-6);
}

TEST(JoystickTeleop, TurnsTheHeadTakesPicturesPlaysMotionsAndStops) {
  Walker walker("/gamepad");
  TopicPublishers joystick("/gamepad_of");
  ros::param::set("/gamepad/aibo_teleop_joy/motions", std::map<std::string, int>{{"WAG", 2}});
  ros::param::set("/gamepad/aibo_teleop_joy/postures",
                  std::map<std::string, int>{{"sit", 5}, {"stand", -1}, {"rest", -1}});
  Process teleop({AIBO_TELEOP_JOY, "__ns:=/gamepad", "/joy:=/gamepad_of/joy"}, {{"TZ", "Here-9:30"}});
  sensor_msgs::Joy joy;
  joy.axes = std::vector<float>(7, 0.0F);
  const auto press = [&joy, &joystick](const std::vector<std::size_t>& pressed) {
    joy.buttons.assign(6, 0);
    for (const std::size_t button : pressed) {
      joy.buttons[button] = 1;
    }
    joystick.publish("joy", joy);
  };
  const auto minute = [] {
    const std::time_t now = std::time(nullptr) + 9 * 3600 + 1800;
    std::array<char, 20> text{};
    std::strftime(text.data(), text.size(), "%Y%m%d_%H%M", std::gmtime(&now));
    return std::string(text.data());
  };
  const std::string before = minute();
  press({0});
  teleop.waitForOutput("/gamepad/take_picture: .*Saved to .*aibo_.*jpg", kSafetyNet);
  EXPECT_THAT(teleop.output(), AnyOf(HasSubstr("aibo_" + before), HasSubstr("aibo_" + minute())));
  press({4});
  press({4, 2});
  teleop.waitForOutput("/gamepad/play_motion: WAG.MTN has begun", kSafetyNet);
  joy.axes[3] = 1;
  std::atomic<bool> holds{true};
  std::thread hand([&] {
    for (int i = 0; holds; ++i) {
      press(i % 2 == 0 ? std::vector<std::size_t>{4, 0} : std::vector<std::size_t>{4});
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  });
  EXPECT_TRUE(walker.waitForPanBeyond(1.0));
  holds = false;
  hand.join();
  const std::string said = teleop.output();
  const std::regex saved("Saved to .*");
  std::multiset<std::string> pictures;
  for (std::sregex_iterator each(said.begin(), said.end(), saved), end; each != end; ++each) {
    pictures.insert(each->str());
  }
  EXPECT_EQ(std::set<std::string>(pictures.begin(), pictures.end()).size(), pictures.size()) << "each has its name";
  joy.axes[3] = 0;
  press({4, 5});
  EXPECT_TRUE(walker.state.waitFor([](const MotionState& each) { return moves(each, Movement::POSTURE); }));
  press({1});
  // The head may end with it, and be the last.
  EXPECT_TRUE(walker.state.waitFor([](const MotionState& each) {
    return std::any_of(each.ended.begin(), each.ended.end(), [](const EndedMovement& end) {
      return end.movement.kind == Movement::POSTURE && end.how == EndedMovement::STOPPED;
    });
  })) << "the stop did not wait for the posture";
  teleop.waitForOutput("/gamepad/stop: ", kSafetyNet);
}

TEST(JoystickTeleop, RefusesAWrongMapping) {
  Process teleop({AIBO_TELEOP_JOY, "__ns:=/wrong_joystick", "_dead_man_button:=-1"});
  teleop.waitForOutput("dead_man_button is -1; it must be", kSafetyNet);
  EXPECT_EQ(teleop.waitForExit(kSafetyNet), 1);
  for (const std::string place : {"stop_button", "tilt_axis", "motions/WAG", "postures/sit"}) {
    ros::param::del("/wrong_joystick");
    Process unplugged({AIBO_TELEOP_JOY, "__ns:=/wrong_joystick", "_" + place + ":=-2"});
    unplugged.waitForOutput(place + " is -2; it must be a place in sensor_msgs/Joy, from 0 on, or -1", kSafetyNet);
    EXPECT_EQ(unplugged.waitForExit(kSafetyNet), 1);
  }
  ros::param::del("/wrong_joystick");
  Process spelt_out({AIBO_TELEOP_JOY, "__ns:=/wrong_joystick", "_stop_button:=two"});
  spelt_out.waitForOutput("stop_button is the text 'two'; it must be a place in sensor_msgs/Joy", kSafetyNet);
  EXPECT_EQ(spelt_out.waitForExit(kSafetyNet), 1);
  ros::param::set("/wrong_posture/aibo_teleop_joy/postures", std::map<std::string, int>{{"fly", 2}});
  Process flying({AIBO_TELEOP_JOY, "__ns:=/wrong_posture"});
  ros::param::set("/one_motion/aibo_teleop_joy/motions", 2);
  Process playing({AIBO_TELEOP_JOY, "__ns:=/one_motion"});
  playing.waitForOutput("motions should have a button for each name", kSafetyNet);
  EXPECT_EQ(playing.waitForExit(kSafetyNet), 1);
  flying.waitForOutput("the postures are stand, sit and rest", kSafetyNet);
  EXPECT_EQ(flying.waitForExit(kSafetyNet), 1);
}

#ifdef AIBO_JOY
TEST(JoystickReader, WaitsForAJoystickWithANumber) {
  for (const char* device : {"/dev/input/js", "/dev/input/js123", ""}) {
    Process joy({AIBO_JOY, std::string("_dev:=") + device});
    joy.waitForOutput("dev is '" + std::string(device) + "'; it should be /dev/input/js0 for the first", kSafetyNet);
    EXPECT_EQ(joy.waitForExit(kSafetyNet), 1);
    ros::param::del("/aibo_joy");
  }
  for (const char* parameter : {"deadzone", "autorepeat_rate"}) {
    Process joy({AIBO_JOY, std::string("_") + parameter + ":=101"});
    joy.waitForOutput(parameter + std::string(" is 101"), kSafetyNet);
    EXPECT_EQ(joy.waitForExit(kSafetyNet), 1);
    ros::param::del("/aibo_joy");
  }
  Process joy({AIBO_JOY, "_dev:=/dev/input/js31"});
  joy.waitForOutput("Waiting for a joystick", kSafetyNet);
  EXPECT_TRUE(joy.isRunning());
}
#endif

TEST(PythonExample, StandsLooksTakesAPictureAndWalks) {
  Walker walker("/python");
  const test_support::TemporaryFolder folder;
  // catkin's environment for tests lacks this path when the build folder is new.
  const std::string run = "export PYTHONPATH=" PYTHON_MESSAGES "${PYTHONPATH:+:$PYTHONPATH}; cd " +
                          folder.path().string() + " && exec python3 " LOOK_AND_WALK " __ns:=/python";
  Process program({"/bin/sh", "-c", run});
  EXPECT_TRUE(
      walker.state.waitFor([](const MotionState& each) { return lastEnd(each).movement.kind == Movement::POSTURE; }));
  EXPECT_TRUE(walker.state.waitFor([](const MotionState& each) { return moves(each, Movement::WALK); }));
  program.waitForOutput("look.jpg has [0-9]+ bytes", kSafetyNet);
  EXPECT_EQ(program.waitForExit(kSafetyNet), 0);
  const auto end = walker.waitForEnd();
  ASSERT_TRUE(end);
  EXPECT_EQ(lastEnd(*end).how, EndedMovement::DONE) << lastEnd(*end).reason;
  EXPECT_GT(std::filesystem::file_size(folder.path() / "look.jpg"), 1000U);
}

}  // namespace
