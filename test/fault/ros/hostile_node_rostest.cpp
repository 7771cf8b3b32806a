// The driver's node with other nodes that attack it: whoever reaches the ROS master can. Meanwhile `stop` has to work.
// AIBO_WHOLE_CAMPAIGN makes each attack longer, and its limits those of a computer that does nothing else.

#include <actionlib_msgs/GoalID.h>
#include <actionlib_msgs/GoalStatusArray.h>
#include <aibo_driver/DeleteMotion.h>
#include <aibo_driver/FetchPicture.h>
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
#include <aibo_driver/Say.h>
#include <aibo_driver/SetVolume.h>
#include <aibo_driver/Sound.h>
#include <aibo_driver/TakePicture.h>
#include <aibo_driver/UploadMotion.h>
#include <control_msgs/FollowJointTrajectoryActionGoal.h>
#include <dynamic_reconfigure/Reconfigure.h>
#include <geometry_msgs/Twist.h>
#include <gmock/gmock.h>
#include <ros/ros.h>
#include <sensor_msgs/JointState.h>
#include <sensor_msgs/SetCameraInfo.h>
#include <std_srvs/SetBool.h>
#include <std_srvs/Trigger.h>
#include <sys/stat.h>
#include <trajectory_msgs/JointTrajectory.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <functional>
#include <regex>
#include <string>
#include <thread>
#include <vector>

#include "support/memory_stick.h"
#include "support/resources.h"
#include "support/ros/driver_process.h"
#include "support/ros/topic_listener.h"
#include "support/simulated_robot.h"
#include "support/temporary_folder.h"
#include "support/whole_campaign.h"
#include "unit/sound/wav_files.h"

namespace {

using std::chrono::milliseconds;
using std::chrono::steady_clock;
using test_support::DriverProcess;
using test_support::kSafetyNet;
using test_support::Process;
using test_support::Resources;
using test_support::SimulatedRobot;
using test_support::TopicListener;
using test_support::wantsWholeCampaign;

constexpr char kHostile[] = "\x1b[2J\x1b]0;you\x07\n[ERROR] ";

/// Ever new names that no part of the robot has.
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

  milliseconds attackTime() const { return milliseconds(wantsWholeCampaign() ? 10000 : 700); }

  void SetUp() override {
    ASSERT_TRUE(joints_.waitForNext());
    ASSERT_TRUE(stop_.waitForExistence(ros::Duration(60)));
    before_ = Resources::of(std::to_string(driver_.pid()));
  }

  template <typename Message>
  ros::Publisher publisher(const std::string& topic) {
    ros::Publisher publisher = node_.advertise<Message>(topic, 1);
    const auto end = steady_clock::now() + kSafetyNet;
    while (publisher.getNumSubscribers() == 0 && steady_clock::now() < end) {
      std::this_thread::sleep_for(milliseconds(10));
    }
    EXPECT_GT(publisher.getNumSubscribers(), 0U) << topic;
    return publisher;
  }

  /// Does `once` again and again, and stops the robot meanwhile.
  void attack(const std::function<void()>& once) { attackFromAllSides({once}); }

  /// Does all this side by side, again and again, and stops the robot meanwhile.
  void attackFromAllSides(const std::vector<std::function<void()>>& sides) {
    const std::size_t log = driver_.output().size();
    std::atomic<bool> goes_on{true};
    Process user({AIBO_STOP_CALLER, "/victim/stop"});
    user.waitForOutput("stop took", kSafetyNet);
    std::vector<std::thread> attackers;
    for (const std::function<void()>& once : sides) {
      attackers.emplace_back([&goes_on, &once] {
        while (goes_on) {
          once();
        }
      });
    }
    std::this_thread::sleep_until(steady_clock::now() + attackTime());
    const std::vector<milliseconds> times = stopTimes(user);
    goes_on = false;
    for (std::thread& attacker : attackers) {
      attacker.join();
    }
    ASSERT_TRUE(driver_.isRunning()) << driver_.output();
    EXPECT_TRUE(joints_.waitForNext());
    ASSERT_FALSE(times.empty());
    if (wantsWholeCampaign()) {
      EXPECT_LE(times[times.size() * 9 / 10], milliseconds(50)) << "nine of ten stops; " << times.size() << " in all";
    }
    const std::size_t memory = Resources::of(std::to_string(driver_.pid())).resident_kilobytes;
    std::printf("stop took %d ms (median), %d ms (nine of ten), %d ms (worst); memory was %zu KB, and is %zu KB\n",
                static_cast<int>(times[times.size() / 2].count()),
                static_cast<int>(times[times.size() * 9 / 10].count()), static_cast<int>(times.back().count()),
                before_.resident_kilobytes, memory);
    const std::string logged = driver_.output().substr(log);
    EXPECT_LT(logged.size(), kMostLog);
    EXPECT_EQ(logged.find("\x1b[2J"), std::string::npos) << "a terminal obeys this";
    if (test_support::kMemoryCounts) {
      EXPECT_LT(memory, before_.resident_kilobytes + kMostMemory);
    }
  }

  /// @return how long the calls of a stop_caller took; the shortest time is first
  static std::vector<milliseconds> stopTimes(const Process& user) {
    const std::string output = user.output();
    EXPECT_EQ(output.find("failed"), std::string::npos) << output;
    const std::regex time("stop took ([0-9]+) ms");
    std::vector<milliseconds> times;
    for (std::sregex_iterator each(output.begin(), output.end(), time); each != std::sregex_iterator(); ++each) {
      times.emplace_back(std::stoi((*each)[1]));
    }
    std::sort(times.begin(), times.end());
    return times;
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

  /// Calls a service once that answers in words.
  template <typename Service>
  void expectPlainAnswer(const std::string& name, const typename Service::Request& request) {
    Service call;
    call.request = request;
    EXPECT_TRUE(node_.serviceClient<Service>(name).call(call)) << name;
    EXPECT_EQ(call.response.success, 0) << name;
    expectPlain(call.response.message);
  }

  test_support::MemoryStick stick_{"ALLOW_MICROPHONE=yes\n"};
  SimulatedRobot robot_{{"--memory-stick", stick_.path().string()}};
  const bool may_move_ = ros::param::del("/victim/stopped_by");  ///< the last test's stop would outlive its driver
  DriverProcess driver_{"/victim", robot_.port(), {}, {}, AIBO_DRIVER_NODE_WITH_ALL};
  ros::NodeHandle node_{"/victim"};
  TopicListener<sensor_msgs::JointState> joints_{"/victim/joint_states"};
  ros::ServiceClient stop_ = node_.serviceClient<std_srvs::Trigger>("stop");
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

TEST_F(HostileNode, ThatCommandsAnotherUnknownJointInEachMessage) {
  const ros::Publisher commands = publisher<sensor_msgs::JointState>("joint_command");
  attack([&] {
    sensor_msgs::JointState message;
    message.name = {names_.next()};
    message.position = {0};
    commands.publish(message);
    std::this_thread::sleep_for(std::chrono::microseconds(200));
  });
}

TEST_F(HostileNode, ThatSendsTrajectoriesOfUnknownJointsAndManyPoints) {
  const ros::Publisher trajectories = publisher<trajectory_msgs::JointTrajectory>("joint_trajectory");
  attack([&] {
    trajectory_msgs::JointTrajectory message;
    message.joint_names = names_.next(1000);
    message.points.resize(200);
    for (std::size_t i = 0; i < message.points.size(); ++i) {
      message.points[i].positions.resize(1000);
      message.points[i].time_from_start = ros::Duration(0.01 * static_cast<double>(i + 1));
    }
    trajectories.publish(message);
    message.joint_names = {"head_pan"};
    message.points.assign(100'000, {});
    for (std::size_t i = 0; i < message.points.size(); ++i) {
      message.points[i].positions = {i % 2 == 0 ? 0.5 : -0.5};
      message.points[i].time_from_start = ros::Duration(0.01 * static_cast<double>(i + 1));
    }
    trajectories.publish(message);
  });
}

TEST_F(HostileNode, ThatSteersAsFastAsItCan) {
  const ros::Publisher velocities = publisher<geometry_msgs::Twist>("cmd_vel");
  attack([&] {
    geometry_msgs::Twist velocity;
    velocity.linear.x = 0.1;
    velocities.publish(velocity);
    std::this_thread::sleep_for(std::chrono::microseconds(100));
  });
}

TEST_F(HostileNode, ThatLightsAMillionUnknownLeds) {
  const ros::Publisher leds = publisher<aibo_driver::Leds>("leds");
  attack([&] {
    aibo_driver::Leds message;
    message.names = names_.next(200'000);
    message.intensities = {1.0F};
    leds.publish(message);
  });
  driver_.waitForOutput("A message on leds was refused: it has [0-9]+ bytes", kSafetyNet);
}

TEST_F(HostileNode, ThatChangesSettingsAsFastAsItCan) {
  ros::ServiceClient set = node_.serviceClient<dynamic_reconfigure::Reconfigure>("aibo_driver/set_parameters", true);
  ASSERT_TRUE(set.waitForExistence(ros::Duration(60)));
  attack([&] {
    dynamic_reconfigure::Reconfigure change;
    dynamic_reconfigure::StrParameter transport;
    transport.name = "transport";
    transport.value = names_.next() + std::string(10'000, 'x');
    change.request.config.strs = {transport};
    set.call(change);
  });
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
  const ros::Publisher goals = publisher<aibo_driver::PlayMotionActionGoal>("play_motion/goal");
  const ros::Publisher cancels = publisher<actionlib_msgs::GoalID>("play_motion/cancel");
  for (int i = 0; i < kMany; ++i) {
    aibo_driver::PlayMotionActionGoal goal;
    goal.goal_id.id = "goal " + std::to_string(i);
    goals.publish(goal);
    actionlib_msgs::GoalID cancel;
    cancel.id = "cancel " + std::to_string(i);
    cancels.publish(cancel);
    std::this_thread::sleep_for(milliseconds(5));  // actionlib's queues hold 50
  }
  const auto state = states.waitFor(hasStateOf("cancel " + std::to_string(kMany - 1)));
  ASSERT_TRUE(state);
  EXPECT_LT(state->status_list.size(), 40U);
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
  const auto result = results.waitForNext();
  ASSERT_TRUE(result);
  EXPECT_TRUE(result->result.success) << result->status.text;
}

// Every second goal moves the head, and each of these ends the one before it.
TEST_F(HostileNode, ThatSendsTrajectoriesAsGoalsAsFastAsItCan) {
  const ros::Publisher goals = publisher<control_msgs::FollowJointTrajectoryActionGoal>("follow_joint_trajectory/goal");
  const ros::Publisher cancels = publisher<actionlib_msgs::GoalID>("follow_joint_trajectory/cancel");
  attack([&] {
    control_msgs::FollowJointTrajectoryActionGoal goal;
    goal.goal_id.id = names_.next();
    goal.goal.trajectory.joint_names = {names_.next()};
    goal.goal.trajectory.points.resize(1);
    goal.goal.trajectory.points[0].positions = {0.3};
    goal.goal.trajectory.points[0].time_from_start = ros::Duration(1.0);
    goals.publish(goal);
    goal.goal_id.id = names_.next();
    goal.goal.trajectory.joint_names = {"head_pan"};
    goals.publish(goal);
    cancels.publish(actionlib_msgs::GoalID());
    std::this_thread::sleep_for(std::chrono::microseconds(500));
  });
}

// Goals, orders and calls that quote what others chose, one by one.
TEST_F(HostileNode, WhoseNamesAreQuotedInAnswersResultsAndStates) {
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
  const auto result = results.waitForNext();
  ASSERT_TRUE(result);
  expectPlain(result->result.message);
  expectPlain(result->status.text);
  ASSERT_TRUE(states.waitFor([](const aibo_driver::MotionState& state) { return !state.ended.empty(); }));
  aibo_driver::PlayMotion::Request play;
  play.name = name;
  play.repetitions = 1;
  expectPlainAnswer<aibo_driver::PlayMotion>("play_motion", play);
  std_srvs::Trigger stop;
  EXPECT_TRUE(stop_.call(stop));
  expectPlainAnswer<aibo_driver::PlayMotion>("play_motion", play);
  ASSERT_TRUE(states.waitFor([](const aibo_driver::MotionState& state) {
    return !state.ended.empty() && state.ended.back().movement.kind == aibo_driver::Movement::MOTION;
  }));
  for (const auto& state : states.waitForCount(0)) {
    expectPlain(state->text);
    for (const aibo_driver::EndedMovement& ended : state->ended) {
      expectPlain(ended.movement.name);
      expectPlain(ended.reason);
    }
  }
  aibo_driver::TakePicture::Request picture;
  picture.resolution = name;
  expectPlainAnswer<aibo_driver::TakePicture>("take_picture", picture);
  picture.resolution.clear();
  picture.save_to = name;
  expectPlainAnswer<aibo_driver::TakePicture>("take_picture", picture);
  aibo_driver::LoadColorTable::Request table;
  table.file = name;
  expectPlainAnswer<aibo_driver::LoadColorTable>("load_color_table", table);
  aibo_driver::DeleteMotion::Request motion;
  motion.name = name;
  expectPlainAnswer<aibo_driver::DeleteMotion>("delete_motion", motion);
  aibo_driver::FetchPicture::Request fetched;
  fetched.name = name;
  expectPlainAnswer<aibo_driver::FetchPicture>("fetch_picture", fetched);
  aibo_driver::PlaySound::Request sound;
  sound.file = name;
  expectPlainAnswer<aibo_driver::PlaySound>("play_sound", sound);
  aibo_driver::Say::Request say;
  say.text = name;
  expectPlainAnswer<aibo_driver::Say>("say", say);
  say.text = "hello";
  say.voice = name;
  expectPlainAnswer<aibo_driver::Say>("say", say);
}

TEST_F(HostileNode, ThatPlaysAndSaysAsFastAsItCan) {
  const test_support::TemporaryFolder folder;
  const std::string sound = folder.path("sound.wav").string();
  const std::string pipe = folder.path("pipe.wav").string();
  writeSoundFile(sound, tone(16000));
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  const ros::Publisher goals = publisher<aibo_driver::PlaySoundActionGoal>("play_sound/goal");
  const ros::Publisher cancels = publisher<actionlib_msgs::GoalID>("play_sound/cancel");
  const auto send = [&](const std::string& file, const std::string& text, const std::string& voice) {
    aibo_driver::PlaySoundActionGoal goal;
    goal.goal_id.id = names_.next();
    goal.goal.file = file;
    goal.goal.text = text;
    goal.goal.voice = voice;
    goals.publish(goal);
  };
  attack([&] {
    for (const std::string& file : {sound, std::string("/dev/zero"), pipe, names_.next(), sound + '\0'}) {
      send(file, "", "");
    }
    send("", std::string(1'000'000, '9'), "");
    send("", std::string("--stdin\0$(reboot)", 17), names_.next());
    cancels.publish(actionlib_msgs::GoalID());
    std::this_thread::sleep_for(milliseconds(1));
  });
}

TEST_F(HostileNode, ThatListensAndGoesAsOftenAsItCan) {
  attack([&] { TopicListener<aibo_driver::Sound>("/victim/microphone").waitForCount(1, milliseconds(20)); });
}

TEST_F(HostileNode, ThatCallsServicesWithTextsOfItsOwn) {
  ros::ServiceClient upload = node_.serviceClient<aibo_driver::UploadMotion>("upload_motion", true);
  ASSERT_TRUE(upload.waitForExistence(ros::Duration(60)));
  attack([&] {
    aibo_driver::UploadMotion request;
    request.request.name = names_.next();
    request.request.file = "/proc/kmsg" + std::string(names_.next().size() % 2, '\0');
    EXPECT_TRUE(upload.call(request));
    EXPECT_EQ(request.response.message.find('\x1b'), std::string::npos);
  });
}

TEST_F(HostileNode, ThatCallsEveryServiceAsFastAsItCan) {
  attackFromAllSides(
      {caller<aibo_driver::PlayMotion>("play_motion"), caller<aibo_driver::PlaySound>("play_sound"),
       caller<aibo_driver::Say>("say"), caller<aibo_driver::SetVolume>("set_volume"),
       caller<aibo_driver::ListMotions>("list_motions"), caller<aibo_driver::ListPictures>("list_pictures"),
       caller<aibo_driver::LoadColorTable>("load_color_table"),
       caller<sensor_msgs::SetCameraInfo>("camera/set_camera_info"), caller<std_srvs::Trigger>("toggle_streaming"),
       caller<std_srvs::Trigger>("stand"), caller<std_srvs::Trigger>("rest"), caller<std_srvs::Trigger>("reboot")});
}

// They are answered in turn by the thread that answers `stop`.
TEST_F(HostileNode, ThatReleasesAndSwitchesTheMotorsAsFastAsItCan) {
  attackFromAllSides({caller<std_srvs::SetBool>("motors"), caller<std_srvs::SetBool>("motors"),
                      caller<std_srvs::SetBool>("motors"), caller<std_srvs::Trigger>("release"),
                      caller<std_srvs::Trigger>("release"), caller<std_srvs::Trigger>("stop")});
}

TEST_F(HostileNode, ThatTakesPicturesAsFastAsItCan) {
  std::vector<std::function<void()>> sides(8);
  std::generate(sides.begin(), sides.end(), [this] { return caller<aibo_driver::TakePicture>("take_picture"); });
  attackFromAllSides(sides);
}

// Each node's publisher keeps its last message for new subscribers, so each publisher that comes commands the joints.
TEST_F(HostileNode, WhosePublishersComeAndGoAsOftenAsTheyCan) {
  attack([&] {
    sensor_msgs::JointState message;
    message.name = {"head_pan", names_.next()};
    message.position = {0.5, 0};
    std::vector<ros::Publisher> publishers;
    for (const char* const topic : {"joint_command", "joint_trajectory", "leds", "cmd_vel"}) {
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
