// The driver's node with other nodes that attack it, as every node that reaches the ROS master can. Meanwhile `stop`
// has to work.

#include <actionlib_msgs/GoalID.h>
#include <actionlib_msgs/GoalStatusArray.h>
#include <aibo_driver/Leds.h>
#include <aibo_driver/ListMotions.h>
#include <aibo_driver/ListPictures.h>
#include <aibo_driver/LoadColorTable.h>
#include <aibo_driver/MotionState.h>
#include <aibo_driver/PlayMotion.h>
#include <aibo_driver/PlayMotionActionGoal.h>
#include <aibo_driver/PlayMotionActionResult.h>
#include <aibo_driver/PlaySound.h>
#include <aibo_driver/PlaySoundActionGoal.h>
#include <aibo_driver/RobotState.h>
#include <aibo_driver/Say.h>
#include <aibo_driver/SetVolume.h>
#include <aibo_driver/Sound.h>
#include <aibo_driver/TakePicture.h>
#include <gmock/gmock.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/SetCameraInfo.h>
#include <std_srvs/Trigger.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <future>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "node/stop_client.h"
#include "support/memory_stick.h"
#include "support/resources.h"
#include "support/ros/driver_process.h"
#include "support/ros/topics.h"
#include "support/safety_net.h"
#include "support/simulated_robot.h"

namespace {

using std::chrono::milliseconds;
using test_support::DriverProcess;
using test_support::kSafetyNet;
using test_support::Resources;
using test_support::SimulatedRobot;
using test_support::TopicListener;

constexpr char kHostile[] = "\x1b[2J\x1b]0;you\x07\n[ERROR] ";

/// New names each time, which no part of the robot has.
class Names {
 public:
  std::string next() { return kHostile + std::to_string(++count_); }

  std::vector<std::string> next(std::size_t count) {
    std::vector<std::string> names(count);
    std::generate(names.begin(), names.end(), [this] { return next(); });
    return names;
  }

 private:
  unsigned count_ = 0;
};

class HostileNode : public testing::Test {
 protected:
  static constexpr std::size_t kMostLog = 64 * 1024;      // bytes, for an attack
  static constexpr std::size_t kMostMemory = 300 * 1024;  // KB more than before: messages of a million names wait

  static void SetUpTestSuite() { ros::param::set("/victim/actionlib_status_frequency", 5.0); }

  void SetUp() override {
    ASSERT_TRUE(joints_.waitForNext());
    ASSERT_TRUE(ros::service::waitForService(stop_.service(), ros::Duration(kSafetyNet.count())));
    before_ = Resources::of(std::to_string(driver_.pid()));
  }

  template <typename Message>
  ros::Publisher publisher(const std::string& topic, std::uint32_t queue_size = 1) {
    ros::Publisher publisher = node_.advertise<Message>(topic, queue_size);
    EXPECT_TRUE(test_support::eventually([&] { return publisher.getNumSubscribers() > 0; })) << topic;
    return publisher;
  }

  /// Does `once` again and again, and stops the robot meanwhile.
  void attack(const std::function<void()>& once) { attackFromAllSides({once}); }

  /// Does all this side by side, again and again, until the robot has been stopped three times.
  void attackFromAllSides(const std::vector<std::function<void()>>& sides) {
    const std::size_t log = driver_.output().size();
    std::atomic<bool> goes_on{true};
    std::vector<std::thread> attackers;
    for (const std::function<void()>& once : sides) {
      attackers.emplace_back([&goes_on, &once] {
        while (goes_on) {
          once();
        }
      });
    }
    for (int i = 0; i < 3; ++i) {
      std::this_thread::sleep_for(milliseconds(200));  // of the attack
      EXPECT_TRUE(stops());
    }
    goes_on = false;
    for (std::thread& attacker : attackers) {
      attacker.join();
    }
    EXPECT_TRUE(stops());
    EXPECT_TRUE(states_.waitFor([](const aibo_driver::RobotState& state) { return state.stopped != 0; }));
    EXPECT_TRUE(states_.waitForCount(1).back()->stopped) << "the stop did not hold";
    const std::string logged = driver_.output().substr(log);
    EXPECT_LT(logged.size(), kMostLog);
    EXPECT_EQ(logged.find("\x1b[2J"), std::string::npos) << "a terminal obeys this";
    if (test_support::kMemoryCounts) {
      EXPECT_LT(Resources::of(std::to_string(driver_.pid())).resident_kilobytes,
                before_.resident_kilobytes + kMostMemory);
    }
  }

  /// @return true if a stop is answered within kSafetyNet. On a slow computer, the robot may report the stop later.
  bool stops() {
    const auto answer = std::make_shared<std::promise<bool>>();
    stop_.stop([answer](const std_srvs::Trigger::Response* response) { answer->set_value(response != nullptr); });
    std::future<bool> stopped = answer->get_future();
    return stopped.wait_for(kSafetyNet) == std::future_status::ready && stopped.get();
  }

  /// A function that calls a service with the defaults of its request.
  template <typename Service>
  std::function<void()> caller(const std::string& name) {
    constexpr bool kPersistent = true;  // faster
    ros::ServiceClient service = node_.serviceClient<Service>(name, kPersistent);
    EXPECT_TRUE(service.waitForExistence(ros::Duration(60))) << name;
    return [service]() mutable {
      Service call;
      service.call(call);
    };
  }

  static void expectPlain(const std::string& text) {
    EXPECT_EQ(text.find_first_of("\x1b\x07\n"), std::string::npos) << "a terminal obeys this";
    EXPECT_LT(text.size(), 5000U);
  }

  test_support::MemoryStick stick_{"ALLOW_MICROPHONE=yes\n"};
  SimulatedRobot robot_{{"--memory-stick", stick_.path().string()}};
  const bool may_move_ = ros::param::del("/victim/stopped_by");  ///< the last test's stop would outlive its driver
  DriverProcess driver_{"/victim", robot_.port(), {"_read_timeout:=60"}, {}, AIBO_DRIVER_NODE_WITH_ALL};
  ros::NodeHandle node_{"/victim"};
  TopicListener<sensor_msgs::JointState> joints_{"/victim/joint_states"};
  TopicListener<aibo_driver::RobotState> states_{"/victim/robot_state"};
  aibo_driver::node::StopClient stop_{node_};
  Resources before_;
  Names names_;
};

TEST_F(HostileNode, ThatCommandsAMillionUnknownJoints) {
  TopicListener<aibo_driver::MotionState> states("/victim/motion_state");
  const ros::Publisher commands = publisher<sensor_msgs::JointState>("joint_command");
  attack([&] {
    sensor_msgs::JointState message;
    message.name = names_.next(200'000);
    message.position.resize(message.name.size());
    commands.publish(message);
  });
  EXPECT_TRUE(states.waitFor([](const aibo_driver::MotionState& state) {
    return !state.ended.empty() &&
           state.ended.back().reason.find("at most 262144 bytes are allowed") != std::string::npos;
  }));
}

TEST_F(HostileNode, ThatSendsGoalsAsFastAsItCan) {
  const ros::Publisher goals = publisher<aibo_driver::PlayMotionActionGoal>("play_motion/goal");
  const ros::Publisher cancels = publisher<actionlib_msgs::GoalID>("play_motion/cancel");
  attack([&] {
    aibo_driver::PlayMotionActionGoal goal;
    goal.goal_id.id = names_.next();
    goal.goal.name = names_.next();
    goals.publish(goal);
    goal.goal_id.id = names_.next();
    goal.goal.name = "nod";
    goals.publish(goal);
    cancels.publish(actionlib_msgs::GoalID());
    std::this_thread::sleep_for(std::chrono::microseconds(500));
  });
}

// actionlib by itself keeps a goal for 5 s after its end, and such a cancel for ever.
TEST_F(HostileNode, WhoseGoalsAndCancelsAreForgotten) {
  constexpr int kMany = 200;
  TopicListener<actionlib_msgs::GoalStatusArray> states("/victim/play_motion/status");
  const auto hasStateOf = [](const std::string& id) {
    return [id](const actionlib_msgs::GoalStatusArray& state) {
      return std::any_of(state.status_list.begin(), state.status_list.end(),
                         [&id](const actionlib_msgs::GoalStatus& status) { return status.goal_id.id == id; });
    };
  };
  const ros::Publisher goals = publisher<aibo_driver::PlayMotionActionGoal>("play_motion/goal", kMany);
  const ros::Publisher cancels = publisher<actionlib_msgs::GoalID>("play_motion/cancel", kMany);
  for (int i = 0; i < kMany; ++i) {
    aibo_driver::PlayMotionActionGoal goal;
    goal.goal_id.id = "goal " + std::to_string(i);
    goals.publish(goal);
    actionlib_msgs::GoalID cancel;
    cancel.id = "cancel " + std::to_string(i);
    cancels.publish(cancel);
    if (i % 20 == 19) {  // actionlib's queues hold 50
      ASSERT_TRUE(states.waitFor(hasStateOf(cancel.id)));
    }
  }
  EXPECT_TRUE(states.waitFor([&](const actionlib_msgs::GoalStatusArray& state) {
    return state.status_list.size() <= 32 && hasStateOf("cancel " + std::to_string(kMany - 1))(state);
  })) << "a goal that has just come is there, too, until it has ended";
}

TEST_F(HostileNode, ThatCancelsGoalsOfTheFuture) {
  TopicListener<aibo_driver::PlayMotionActionResult> results("/victim/play_motion/result");
  TopicListener<actionlib_msgs::GoalStatusArray> states("/victim/play_motion/status");
  const ros::Publisher goals = publisher<aibo_driver::PlayMotionActionGoal>("play_motion/goal");
  const ros::Publisher cancels = publisher<actionlib_msgs::GoalID>("play_motion/cancel");
  actionlib_msgs::GoalID cancel;
  cancel.id = "nobody's";
  cancel.stamp = ros::Time::now() + ros::Duration(3600);
  cancels.publish(cancel);
  ASSERT_TRUE(states.waitFor([](const actionlib_msgs::GoalStatusArray& state) { return !state.status_list.empty(); }));
  aibo_driver::PlayMotionActionGoal goal;
  goal.goal_id.id = "owner's";
  goal.goal_id.stamp = ros::Time::now();
  goal.goal.name = "nod";
  goals.publish(goal);
  const auto result = results.waitForFirst();
  ASSERT_TRUE(result);
  EXPECT_TRUE(result->result.success) << result->status.text;
}

TEST_F(HostileNode, WhoseNamesAreQuotedInResultsAndStates) {
  const std::string name = names_.next() + std::string(100'000, 'x');
  TopicListener<aibo_driver::PlayMotionActionResult> results("/victim/play_motion/result");
  TopicListener<aibo_driver::MotionState> states("/victim/motion_state");
  const ros::Publisher goals = publisher<aibo_driver::PlayMotionActionGoal>("play_motion/goal");
  const ros::Publisher trajectories = publisher<trajectory_msgs::JointTrajectory>("joint_trajectory");
  trajectory_msgs::JointTrajectory trajectory;
  trajectory.joint_names = {name};
  trajectory.points.resize(1);
  trajectory.points[0].positions = {0};
  trajectories.publish(trajectory);
  aibo_driver::PlayMotionActionGoal goal;
  goal.goal.name = name;
  goals.publish(goal);
  const auto result = results.waitForFirst();
  ASSERT_TRUE(result);
  expectPlain(result->result.message);
  expectPlain(result->status.text);
  ASSERT_TRUE(states.waitFor([](const aibo_driver::MotionState& state) { return !state.ended.empty(); }));
  for (const auto& state : states.waitForCount(0)) {
    expectPlain(state->text);
    for (const aibo_driver::EndedMovement& ended : state->ended) {
      expectPlain(ended.movement.name);
      expectPlain(ended.reason);
    }
  }
}

TEST_F(HostileNode, ThatPlaysSaysAndListensAsFastAsItCan) {
  const ros::Publisher goals = publisher<aibo_driver::PlaySoundActionGoal>("play_sound/goal");
  attack([&] {
    for (const std::string& file : {std::string("/dev/zero"), names_.next(), std::string()}) {
      aibo_driver::PlaySoundActionGoal goal;
      goal.goal_id.id = names_.next();
      goal.goal.file = file;
      goal.goal.text = file.empty() ? std::string(1'000'000, '9') : "";
      goals.publish(goal);
    }
    TopicListener<aibo_driver::Sound>("/victim/microphone").waitForCount(1, milliseconds(5));
  });
}

TEST_F(HostileNode, ThatCallsEveryServiceAsFastAsItCan) {
  attackFromAllSides(
      {caller<aibo_driver::TakePicture>("take_picture"), caller<aibo_driver::TakePicture>("take_picture"),
       caller<aibo_driver::PlayMotion>("play_motion"), caller<aibo_driver::PlaySound>("play_sound"),
       caller<aibo_driver::Say>("say"), caller<aibo_driver::SetVolume>("set_volume"),
       caller<aibo_driver::ListMotions>("list_motions"), caller<aibo_driver::ListPictures>("list_pictures"),
       caller<aibo_driver::LoadColorTable>("load_color_table"),
       caller<sensor_msgs::SetCameraInfo>("camera/set_camera_info"), caller<std_srvs::Trigger>("toggle_streaming"),
       caller<std_srvs::Trigger>("stand"), caller<std_srvs::Trigger>("rest"), caller<std_srvs::Trigger>("reboot")});
}

// Each node's publisher keeps its last message for new subscribers, so each publisher that comes commands the joints.
TEST_F(HostileNode, WhosePublishersComeAndGoAsOftenAsTheyCan) {
  attack([&] {
    sensor_msgs::JointState message;
    message.name = {"head_pan", names_.next()};
    message.position = {0.5, 0};
    std::vector<ros::Publisher> publishers;
    for (const char* const topic : {"joint_command", "leds"}) {
      constexpr bool kLatched = true;
      ros::Publisher commands = node_.advertise<sensor_msgs::JointState>(topic, 1, kLatched);
      commands.publish(message);
      publishers.push_back(commands);
    }
  });
}

TEST_F(HostileNode, ThatCommandsAllJointsAndLedsAsFastAsItCan) {
  const ros::Publisher commands = publisher<sensor_msgs::JointState>("joint_command");
  const ros::Publisher leds = publisher<aibo_driver::Leds>("leds");
  sensor_msgs::JointState message = *joints_.waitForNext();
  aibo_driver::Leds lights;
  lights.names = {"all"};
  attack([&] {
    for (double& position : message.position) {
      position = position > 0 ? -0.2 : 0.2;
    }
    commands.publish(message);
    lights.intensities = {message.position[0] > 0 ? 1.0F : 0.0F};
    leds.publish(lights);
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  });
}

}  // namespace
