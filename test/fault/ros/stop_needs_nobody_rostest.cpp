// A stop does not depend on the ROS master or on free descriptors, and outlives the driver.

#include <aibo_driver/RobotState.h>
#include <geometry_msgs/Twist.h>
#include <gmock/gmock.h>
#include <ros/network.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>
#include <std_srvs/Trigger.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdint>
#include <future>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "node/stop_client.h"
#include "node/xmlrpc_peer.h"
#include "support/process.h"
#include "support/pseudo_terminal.h"
#include "support/resources.h"
#include "support/ros/driver_process.h"
#include "support/ros/topics.h"
#include "support/safety_net.h"
#include "support/simulated_robot.h"
#include "support/sockets.h"

namespace {

using aibo_driver::RobotState;
using aibo_driver::node::StopClient;
using std_srvs::Trigger;
using test_support::DriverProcess;
using test_support::eventually;
using test_support::kSafetyNet;
using test_support::Process;
using test_support::PseudoTerminal;
using test_support::Resources;
using test_support::SimulatedRobot;
using test_support::TopicListener;
using ::testing::HasSubstr;

// The robot's connection must not end because this computer is slow: without descriptors there is no new one.
constexpr const char* kKeepsRobot = "_read_timeout:=60";

TEST(Stop, NeedsNoMaster) {
  const PseudoTerminal keys;
  if (!keys.exists()) {
    GTEST_SKIP() << "this system gives no pseudo terminal: is /dev/pts mounted?";
  }
  const std::string port = std::to_string(test_support::portOf(test_support::bindTo("127.0.0.1", 0)));
  const std::map<std::string, std::string> environment{{"ROS_MASTER_URI", "http://127.0.0.1:" + port}};
  Process master({"rosmaster", "--core", "-p", port});
  const SimulatedRobot robot;
  DriverProcess driver("/alone", robot.port(), {kKeepsRobot}, environment);
  driver.waitForOutput("onnected to");
  EXPECT_TRUE(eventually([&] {  // on a slow computer, an order may be too old when it could reach the robot
    Process stand({"rosservice", "call", "--wait", "/alone/stand"}, environment);
    return stand.waitForExit(kSafetyNet) && stand.output().find("success: True") != std::string::npos;
  }));
  // In a new build folder, catkin's environment for tests lacks the path of our messages.
  Process state({"/bin/sh", "-c", "PYTHONPATH=" PYTHON_MESSAGES ":$PYTHONPATH exec rostopic echo /alone/robot_state"},
                environment);
  Process keyboard(
      {"/bin/sh", "-c", std::string("exec ") + AIBO_TELEOP_KEYBOARD + " __ns:=/alone _key_timeout:=0 < " + keys.name()},
      environment);
  keyboard.waitForOutput("speeds: ");
  // The first keys may come before anybody listens. A robot that turns on the spot meets nothing meanwhile.
  EXPECT_TRUE(eventually([&] {
    keys.type("j");
    return state.output().find("posture: 4") != std::string::npos;
  })) << "it does not walk";

  const auto stops = [&] {
    const std::size_t before = keyboard.output().size();
    keys.type("S");
    return eventually(
        [&] { return keyboard.output().find("/alone/stop: The robot holds", before) != std::string::npos; });
  };

  master.signal(SIGSTOP);
  EXPECT_TRUE(stops()) << keyboard.output();
  state.waitForOutput("posture: 1\nstopped: True\nstopped_by: \"/alone/aibo_teleop_keyboard\"");
  master.kill();
  EXPECT_TRUE(stops()) << "without a master: " << keyboard.output();
}

TEST(Stop, IsAlsoAVelocityOf0AndATrajectoryWithoutPoints) {
  TopicListener<geometry_msgs::Twist> velocities("/twofold/cmd_vel");
  TopicListener<trajectory_msgs::JointTrajectory> trajectories("/twofold/joint_trajectory");
  StopClient client(ros::NodeHandle("/twofold"));
  ASSERT_TRUE(eventually([&] {  // the first ones may be sent before anybody listens
    client.stop([](const Trigger::Response*) {});
    return velocities.count() > 0 && trajectories.count() > 0;
  }));
  EXPECT_EQ(*velocities.waitForFirst(), geometry_msgs::Twist());
  EXPECT_THAT(trajectories.waitForFirst()->points, ::testing::IsEmpty());
}

/// A driver, and a client that has a connection to its service `stop`.
class FloodedStop : public ::testing::Test {
 protected:
  /// @param limit the driver's limit of descriptors, as options of the shell's ulimit
  void start(const std::string& limit) {
    driver_ = std::make_unique<Process>(std::vector<std::string>{"/bin/sh", "-c",
                                                                 "ulimit " + limit + "; exec " + AIBO_DRIVER_NODE +
                                                                     " __ns:=/flooded " + kKeepsRobot +
                                                                     " _port:=" + std::to_string(robot_.port())});
    ASSERT_TRUE(eventually([this] { return stops(); }));
  }

  /// Opens connections over which nothing is ever said, until the driver has so many more descriptors.
  void fill(std::size_t connections) {
    const auto uri = aibo_driver::node::XmlRpcPeer::master().call("lookupService", {"/flooded/stop"});
    std::string host;
    std::uint32_t port = 0;
    ASSERT_TRUE(uri && ros::network::splitURI(*uri, host, port));
    const std::string pid = std::to_string(driver_->pid());
    const std::size_t enough = std::min<std::size_t>(Resources::of(pid).descriptors + connections, kFew - kClosedAgain);
    for (std::size_t i = 0; i < connections; ++i) {
      silent_.push_back(test_support::beginConnecting("127.0.0.1", static_cast<int>(port)));
    }
    ASSERT_TRUE(eventually([&] { return Resources::of(pid).descriptors >= enough; }))
        << Resources::of(pid).descriptors << " of " << enough;
  }

  bool stops() {
    std::promise<bool> stopped;
    client_.stop([&stopped](const Trigger::Response* response) {
      stopped.set_value(response != nullptr && response->success != 0);
    });
    return stopped.get_future().get();
  }

  static constexpr std::size_t kFew = 256;
  // roscpp accepts no more connections once it has had no descriptor, also if some are closed later.
  static constexpr std::size_t kClosedAgain = 40;

  SimulatedRobot robot_;
  std::unique_ptr<Process> driver_;
  StopClient client_{ros::NodeHandle("/flooded")};
  std::vector<host_files::FileDescriptor> silent_;
};

TEST_F(FloodedStop, NeedsNoDescriptor) {
  start("-n " + std::to_string(kFew));
  fill(kFew + 50);
  EXPECT_TRUE(stops());
}

TEST_F(FloodedStop, CanBeCalledByEverybodyUpToTheSystemsLimitOfDescriptors) {
  start("-Sn " + std::to_string(kFew));
  fill(kFew + 50);
  Trigger call;
  EXPECT_TRUE(ros::service::call("/flooded/stop", call));
  EXPECT_NE(call.response.success, 0);
}

class OutlivedStop : public ::testing::Test {
 protected:
  void SetUp() override { restart(); }

  void restart() {
    driver_.reset();
    states_.clear();
    driver_ = std::make_unique<DriverProcess>("/outlived", robot_.port(), std::vector<std::string>{kKeepsRobot});
  }

  RobotState::ConstPtr waitFor(bool is_stopped) {
    return states_.waitFor([is_stopped](const RobotState& state) {
      return (state.stopped != 0) == is_stopped && state.motors == RobotState::ON;
    });
  }

  void expectStopped() {
    const auto state = waitFor(true);
    ASSERT_TRUE(state);
    EXPECT_EQ(state->stopped_by, ros::this_node::getName());
    sensor_msgs::JointState command;
    command.name = {"head_pan"};
    command.position = {0.5};
    const std::string refusal = "head_pan is refused: stopped by " + ros::this_node::getName() + "; call release";
    EXPECT_TRUE(eventually([&] {  // the first command may go to the driver before
      commands_.publish("joint_command", command);
      return driver_->output().find(refusal) != std::string::npos;
    })) << driver_->output();
  }

  static void call(const std::string& service) {
    Trigger call;
    ASSERT_TRUE(ros::service::waitForService("/outlived/" + service, ros::Duration(60)));
    EXPECT_TRUE(ros::service::call("/outlived/" + service, call));
    EXPECT_NE(call.response.success, 0) << call.response.message;
  }

  static bool remembers() { return ros::param::has("/outlived/stopped_by"); }

  const SimulatedRobot robot_;
  TopicListener<RobotState> states_{"/outlived/robot_state"};
  test_support::TopicPublishers commands_{"/outlived"};
  std::unique_ptr<DriverProcess> driver_;
};

TEST_F(OutlivedStop, LastsAlsoInTheNextDriverUntilRelease) {
  ASSERT_TRUE(waitFor(false));
  call("stop");
  EXPECT_TRUE(eventually(remembers));
  ros::param::del("/outlived/stopped_by");  // a master that was restarted does not know it
  EXPECT_TRUE(eventually(remembers));
  driver_->kill();
  restart();
  driver_->waitForOutput("The robot stays stopped: .* has stopped it");
  expectStopped();
  driver_->signal(SIGINT);
  EXPECT_EQ(driver_->waitForExit(kSafetyNet), 0);
  restart();
  expectStopped();
  call("release");
  EXPECT_TRUE(eventually([] { return !remembers(); }));
  driver_->kill();
  restart();
  EXPECT_TRUE(waitFor(false));
  EXPECT_THAT(driver_->output(), ::testing::Not(HasSubstr("stays stopped")));
}

}  // namespace
