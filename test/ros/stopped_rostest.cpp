// The programs that steer, or that move the robot by themselves, while somebody has stopped it. The driver is a fake.

#include <aibo_driver/Connection.h>
#include <aibo_driver/LookAtResult.h>
#include <aibo_driver/RobotState.h>
#include <geometry_msgs/PointStamped.h>
#include <geometry_msgs/Twist.h>
#include <gmock/gmock.h>
#include <ros/network.h>
#include <ros/ros.h>
#include <ros/xmlrpc_manager.h>
#include <sensor_msgs/CompressedImage.h>
#include <std_srvs/Trigger.h>
#include <sys/socket.h>
#include <trajectory_msgs/JointTrajectory.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <future>
#include <memory>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "support/ros/driver_user.h"
#include "support/ros/fake_driver.h"
#include "support/sockets.h"
#include "tools/node_process.h"

namespace {

using aibo_driver::LookAtResult;
using aibo_driver::Movement;
using aibo_driver::RobotState;
using geometry_msgs::Twist;
using std_srvs::Trigger;
using test_support::DriverUser;
using test_support::FakeDriver;
using test_support::kSafetyNet;
using test_support::Process;
using test_support::TopicListener;
using test_support::TopicPublishers;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using trajectory_msgs::JointTrajectory;

bool callGoOn(const std::string& node, std::string* message) {
  Trigger service;
  EXPECT_TRUE(ros::service::call(node + "/go_on", service));
  *message = service.response.message;
  return service.response.success != 0;
}

/// A robot that looks around. Each time it has looked somewhere, it waits 3.5 or 4.5 s by itself.
class LookAroundTest : public ::testing::Test {
 protected:
  using Happening = std::function<void(FakeDriver&, bool)>;

  /// What becomes of its second glance if something happens for 5 s after the first one.
  struct Gaze {
    bool waits = false;                          ///< meanwhile
    std::chrono::steady_clock::duration time{};  ///< from the first to the second glance
  };

  static std::future<Gaze> begin(const std::string& name_space, const std::string& pause, const Happening& happen) {
    return std::async(std::launch::async, [=] {
      FakeDriver driver(name_space);
      TopicListener<JointTrajectory> glances(name_space + "/joint_trajectory");
      const Process node({AIBO_LOOK_AROUND, "__ns:=" + name_space, pause});
      EXPECT_FALSE(glances.waitForCount(1).empty());
      const auto begin = std::chrono::steady_clock::now();
      Gaze gaze;
      happen(driver, true);
      gaze.waits = glances.waitForCount(2, std::chrono::seconds(5)).size() < 2;
      happen(driver, false);
      EXPECT_GE(glances.waitForCount(2).size(), 2U) << name_space;
      gaze.time = std::chrono::steady_clock::now() - begin;
      return gaze;
    });
  }

  static Happening movement(std::uint8_t kind, const std::vector<std::string>& joints) {
    return [=](FakeDriver& driver, bool moves) {
      Movement movement;
      movement.source = "/somebody";
      movement.kind = kind;
      movement.joints = joints;
      driver.move(moves ? std::vector<Movement>{movement} : std::vector<Movement>());
    };
  }
};

// All at the same time, because most of the time nothing happens.
TEST_F(LookAroundTest, WaitsForWhateverElseMovesTheRobotAndLongerAfterSomebodyHasPointedTheHead) {
  auto tail = begin("/wags", "_pause:=3600", movement(Movement::COMMAND, {"tail_pan"}));
  auto limp = begin("/limp", "_pause:=3600", [](FakeDriver& driver, bool is_limp) {
    driver.tell(is_limp ? RobotState::OFF : RobotState::ON, RobotState::LYING);
  });
  auto head = begin("/turns", "_pause:=7", movement(Movement::TRAJECTORY, {"tail_pan", "head_tilt"}));
  EXPECT_TRUE(tail.get().waits);
  EXPECT_TRUE(limp.get().waits);
  const Gaze gaze = head.get();
  EXPECT_TRUE(gaze.waits);
  EXPECT_GE(gaze.time, std::chrono::seconds(7));
}

TEST_F(LookAroundTest, TurnsTheHeadToAllSidesAlsoWhileTheRobotWalks) {
  FakeDriver driver("/walks");
  movement(Movement::WALK, {})(driver, true);
  TopicListener<JointTrajectory> glances("/walks/joint_trajectory");
  const Process node({AIBO_LOOK_AROUND, "__ns:=/walks"});
  std::set<double> sides;
  for (const auto& glance : glances.waitForCount(3)) {
    EXPECT_THAT(glance->joint_names, ElementsAre("head_pan", "head_tilt"));
    sides.insert(glance->points.at(0).positions.at(0));
  }
  EXPECT_THAT(sides, ElementsAre(-0.7, 0, 0.7));
}

class BallFollower : public ::testing::Test {
 protected:
  void start(const std::vector<std::string>& parameters = {}) {
    std::vector<std::string> command{AIBO_FOLLOW_BALL, "__ns:=/follows"};
    command.insert(command.end(), parameters.begin(), parameters.end());
    node_ = std::make_unique<Process>(command);
    ASSERT_FALSE(steps_.waitForCount(1).empty());
  }

  /// What was sent before may still be on its way.
  bool becomesSilent() {
    return DriverUser::becomesTrue([this] { return isSilent(); });
  }

  bool isSilent() {
    steps_.clear();
    return steps_.waitForCount(1, std::chrono::milliseconds(1000)).empty();
  }

  bool walks() {
    steps_.clear();
    return !steps_.waitForCount(1).empty();
  }

  void stand() { driver_.tell(RobotState::ON, RobotState::STANDING); }

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
  driver_.showBall(0, 0);
  EXPECT_TRUE(steers(0, 0, -0.4)) << "gone to the right";
  driver_.showBall(37, 30);
  EXPECT_TRUE(steers(-0.05, -0.04, 0)) << "too near";
}

TEST_F(BallFollower, NeedsLeaveToGoOnWhenItWasOverruled) {
  start();
  const std::tuple<const char*, std::function<void()>, std::function<void()>> rows[] = {
      // what it says, what happens, and what ends it
      {"/user has stopped the robot", [this] { driver_.stop("/user"); }, [this] { driver_.release(); }},
      {"waits: the motors are off", [this] { driver_.tell(RobotState::OFF, RobotState::LYING); }, [this] { stand(); }},
      {"waits: the robot is carried", [this] { driver_.tell(RobotState::ON, RobotState::CARRIED); },
       [this] { stand(); }},
      {"waits: the robot has fallen", [this] { driver_.tell(RobotState::ON, RobotState::FALLEN); },
       [this] { stand(); }},
      {"waits: /somebody has called sit", [this] { driver_.takePosture(true); },
       [this] { driver_.takePosture(false); }},
  };
  for (const auto& [what, happen, end] : rows) {
    happen();
    node_->waitForOutput(what, kSafetyNet);
    EXPECT_TRUE(becomesSilent()) << what;
    end();
    EXPECT_TRUE(isSilent()) << what;
    std::string message;
    EXPECT_TRUE(DriverUser::becomesTrue([&message] { return callGoOn("/follows/aibo_follow_ball", &message); }))
        << message;
    EXPECT_TRUE(walks()) << what;
  }
}

TEST_F(BallFollower, GoesOnByItselfIfItsUserHasSaidSo) {
  start({"_go_on_after_stop:=true"});
  driver_.stop("/user");
  EXPECT_TRUE(becomesSilent());
  driver_.release();
  EXPECT_TRUE(walks());
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

TEST(LookAt, SaysWhyTheHeadDoesNotTurn) {
  FakeDriver driver("/stares");
  TopicListener<LookAtResult> results("/stares/look_at_result");
  TopicPublishers user("/stares");
  const Process node({AIBO_LOOK_AT, "__ns:=/stares"});
  geometry_msgs::PointStamped point;
  point.header.frame_id = "base_link";
  const auto says = [&](const std::string& text) {  // in the end: a point may come before the robot's state
    return DriverUser::becomesTrue([&] {
      results.clear();
      user.publish("look_at", point);
      const auto result = results.waitForNext(std::chrono::seconds(5));
      EXPECT_TRUE(!result || (!result->success && !result->moves));
      return result && result->message.find(text) != std::string::npos;
    });
  };
  EXPECT_TRUE(says("nobody listens on /stares/joint_command"));
  driver.stop("/user");
  EXPECT_TRUE(says("/user has stopped the robot; call release"));
  driver.release();
  driver.tell(RobotState::OFF, RobotState::LYING);
  EXPECT_TRUE(says("the motors are off"));
}

TEST(Monitor, WithoutADriverEndsAfterItsTimeAndSaysThatNoPictureCame) {
  for (const char* time : {"_seconds:=1", "_first_picture_timeout:=1"}) {
    Process monitor({AIBO_MONITOR, "__ns:=/nobody", time});
    EXPECT_EQ(monitor.waitForExit(kSafetyNet), 1) << time;
    EXPECT_THAT(monitor.output(), HasSubstr("no driver in namespace /nobody"));
    EXPECT_THAT(monitor.output(), HasSubstr("no picture came within 1 s"));
  }
}

TEST(Monitor, SaysWhyNoPicturesComeAndWhoHasStoppedTheRobot) {
  FakeDriver driver("/watched");
  driver.stop("/user");
  TopicPublishers connections("/watched");
  Process monitor({AIBO_MONITOR, "__ns:=/watched"});
  aibo_driver::Connection connection;
  connection.text = "the robot \x1b[2J is off";
  connections.publish("connection", connection);
  monitor.waitForOutput("no pictures: the robot [^\x1b]* is off   stopped by /user, until release\\n", kSafetyNet);
}

TEST(Monitor, TellsFromTheFirstPictureOnHowManyComeAndHowOldTheyAre) {
  ros::Publisher pictures =
      ros::NodeHandle("/filmed").advertise<sensor_msgs::CompressedImage>("camera/image_raw/compressed", 10);
  FakeDriver driver("/filmed");
  driver.stop("/user");
  Process monitor({AIBO_MONITOR, "__ns:=/filmed", "_seconds:=2", "_first_picture_timeout:=3600"});
  monitor.waitForOutput("(no pictures[^\\n]*\\n){3}", kSafetyNet);  // its time begins with the first picture
  sensor_msgs::CompressedImage picture;
  picture.data.resize(1000);
  const ros::WallTimer film = ros::NodeHandle().createWallTimer(
      ros::WallDuration(0.02), [&](const ros::WallTimerEvent&) { pictures.publish(picture); });
  EXPECT_NO_THROW(monitor.waitForOutput(
      "[0-9]+\\.[0-9] pictures/s +[0-9.]+ KB/s   stamp to topic: .*   driver: [0-9.]+ % of one processor   "
      "stopped by /user, until release\\n",
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

}  // namespace
