// The programs that steer: from the keys of a terminal, and from a gamepad. The driver is a fake.

#include <aibo_driver/PlayMotion.h>
#include <aibo_driver/TakePicture.h>
#include <gmock/gmock.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/Joy.h>

#include <csignal>

#include "ros/driver_user.h"
#include "ros/fake_driver.h"
#include "support/pseudo_terminal.h"

namespace {

using geometry_msgs::Twist;
using test_support::FakeDriver;
using test_support::kSafetyNet;
using test_support::Process;
using test_support::TopicListener;
using test_support::TopicPublishers;

bool goes(const Twist& twist) {
  return twist.linear.x != 0 || twist.linear.y != 0 || twist.angular.z != 0;
}

class KeyboardTest : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!keys_.exists()) {
      GTEST_SKIP() << "this system gives no pseudo terminal: is /dev/pts mounted?";
    }
  }

  std::vector<std::string> command(const std::string& arguments) const {
    return {"/bin/sh", "-c", std::string("exec ") + AIBO_TELEOP_KEYBOARD + " " + arguments + " < " + keys_.name()};
  }

  test_support::PseudoTerminal keys_;
};

TEST_F(KeyboardTest, WalksWhileAKeyIsHeldDownAndThenStops) {
  TopicListener<Twist> commands("/keys/cmd_vel");
  Process teleop(command("__ns:=/keys _speed:=0.2"));
  teleop.waitForOutput("speeds: 0\\.200 m/s, sideways 0\\.050 m/s, turn 0\\.50 rad/s");
  EXPECT_THAT(teleop.output(), testing::HasSubstr("Hold a key down to walk:\n"));
  EXPECT_EQ(commands.count(), 0u) << "others may steer while no key is pressed";
  const ros::SteadyTime pressed = ros::SteadyTime::now();
  keys_.type("i");
  ASSERT_TRUE(commands.waitFor([](const Twist& each) { return each.linear.x == 0.2; }));
  EXPECT_TRUE(commands.waitFor([](const Twist& each) { return !goes(each); })) << "the key was let go";
  EXPECT_GE((ros::SteadyTime::now() - pressed).toSec(), 0.8);
  EXPECT_GT(commands.count(), 2u) << "meanwhile it is repeated";
}

TEST_F(KeyboardTest, EndsWithAStopHoweverItIsEnded) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    TopicListener<Twist> commands("/ended_keys/cmd_vel");
    Process teleop(command("__ns:=/ended_keys _key_timeout:=0"));
    teleop.waitForOutput("speeds");
    keys_.type("i");
    ASSERT_TRUE(commands.waitFor(goes));
    teleop.signal(signal);
    EXPECT_EQ(teleop.waitForExit(kSafetyNet), 0) << signal;
    EXPECT_TRUE(commands.waitFor([](const Twist& each) { return !goes(each); })) << signal;
  }
}

TEST_F(KeyboardTest, SaysOnceWhyAKeyDoesNotMoveTheRobot) {
  aibo_driver::MotionState state;
  const auto end = [&state](const char* source, const char* reason) {
    aibo_driver::EndedMovement& ended = state.ended.emplace_back();
    ended.movement.kind = aibo_driver::Movement::WALK;
    ended.movement.source = source;
    ended.how = aibo_driver::EndedMovement::REFUSED;
    ended.reason = reason;
  };
  Process teleop(command("__ns:=/refused __name:=keys"));
  teleop.waitForOutput("speeds");
  TopicPublishers driver("/refused");
  end("/refused/keys", "before it listened");
  driver.publish("motion_state", state);
  for (const char* reason : {"the floor ends ahead", "the floor ends ahead; let go first", "it fell"}) {
    end("/refused/keys", reason);
    end("/another", "another's");
    driver.publish("motion_state", state);
  }
  teleop.waitForOutput("does not walk: the floor ends ahead.\n(.|\n)*does not walk: it fell\\.");
  EXPECT_THAT(teleop.output(), testing::Not(testing::ContainsRegex("before|another|let go")));
}

TEST_F(KeyboardTest, SaysWhoHasStoppedTheRobotAndReleasesIt) {
  FakeDriver driver("/board");
  driver.stop("/user");
  Process teleop(command("__ns:=/board"));
  teleop.waitForOutput("/user has stopped the robot. R .capital. lets it move again");
  keys_.type("R");
  teleop.waitForOutput("The robot may move again");
  keys_.type("S");
  teleop.waitForOutput("/caller has stopped the robot");
}

TEST(Keyboard, SaysWhyItCannotStart) {
  const std::map<std::string, std::string> no_master{{"ROS_MASTER_URI", "http://127.0.0.1:1"}};
  const std::tuple<std::string, std::map<std::string, std::string>, const char*> rows[] = {
      {"__ns:=/wrong_speed _speed:=-0.1", {}, "/speed is -0.1.*; it must be a number, 0\\.\\.1\\."},
      {"__ns:=/wrong_side _side_speed:=1.1", {}, "/side_speed is 1.1.*; it must be a number, 0\\.\\.1\\."},
      {"__ns:=/wrong_turn _turn_speed:=10.1", {}, "/turn_speed is 10.1.*; it must be a number, 0\\.\\.10\\."},
      {"__ns:=/wrong_timeout _key_timeout:=60.1", {}, "/key_timeout is 60.1.*; it must be a number, 0\\.\\.60\\."},
      {"< /dev/null", {}, "Start it in a terminal of its own"},
      {"", no_master, "no ROS master at http://127.0.0.1:1"},
  };
  for (const auto& [arguments, environment, complaint] : rows) {
    Process teleop({"/bin/sh", "-c", std::string("exec ") + AIBO_TELEOP_KEYBOARD + " " + arguments}, environment);
    EXPECT_NO_THROW(teleop.waitForOutput(complaint));
    EXPECT_EQ(teleop.waitForExit(kSafetyNet), 1) << arguments;
  }
}

// A gamepad with aibo_teleop_joy, in a namespace.
class Gamepad {
 public:
  static constexpr std::size_t kPicture = 0;
  static constexpr std::size_t kStop = 1;
  static constexpr std::size_t kDeadMan = 4;
  static constexpr std::size_t kRelease = 5;

  explicit Gamepad(const std::string& name_space, const std::vector<std::string>& parameters = {})
      : joystick_(name_space), teleop_(command(name_space, parameters)) {
    press({});  // waits until it listens
  }

  void press(const std::vector<std::size_t>& pressed, const std::vector<float>& axes = std::vector<float>(7)) {
    sensor_msgs::Joy joy;
    joy.axes = axes;
    joy.buttons.resize(8);
    for (const std::size_t button : pressed) {
      joy.buttons[button] = 1;
    }
    joystick_.publish("joy", joy);
  }

  Process& teleop() { return teleop_; }

 private:
  static std::vector<std::string> command(const std::string& name_space, const std::vector<std::string>& parameters) {
    std::vector<std::string> words{AIBO_TELEOP_JOY, "__ns:=" + name_space, "/joy:=" + name_space + "/joy",
                                   "_release_button:=" + std::to_string(kRelease)};
    words.insert(words.end(), parameters.begin(), parameters.end());
    return words;
  }

  TopicPublishers joystick_;
  Process teleop_;
};

struct Mapping {
  const char* name_space;
  std::vector<std::string> parameters;
  std::vector<float> axes;  ///< 0.55 forward, 0.28 of a turn, fully to the right; the head to the right and up
  double forward, left, turn, head_speed;
};

TEST(GamepadTest, EachAxisHasItsDirectionAndSpeed) {
  const Mapping rows[] = {
      {"/usual", {}, {0.28F, 0.55F, 1, -0.55F, 1, 1, -1}, 0.05, -0.05, 0.1, 1.5},
      {"/other",
       {"_turn_axis:=1", "_forward_axis:=0", "_left_axis:=2", "_pan_axis:=4", "_tilt_axis:=3", "_speed:=0.1",
        "_side_speed:=0.05", "_turn_speed:=2", "_head_speed:=3"},
       {0.55F, 0.28F, -1, 1, -0.55F, 0, 0},
       0.05,
       -0.05,
       0.4,
       4.5},
  };
  for (const Mapping& row : rows) {
    const FakeDriver driver(row.name_space);
    TopicListener<Twist> walks(std::string(row.name_space) + "/cmd_vel");
    TopicListener<sensor_msgs::JointState> heads(std::string(row.name_space) + "/joint_command");
    TopicPublishers robot(row.name_space);
    Gamepad pad(row.name_space, row.parameters);
    sensor_msgs::JointState measured;
    measured.name = {"head_tilt", "head_pan"};
    measured.position = {0.2, 0.3};
    ASSERT_TRUE(test_support::DriverUser::becomesTrue([&] {
      robot.publish("joint_states", measured);
      pad.press({Gamepad::kDeadMan}, row.axes);  // again, as joysticks do
      walks.waitForNext(std::chrono::milliseconds(50));
      return heads.count() > 1 && walks.count() > 0;
    }));
    const auto walk = walks.waitForCount(1).front();
    EXPECT_NEAR(walk->linear.x, row.forward, 1e-6) << row.name_space;
    EXPECT_NEAR(walk->linear.y, row.left, 1e-6) << row.name_space;
    EXPECT_NEAR(walk->angular.z, row.turn, 1e-6) << row.name_space;
    const auto head = heads.waitForCount(2)[1];
    EXPECT_EQ(head->velocity, std::vector<double>(2, row.head_speed)) << "the head can keep up";
  }
}

TEST(GamepadTest, EachButtonCallsItsService) {
  const FakeDriver driver("/pad");
  ros::NodeHandle handle("/pad");
  std::mutex mutex;
  std::string calls;
  const auto note = [&](const std::string& call) {
    const std::lock_guard<std::mutex> lock(mutex);
    calls += call + ";";
    return true;
  };
  using aibo_driver::PlayMotion;
  using aibo_driver::TakePicture;
  const ros::ServiceServer services[] = {
      handle.advertiseService<std_srvs::Trigger::Request, std_srvs::Trigger::Response>(
          "sit", [&](auto&, auto&) { return note("sit"); }),
      handle.advertiseService<PlayMotion::Request, PlayMotion::Response>(
          "play_motion",
          [&](auto& order, auto&) { return note(order.name + " " + std::to_string(order.repetitions)); }),
      handle.advertiseService<TakePicture::Request, TakePicture::Response>(
          "take_picture", [&](auto& order, auto&) { return note(order.save_to); })};
  ros::param::set("/pad/aibo_teleop_joy/motions", std::map<std::string, int>{{"NOD", 6}});
  ros::param::set("/pad/aibo_teleop_joy/postures", std::map<std::string, int>{{"sit", 7}});
  Gamepad pad("/pad");
  // Again and again, because the call before may not have ended yet.
  const auto calls_with = [&](std::vector<std::size_t> pressed, std::size_t button, const std::string& pattern) {
    return test_support::DriverUser::becomesTrue([&] {
      pad.press(pressed);
      std::vector<std::size_t> both = pressed;
      both.push_back(button);
      pad.press(both);
      const std::lock_guard<std::mutex> lock(mutex);
      return testing::Matches(testing::ContainsRegex(pattern))(calls);
    });
  };
  EXPECT_TRUE(calls_with({}, Gamepad::kPicture, "aibo_.*\\.jpg;"));
  EXPECT_TRUE(calls_with({Gamepad::kDeadMan}, 6, "NOD 1;"));
  EXPECT_TRUE(calls_with({Gamepad::kDeadMan}, 7, "sit;"));
}

TEST(GamepadTest, SaysWhoHasStoppedTheRobotAndReleasesItWithTheDeadManButton) {
  FakeDriver driver("/releasing");
  Gamepad pad("/releasing");
  pad.press({Gamepad::kDeadMan});
  pad.press({Gamepad::kDeadMan, Gamepad::kRelease});  // nobody has stopped the robot
  pad.press({Gamepad::kStop});
  pad.teleop().waitForOutput("/caller has stopped the robot.*together with the dead-man button");
  EXPECT_THAT(pad.teleop().output(), testing::Not(testing::HasSubstr("/release: ")));
  pad.press({Gamepad::kDeadMan});
  pad.press({Gamepad::kDeadMan, Gamepad::kRelease});
  pad.teleop().waitForOutput("The robot may move again");
}

TEST(GamepadTest, StopsWhileAReleaseWaitsForItsAnswer) {
  std::promise<void> called;
  std::promise<void> may_answer;
  FakeDriver driver("/late", [&] {
    called.set_value();
    may_answer.get_future().wait_for(kSafetyNet);
  });
  driver.stop("/user");
  Gamepad pad("/late");
  pad.teleop().waitForOutput("/user has stopped the robot");
  pad.press({Gamepad::kDeadMan, Gamepad::kRelease});
  ASSERT_EQ(called.get_future().wait_for(kSafetyNet), std::future_status::ready);
  pad.press({Gamepad::kStop});
  EXPECT_NO_THROW(pad.teleop().waitForOutput("/late/stop: "));
  may_answer.set_value();
}

TEST(GamepadTest, SeesAShortPressOfStopAlsoIfItWasHeldUp) {
  FakeDriver driver("/held");
  Gamepad pad("/held");
  pad.teleop().signal(SIGSTOP);
  pad.press({Gamepad::kStop});
  for (int i = 0; i < 20; ++i) {
    pad.press({});
  }
  pad.teleop().signal(SIGCONT);
  pad.teleop().waitForOutput("/held/stop: ");
}

TEST(GamepadTest, SaysWhichOfItsParametersIsWrong) {
  const std::pair<const char*, const char*> rows[] = {
      {"_dead_man_button:=-1", "dead_man_button is -1; it must be"},
      {"_motions/WAG:=-2", "motions/WAG is -2; it must be a place"},
      {"_postures/fly:=2", "the postures are stand, sit and rest"},
      {"_picture_button:=4", "Button 4 is dead_man_button and picture_button; each needs its own, or -1"},
      {"_motions:=2", "motions should have a button for each name"},
      {"_head_speed:=10.1", "head_speed is 10.1.*; it must be a number, 0\\.\\.10\\."},
      {"_dead_zone:=0.91", "dead_zone is 0.91.*; it must be a number, 0\\.\\.0\\.9\\."},
  };
  for (const auto& [parameter, complaint] : rows) {
    Process node({AIBO_TELEOP_JOY, "__ns:=/wrong_joystick", parameter});
    EXPECT_NO_THROW(node.waitForOutput(complaint)) << parameter;
    EXPECT_EQ(node.waitForExit(kSafetyNet), 1) << parameter;
    ros::param::del("/wrong_joystick");
  }
}

}  // namespace
