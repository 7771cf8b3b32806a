// The programs that steer, or that move the robot by themselves, while somebody has stopped it. The driver is a fake.

#include <aibo_driver/Connection.h>
#include <aibo_driver/LookAtResult.h>
#include <aibo_driver/MotionState.h>
#include <aibo_driver/PlayMotion.h>
#include <aibo_driver/RobotState.h>
#include <geometry_msgs/PointStamped.h>
#include <geometry_msgs/Twist.h>
#include <gmock/gmock.h>
#include <pty.h>
#include <ros/network.h>
#include <ros/ros.h>
#include <ros/xmlrpc_manager.h>
#include <sensor_msgs/CompressedImage.h>
#include <sensor_msgs/Image.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/Joy.h>
#include <std_srvs/Trigger.h>
#include <sys/socket.h>
#include <trajectory_msgs/JointTrajectory.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <future>
#include <map>
#include <mutex>
#include <string>
#include <vector>

#include "support/process.h"
#include "support/ros/topic_listener.h"
#include "support/ros/topic_publishers.h"
#include "support/sockets.h"
#include "tools/node_process.h"

namespace {

using aibo_driver::LookAtResult;
using aibo_driver::MotionState;
using aibo_driver::Movement;
using aibo_driver::RobotState;
using geometry_msgs::Twist;
using std_srvs::Trigger;
using test_support::kSafetyNet;
using test_support::Process;
using test_support::TopicListener;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using trajectory_msgs::JointTrajectory;

/// What these programs see of a driver.
class FakeDriver {
 public:
  explicit FakeDriver(const std::string& name_space, bool is_slow = false) : handle_(name_space), is_slow_(is_slow) {
    constexpr bool kLatched = true;
    state_ = handle_.advertise<RobotState>("robot_state", 1, kLatched);
    motion_ = handle_.advertise<MotionState>("motion_state", 10, kLatched);
    joints_ = handle_.advertise<sensor_msgs::JointState>("joint_states", 1);
    mask_ = handle_.advertise<sensor_msgs::Image>("color_mask", 1);
    release_ = handle_.advertiseService<Trigger::Request, Trigger::Response>(
        "release", [this](Trigger::Request&, Trigger::Response& response) {
          if (is_slow_) {
            release_was_called_.set_value();
            may_answer_.get_future().wait_for(kSafetyNet);
          }
          response.success = 1;
          release();
          return true;
        });
    stop_ = handle_.advertiseService<Trigger::Request, Trigger::Response>(
        "stop", [this](Trigger::Request&, Trigger::Response& response) {
          stop("/caller");
          response.success = 1;
          return true;
        });
    motion_.publish(MotionState());
    release();
    // Not a ros::Timer: one of its callbacks can come after the destructor has stopped it.
    senses_ = std::async(std::launch::async, [this, end = end_.get_future()] {
      constexpr std::chrono::milliseconds kPeriod{50};
      while (end.wait_for(kPeriod) == std::future_status::timeout) {
        sense();
      }
    });
  }

  ~FakeDriver() {
    end_.set_value();
    senses_.wait();
  }

  FakeDriver(const FakeDriver&) = delete;
  FakeDriver& operator=(const FakeDriver&) = delete;

  void stop(const std::string& node) {
    const std::lock_guard<std::mutex> lock(mutex_);
    state_now_.stopped = 1;
    state_now_.stopped_by = node;
    state_.publish(state_now_);
  }

  void release() {
    const std::lock_guard<std::mutex> lock(mutex_);
    state_now_.stopped = 0;
    state_now_.stopped_by.clear();
    state_.publish(state_now_);
  }

  /// Of a slow driver, once: it does not answer until it is told to.
  bool waitForCallOfRelease() {
    return release_was_called_.get_future().wait_for(kSafetyNet) == std::future_status::ready;
  }
  void answerRelease() { may_answer_.set_value(); }

  void tell(std::uint8_t motors, std::uint8_t posture) {
    const std::lock_guard<std::mutex> lock(mutex_);
    state_now_.motors = motors;
    state_now_.posture = posture;
    state_.publish(state_now_);
  }

  /// Whether the robot sees and measures anything.
  void setAwake(bool is_awake) {
    const std::lock_guard<std::mutex> lock(mutex_);
    is_awake_ = is_awake;
  }

  /// What moves the robot from now on.
  void move(const std::vector<Movement>& movements) {
    MotionState state;
    state.movements = movements;
    motion_.publish(state);
  }

  /// The camera sees a ball of this width. All in pixels of the mask; 0: no ball.
  void showBall(unsigned left, unsigned width) {
    const std::lock_guard<std::mutex> lock(mutex_);
    ball_left_ = left;
    ball_width_ = width;
  }

  void takePosture(bool takes) {
    Movement posture;
    posture.kind = Movement::POSTURE;
    posture.name = "sit";
    posture.source = "/somebody";
    move(takes ? std::vector<Movement>{Movement(), posture} : std::vector<Movement>{Movement()});
  }

 private:
  void sense() {
    sensor_msgs::Image black;
    black.width = 104;
    black.height = 80;
    black.step = 3 * black.width;
    black.encoding = "rgb8";
    black.data.resize(black.step * black.height);
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      if (!is_awake_) {
        return;
      }
      for (unsigned i = 0; i < ball_width_ * ball_width_; ++i) {
        black.data.at((20 + i / ball_width_) * black.step + 3 * (ball_left_ + i % ball_width_)) = 1;
      }
    }
    mask_.publish(black);
    joints_.publish(sensor_msgs::JointState());
  }

  ros::NodeHandle handle_;
  const bool is_slow_;
  std::promise<void> release_was_called_;
  std::promise<void> may_answer_;
  std::mutex mutex_;  ///< of what is told and seen, because services are called on several threads
  RobotState state_now_;
  bool is_awake_ = true;
  unsigned ball_left_ = 0;
  unsigned ball_width_ = 0;
  ros::Publisher state_;
  ros::Publisher motion_;
  ros::Publisher joints_;
  ros::Publisher mask_;
  ros::ServiceServer release_;
  ros::ServiceServer stop_;
  std::promise<void> end_;
  std::future<void> senses_;
};

bool callGoOn(const std::string& node, std::string* message) {
  Trigger service;
  EXPECT_TRUE(ros::service::call(node + "/go_on", service));
  *message = service.response.message;
  return service.response.success != 0;
}

TEST(LookAround, WaitsWhileTheRobotIsStoppedAndGoesOnWhenItIsToldTo) {
  FakeDriver driver("/looks");
  TopicListener<JointTrajectory> glances("/looks/joint_trajectory");
  Process node({AIBO_LOOK_AROUND, "__ns:=/looks"});
  ASSERT_FALSE(glances.waitForCount(1).empty());
  driver.stop("/user");
  node.waitForOutput("/user has stopped the robot.*/looks/aibo_look_around/go_on", kSafetyNet);
  const std::size_t glances_before = glances.count();
  std::string message;
  EXPECT_FALSE(callGoOn("/looks/aibo_look_around", &message));
  EXPECT_THAT(message, HasSubstr("/user has stopped the robot"));
  driver.release();
  EXPECT_EQ(glances.waitForCount(glances_before + 2, std::chrono::seconds(5)).size(), glances_before)
      << "a glance comes every 4 s";
  EXPECT_TRUE(callGoOn("/looks/aibo_look_around", &message)) << message;
  EXPECT_GT(glances.waitForCount(glances_before + 1).size(), glances_before);
}

/// A robot that looks around. Each time it has looked somewhere, it waits 3.5 or 4.5 s by itself.
class LookAroundTest : public ::testing::Test {
 protected:
  /// What becomes of its second glance if something happens after the first one, and ends 5 s later.
  struct Gaze {
    bool waits = false;                          ///< while it happens
    std::vector<JointTrajectory::ConstPtr> all;  ///< soon after its end
    std::chrono::steady_clock::duration time{};  ///< from its beginning until the second glance
  };

  // In parallel with others, because most of the time nothing happens.
  static std::future<Gaze> begin(const std::string& name_space, const std::string& pause,
                                 const std::function<void(FakeDriver&, bool)>& happen, std::size_t glances = 2,
                                 std::chrono::seconds lasts = std::chrono::seconds(5)) {
    return std::async(std::launch::async, [=] {
      FakeDriver driver(name_space);
      TopicListener<JointTrajectory> listener(name_space + "/joint_trajectory");
      const Process node({AIBO_LOOK_AROUND, "__ns:=" + name_space, pause});
      EXPECT_FALSE(listener.waitForCount(1).empty());
      const auto begin = std::chrono::steady_clock::now();
      Gaze gaze;
      happen(driver, true);
      gaze.waits = listener.waitForCount(glances, lasts).size() < glances;
      happen(driver, false);
      gaze.all = listener.waitForCount(glances);
      gaze.time = std::chrono::steady_clock::now() - begin;
      return gaze;
    });
  }

  static std::function<void(FakeDriver&, bool)> movement(std::uint8_t kind, const std::vector<std::string>& joints) {
    return [=](FakeDriver& driver, bool moves) {
      Movement movement;
      movement.source = "/somebody";
      movement.kind = kind;
      movement.joints = joints;
      driver.move(moves ? std::vector<Movement>{movement} : std::vector<Movement>());
    };
  }
};

TEST_F(LookAroundTest, WaitsForWhateverElseMovesTheRobotAndLongerAfterSomebodyHasPointedTheHead) {
  auto walk = begin("/walks", "_pause:=3600", movement(Movement::WALK, {}), 3, kSafetyNet);
  auto tail = begin("/wags", "_pause:=3600", movement(Movement::COMMAND, {"tail_pan"}));
  auto limp = begin("/limp", "_pause:=3600", [](FakeDriver& driver, bool is_limp) {
    driver.tell(is_limp ? RobotState::OFF : RobotState::ON, RobotState::LYING);
  });
  auto neck = begin("/nods", "_pause:=7", [](FakeDriver& driver, bool nods) {
    movement(Movement::COMMAND, {"tail_pan", nods ? "neck_tilt" : "mouth"})(driver, true);
    if (!nods) {
      driver.move({});  // what moved last does not make the pause shorter
    }
  });
  auto head = begin("/turns", "_pause:=7", movement(Movement::TRAJECTORY, {"head_tilt"}));
  for (const Gaze& gaze : {tail.get(), limp.get()}) {
    EXPECT_TRUE(gaze.waits);
    EXPECT_EQ(gaze.all.size(), 2U) << "it does not wait any longer";
  }
  for (const Gaze& gaze : {neck.get(), head.get()}) {
    EXPECT_TRUE(gaze.waits);
    EXPECT_GE(gaze.time, std::chrono::seconds(7));
  }
  const Gaze gaze = walk.get();
  EXPECT_FALSE(gaze.waits) << "a walk moves only the legs";
  ASSERT_EQ(gaze.all.size(), 3U);
  EXPECT_GE(gaze.time, std::chrono::milliseconds(6900)) << "each glance has its time";
  constexpr double kGlances[3][3] = {{2.5, 0.7, 0.1}, {3.5, -0.7, 0.3}, {2.5, 0, 0}};
  const double first = gaze.all[0]->points.at(0).positions.at(0);
  const std::size_t start = first > 0 ? 0 : first < 0 ? 1 : 2;  // the first one may come before the listener is known
  for (std::size_t i = 0; i < 3; ++i) {
    const double* const expected = kGlances[(start + i) % 3];
    EXPECT_THAT(gaze.all[i]->joint_names, ElementsAre("head_pan", "head_tilt"));
    ASSERT_EQ(gaze.all[i]->points.size(), 1U);
    EXPECT_EQ(gaze.all[i]->points[0].time_from_start, ros::Duration(expected[0]));
    EXPECT_THAT(gaze.all[i]->points[0].positions, ElementsAre(expected[1], expected[2]));
    EXPECT_THAT(gaze.all[i]->points[0].velocities, ElementsAre(0, 0));
  }
}

class BallFollower : public ::testing::Test {
 protected:
  void start(const std::vector<std::string>& parameters = {}) {
    std::vector<std::string> command{AIBO_FOLLOW_BALL, "__ns:=/follows"};
    command.insert(command.end(), parameters.begin(), parameters.end());
    node_ = std::make_unique<Process>(command);
    ASSERT_FALSE(steps_.waitForCount(1).empty());
  }

  bool isSilent() {
    steps_.clear();
    return steps_.waitForCount(1, std::chrono::milliseconds(1500)).empty();
  }

  /// What was sent before may still be on its way.
  bool becomesSilent() {
    for (int i = 0; i < 10; ++i) {
      if (isSilent()) {
        return true;
      }
    }
    return false;
  }

  bool walks() {
    steps_.clear();
    return !steps_.waitForCount(1).empty();
  }

  FakeDriver driver_{"/follows"};
  TopicListener<Twist> steps_{"/follows/cmd_vel"};
  std::unique_ptr<Process> node_;
};

TEST_F(BallFollower, WalksToTheBallAndAroundItAndLooksForItWhereItWasLast) {
  start();
  const auto steers = [this](double forward, double left, double turn) {
    return steps_.waitFor([&](const Twist& step) {
      return std::hypot(step.linear.x - forward, step.linear.y - left, step.angular.z - turn) < 1e-3;
    }) != nullptr;
  };
  EXPECT_TRUE(steers(0, 0, 0.4)) << "it has not seen a ball yet";
  driver_.showBall(10, 6);
  EXPECT_TRUE(steers(0.12, 0, 0.569)) << "far away on the left";
  driver_.showBall(65, 16);
  EXPECT_TRUE(steers(0.036, -0.04, -0.306)) << "near on the right";
  steps_.clear();
  driver_.showBall(0, 0);
  EXPECT_TRUE(steers(0, 0, -0.4));
  driver_.showBall(37, 30);
  EXPECT_TRUE(steers(-0.05, -0.04, 0)) << "too near";
  driver_.showBall(0, 6);
  EXPECT_TRUE(steers(0.12, 0, 0.6)) << "it turns no faster";
  test_support::TopicPublishers driver("/follows");
  for (int round = 0; round < 2; ++round) {
    steps_.clear();
    aibo_driver::Connection connection;
    driver.publish("connection", connection);
    connection.state = aibo_driver::Connection::CONNECTED;
    driver.publish("connection", connection);
    EXPECT_TRUE(steers(0, 0, 0)) << "it lets go once";
    steps_.clear();
    EXPECT_TRUE(steers(0.12, 0, 0.6)) << "and goes on";
  }
}

TEST_F(BallFollower, NeedsLeaveToGoOnAfterAStop) {
  start();
  driver_.stop("/user");
  node_->waitForOutput("/user has stopped the robot", kSafetyNet);
  EXPECT_TRUE(becomesSilent());
  driver_.release();
  EXPECT_TRUE(isSilent());
  std::string message;
  EXPECT_TRUE(callGoOn("/follows/aibo_follow_ball", &message)) << message;
  EXPECT_TRUE(walks());
}

TEST_F(BallFollower, NeedsLeaveToGoOnWhenItWasOverruledInAnotherWay) {
  start();
  const auto expect_to_need_leave = [this](const std::string& why, const std::function<void(bool)>& overrule) {
    overrule(true);
    node_->waitForOutput(why, kSafetyNet);
    EXPECT_TRUE(becomesSilent()) << why;
    overrule(false);
    EXPECT_TRUE(isSilent()) << why;
    std::string message;
    EXPECT_TRUE(callGoOn("/follows/aibo_follow_ball", &message)) << message;
    EXPECT_TRUE(walks()) << why;
  };
  expect_to_need_leave("waits: the motors are off", [this](bool is_over) {
    driver_.tell(is_over ? RobotState::OFF : RobotState::ON, RobotState::STANDING);
  });
  expect_to_need_leave("waits: the robot is carried", [this](bool is_over) {
    driver_.tell(RobotState::ON, is_over ? RobotState::CARRIED : RobotState::STANDING);
  });
  expect_to_need_leave("waits: the robot has fallen", [this](bool is_over) {
    driver_.tell(RobotState::ON, is_over ? RobotState::FALLEN : RobotState::STANDING);
  });
  expect_to_need_leave("waits: /somebody has called sit", [this](bool is_over) { driver_.takePosture(is_over); });
}

TEST_F(BallFollower, GoesOnByItselfIfItsUserHasSaidSo) {
  start({"_go_on_after_stop:=true"});
  driver_.stop("/user");
  EXPECT_TRUE(becomesSilent());
  driver_.release();
  EXPECT_TRUE(walks());
  driver_.takePosture(true);
  EXPECT_TRUE(becomesSilent()) << "until the robot has taken it";
  driver_.takePosture(false);
  EXPECT_TRUE(walks());
}

TEST_F(BallFollower, PausesAfterAStopForAsLongAsTheDriverIgnoresItsStream) {
  start({"_go_on_after_stop:=true"});
  for (int round = 0; round < 2; ++round) {
    driver_.setAwake(false);
    EXPECT_TRUE(becomesSilent());
    const auto stopped = std::chrono::steady_clock::now();
    driver_.stop("/user");
    std::string message;
    while (callGoOn("/follows/aibo_follow_ball", &message) &&
           std::chrono::steady_clock::now() < stopped + kSafetyNet) {  // until it knows of the stop
    }
    driver_.release();
    driver_.setAwake(true);
    EXPECT_TRUE(walks());
    EXPECT_GE(std::chrono::steady_clock::now() - stopped, std::chrono::milliseconds(500));
  }
}

// It sees nothing until it knows of the stop, so it has not moved before.
template <typename Step>
void expectToWaitFromItsStart(const std::string& program, const std::string& name, const std::string& topic) {
  FakeDriver driver("/begins");
  driver.setAwake(false);
  driver.stop("/user");
  TopicListener<Step> steps("/begins/" + topic);
  Process node({program, "__ns:=/begins"});
  node.waitForOutput("/user has stopped the robot", kSafetyNet);
  std::string message;
  EXPECT_FALSE(callGoOn("/begins/" + name, &message)) << name;
  driver.setAwake(true);
  driver.release();
  EXPECT_TRUE(steps.waitForCount(1, std::chrono::milliseconds(1500)).empty()) << name;
  EXPECT_TRUE(callGoOn("/begins/" + name, &message)) << message;
  EXPECT_FALSE(steps.waitForCount(1).empty()) << name;
}

TEST(AtTheirStart, ProgramsThatMoveAStoppedRobotWaitForItsReleaseAndForLeave) {
  expectToWaitFromItsStart<Twist>(AIBO_FOLLOW_BALL, "aibo_follow_ball", "cmd_vel");
  expectToWaitFromItsStart<JointTrajectory>(AIBO_LOOK_AROUND, "aibo_look_around", "joint_trajectory");
}

TEST(BallFollowerAtItsStart, WaitsForTheMotorsButForNoLeave) {
  FakeDriver driver("/begins_limp");
  driver.tell(RobotState::OFF, RobotState::LYING);
  TopicListener<Twist> steps("/begins_limp/cmd_vel");
  const Process node({AIBO_FOLLOW_BALL, "__ns:=/begins_limp"});
  EXPECT_TRUE(ros::service::waitForService("/begins_limp/aibo_follow_ball/go_on", ros::Duration(kSafetyNet.count())));
  EXPECT_TRUE(steps.waitForCount(1, std::chrono::milliseconds(1500)).empty());
  driver.tell(RobotState::ON, RobotState::STANDING);
  EXPECT_FALSE(steps.waitForCount(1).empty());
}

TEST(LookAt, SaysWhyTheHeadDoesNotTurn) {
  FakeDriver driver("/stares");
  driver.stop("/user");
  TopicListener<LookAtResult> results("/stares/look_at_result");
  ros::Publisher points = ros::NodeHandle("/stares").advertise<geometry_msgs::PointStamped>("look_at", 1, true);
  geometry_msgs::PointStamped point;
  point.header.frame_id = "base_link";
  const Process node({AIBO_LOOK_AT, "__ns:=/stares"});
  // Again and again: a point may come before the robot's state, and its result before this listener is known.
  const auto says = [&](const std::string& text) {
    const auto end = std::chrono::steady_clock::now() + kSafetyNet;
    bool said = false;
    while (!said && std::chrono::steady_clock::now() < end) {
      points.publish(point);
      for (const auto& result : results.waitForCount(1, std::chrono::milliseconds(200))) {
        said = said || (!result->success && !result->moves && result->message.find(text) != std::string::npos);
      }
      results.clear();
    }
    return said;
  };
  EXPECT_TRUE(says("/user has stopped the robot; call release"));
  driver.release();
  EXPECT_TRUE(says("nobody listens")) << "it would turn, since a robot of version 1 tells nothing of its motors";
  driver.tell(RobotState::OFF, RobotState::LYING);
  EXPECT_TRUE(says("the motors are off"));
  driver.tell(RobotState::ON, RobotState::STANDING);
  EXPECT_TRUE(says("nobody listens")) << "it would turn again";
}

TEST(Monitor, SaysWhoHasStoppedTheRobot) {
  FakeDriver driver("/watched");
  driver.stop("/user");
  Process monitor({AIBO_MONITOR, "__ns:=/watched"});
  monitor.waitForOutput("stopped by /user, until release", kSafetyNet);
  driver.release();
  monitor.waitForOutput("until release\\nno pictures: no driver in namespace /watched yet\\n", kSafetyNet);
  ros::Publisher connections = ros::NodeHandle("/watched").advertise<aibo_driver::Connection>("connection", 1, true);
  aibo_driver::Connection connection;
  connection.text = "the robot \x1b[2J is off";
  connections.publish(connection);
  monitor.waitForOutput("no pictures: the robot [^\x1b]* is off\\n", kSafetyNet);
}

TEST(Monitor, TellsHowManyPicturesComeAndHowOldTheyAre) {
  ros::Publisher pictures =
      ros::NodeHandle("/filmed").advertise<sensor_msgs::CompressedImage>("camera/image_raw/compressed", 10);
  FakeDriver driver("/filmed");
  driver.stop("/user");
  Process monitor({AIBO_MONITOR, "__ns:=/filmed", "_seconds:=2", "_first_picture_timeout:=3600"});
  monitor.waitForOutput("(no pictures[^\\n]*\\n){3}", kSafetyNet);  // its time begins with the first picture
  sensor_msgs::CompressedImage picture;
  picture.data.resize(1000);
  int count = 0;
  const ros::WallTimer film =
      ros::NodeHandle().createWallTimer(ros::WallDuration(0.02), [&](const ros::WallTimerEvent&) {
        picture.header.stamp = ros::Time::now() - ros::Duration(count++ % 10 == 0 ? 3000 : 1000);
        pictures.publish(picture);
      });
  // As many kilobytes as pictures. The mean is between 1000 and 1500 s.
  EXPECT_NO_THROW(monitor.waitForOutput(
      "([0-9]+\\.[0-9]) pictures/s +\\1 KB/s   stamp to topic: 1[0-4][0-9]{5}\\.[0-9] "
      "ms \\(worst 300[0-9]{4}\\.[0-9]\\)   driver: [0-9.]+ % of one processor   stopped by /user, until release\\n",
      kSafetyNet));
  EXPECT_EQ(monitor.waitForExit(kSafetyNet), 0);
}

// A node that takes the connection and says nothing. It would keep a monitor from its next line for ever.
TEST(Monitor, DoesNotWaitForANodeThatDoesNotAnswer) {
  const aibo_client::FileDescriptor silent = test_support::bindTo("127.0.0.1", 0);
  ASSERT_EQ(::listen(silent.get(), 5), 0);
  XmlRpc::XmlRpcValue node;
  node[0] = "/silent";
  node[1] = "/silent/topic";
  node[2] = "std_msgs/String";
  node[3] = "http://" + ros::network::getHost() + ":" + std::to_string(test_support::portOf(silent)) + "/";
  XmlRpc::XmlRpcValue answer;
  XmlRpc::XmlRpcValue subscribers;
  ASSERT_TRUE(ros::master::execute("registerPublisher", node, answer, subscribers, false));
  EXPECT_FALSE(aibo_driver::tools::processOfNode("/silent"));
  EXPECT_EQ(aibo_driver::tools::processOfNode(ros::this_node::getName()), ::getpid());
  node[0] = "/elsewhere";
  node[3] = "http://127.0.0.2:" + std::to_string(ros::XMLRPCManager::instance()->getServerPort()) + "/";
  ASSERT_TRUE(ros::master::execute("registerPublisher", node, answer, subscribers, false));
  EXPECT_FALSE(aibo_driver::tools::processOfNode("/elsewhere")) << "it is not known by this computer's name";
}

// A gamepad with aibo_teleop_joy, in a namespace.
class Gamepad {
 public:
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
    joy.buttons.resize(6);
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

  test_support::TopicPublishers joystick_;
  Process teleop_;
};

TEST(Gamepad, SaysWhoHasStoppedTheRobotAndReleasesIt) {
  FakeDriver driver("/pad");
  Gamepad pad("/pad");
  pad.press({Gamepad::kDeadMan});
  pad.press({Gamepad::kDeadMan, Gamepad::kRelease});  // nobody has stopped the robot
  pad.press({Gamepad::kStop});
  pad.teleop().waitForOutput("/pad/stop: ", kSafetyNet);
  EXPECT_THAT(pad.teleop().output(), Not(HasSubstr("/release: ")));
  pad.teleop().waitForOutput("/caller has stopped the robot.*together with the dead-man button", kSafetyNet);
  driver.tell(RobotState::ON, RobotState::SITTING);
  pad.press({Gamepad::kDeadMan});
  pad.press({Gamepad::kDeadMan, Gamepad::kRelease});
  pad.teleop().waitForOutput("The robot may move again", kSafetyNet);
  const std::string said = pad.teleop().output();
  EXPECT_EQ(said.find("/caller has stopped"), said.rfind("/caller has stopped")) << "only news is said";
}

TEST(Gamepad, StopsWhileAReleaseWaitsForItsAnswer) {
  constexpr bool kIsSlow = true;
  FakeDriver driver("/late", kIsSlow);
  driver.stop("/user");
  Gamepad pad("/late");
  pad.teleop().waitForOutput("/user has stopped the robot", kSafetyNet);
  pad.press({Gamepad::kDeadMan, Gamepad::kRelease});
  ASSERT_TRUE(driver.waitForCallOfRelease());
  pad.press({Gamepad::kDeadMan});
  pad.press({Gamepad::kDeadMan, Gamepad::kRelease});
  pad.teleop().waitForOutput("release is not called: the previous call has not ended yet", kSafetyNet);
  pad.press({Gamepad::kStop});
  EXPECT_NO_THROW(pad.teleop().waitForOutput("/late/stop: ", kSafetyNet));
  driver.answerRelease();
}

TEST(Gamepad, SeesAShortPressOfStopAlsoIfItWasHeldUp) {
  FakeDriver driver("/held");
  Gamepad pad("/held");
  pad.teleop().signal(SIGSTOP);
  pad.press({Gamepad::kStop});
  for (int i = 0; i < 20; ++i) {
    pad.press({});
  }
  pad.teleop().signal(SIGCONT);
  pad.teleop().waitForOutput("/held/stop: ", kSafetyNet);
}

// As after another joystick was plugged in.
TEST(Gamepad, StopsAlsoWithFewerAxesThanItsMappingNames) {
  FakeDriver driver("/few");
  TopicListener<Twist> walks("/few/cmd_vel");
  Gamepad pad("/few");
  const auto end = std::chrono::steady_clock::now() + kSafetyNet;
  while (walks.count() == 0 && std::chrono::steady_clock::now() < end) {
    pad.press({Gamepad::kDeadMan}, {0, 1, 0, 0, 0, 0, 0});
    walks.waitForNext(std::chrono::milliseconds(50));
  }
  pad.press({Gamepad::kDeadMan}, {0, 1});
  EXPECT_TRUE(walks.waitFor([](const Twist& walk) { return walk.linear.x == 0; }));
  pad.teleop().waitForOutput("The joystick has 2 axes and 6 buttons, but", kSafetyNet);
  pad.press({Gamepad::kStop}, {0, 1});
  pad.teleop().waitForOutput("/few/stop: ", kSafetyNet);
}

TEST(Gamepad, WalksAndTurnsTheHeadWhereItsSticksPoint) {
  FakeDriver driver("/sticks");
  TopicListener<Twist> walks("/sticks/cmd_vel");
  TopicListener<sensor_msgs::JointState> heads("/sticks/joint_command");
  std::promise<aibo_driver::PlayMotion::Request> played;
  const auto play = [&played](aibo_driver::PlayMotion::Request& request, aibo_driver::PlayMotion::Response&) {
    played.set_value(request);
    return true;
  };
  const ros::ServiceServer motions =
      ros::NodeHandle("/sticks").advertiseService<aibo_driver::PlayMotion::Request, aibo_driver::PlayMotion::Response>(
          "play_motion", play);
  ros::param::set("/sticks/aibo_teleop_joy/motions", std::map<std::string, int>{{"NOD", 0}, {"WAG", 1}});
  Gamepad pad("/sticks", {"_turn_axis:=1", "_forward_axis:=0", "_left_axis:=2", "_pan_axis:=4", "_tilt_axis:=3",
                          "_speed:=0.1", "_side_speed:=0.05", "_turn_speed:=2", "_head_speed:=3", "_dead_zone:=0.2",
                          "_stop_button:=2", "_picture_button:=3"});
  // A robot of version 1 measures one joint after the other.
  ros::Publisher joints = ros::NodeHandle("/sticks").advertise<sensor_msgs::JointState>("joint_states", 10);
  sensor_msgs::JointState measured;
  const auto end = std::chrono::steady_clock::now() + kSafetyNet;
  for (bool is_pan = true; heads.count() < 2 && std::chrono::steady_clock::now() < end; is_pan = !is_pan) {
    measured.name = {"mouth", is_pan ? "head_pan" : "head_tilt"};
    measured.position = {-0.3, is_pan ? 0.4 : 0.2};
    pad.press({Gamepad::kDeadMan}, {1, 0.6F, -1, -1, 1, 0, 0});  // forward, turn, left, tilt, pan
    joints.publish(measured);
    walks.waitForNext(std::chrono::milliseconds(50));
  }
  ASSERT_GE(heads.count(), 2U);
  const auto walk = walks.waitForCount(1).front();
  EXPECT_DOUBLE_EQ(walk->linear.x, 0.1);
  EXPECT_DOUBLE_EQ(walk->linear.y, -0.05);
  EXPECT_NEAR(walk->angular.z, 2 * 0.4 / 0.8, 1e-6) << "it begins at the edge of the dead zone";
  const auto head = heads.waitForCount(2)[1];
  EXPECT_THAT(head->name, ElementsAre("head_pan", "head_tilt"));
  EXPECT_THAT(head->velocity, ElementsAre(4.5, 4.5)) << "the head can keep up";
  EXPECT_GT(head->position.at(0), 0.4);
  EXPECT_LT(head->position.at(1), 0.2);
  // Let go and deflected again, after something else has turned the head.
  measured.name = {"head_pan", "head_tilt"};
  measured.position = {-0.8, 0.3};
  const auto begins_there = [](const sensor_msgs::JointState& each) {
    return each.position == std::vector<double>{-0.8, 0.3};
  };
  bool begins = false;
  while (!begins && std::chrono::steady_clock::now() < end) {
    joints.publish(measured);
    pad.press({Gamepad::kDeadMan});
    pad.press({Gamepad::kDeadMan}, {0, 0, 0, -1, 1, 0, 0});
    begins = heads.waitFor(begins_there, std::chrono::milliseconds(50)) != nullptr;
  }
  EXPECT_TRUE(begins);
  pad.press({Gamepad::kDeadMan});
  pad.press({Gamepad::kDeadMan, 0});
  auto request = played.get_future();
  ASSERT_EQ(request.wait_for(kSafetyNet), std::future_status::ready);
  const aibo_driver::PlayMotion::Request motion = request.get();
  EXPECT_EQ(motion.name, "NOD");
  EXPECT_EQ(motion.repetitions, 1);
  pad.press({3});
  pad.teleop().waitForOutput("/sticks/take_picture cannot be called", kSafetyNet);
  pad.press({2});
  pad.teleop().waitForOutput("/sticks/stop: ", kSafetyNet);
}

TEST(Keyboard, SaysWhoHasStoppedTheRobotAndReleasesIt) {
  FakeDriver driver("/board");
  driver.stop("/user");
  int keys = -1;
  int terminal = -1;
  char name[64] = {};
  if (::openpty(&keys, &terminal, name, nullptr, nullptr) != 0) {
    GTEST_SKIP() << "this system gives no pseudo terminal: is /dev/pts mounted?";
  }
  Process teleop({"/bin/sh", "-c",
                  std::string("exec ") + AIBO_TELEOP_KEYBOARD +
                      " __ns:=/board _speed:=0.2 _side_speed:=0.03 _turn_speed:=0.7 _key_timeout:=0 < " + name});
  teleop.waitForOutput("speeds: 0.200 m/s, sideways 0.030 m/s, turn 0.70 rad/s", kSafetyNet);
  teleop.waitForOutput("/user has stopped the robot. R .capital. lets it move again", kSafetyNet);
  driver.tell(RobotState::ON, RobotState::SITTING);
  driver.stop("/other");
  teleop.waitForOutput("/other has stopped the robot", kSafetyNet);
  const std::string said = teleop.output();
  EXPECT_EQ(said.find("/user has stopped"), said.rfind("/user has stopped")) << "only news is said";
  EXPECT_EQ(::write(keys, "R", 1), 1);
  teleop.waitForOutput("The robot may move again", kSafetyNet);
  TopicListener<Twist> walks("/board/cmd_vel");
  EXPECT_EQ(::write(keys, "j", 1), 1);
  for (const auto& walk : walks.waitForCount(12)) {
    EXPECT_EQ(walk->angular.z, 0.7) << "a key counts until the next one";
  }
  EXPECT_EQ(::write(keys, "R", 1), 1);
  EXPECT_TRUE(walks.waitFor([](const Twist& walk) { return walk.angular.z == 0; })) << "there is nothing to release";
  ::close(keys);
  ::close(terminal);
}

}  // namespace
