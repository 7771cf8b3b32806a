#include "ros/body/play_motion_server.h"

#include <actionlib/server/action_server.h>
#include <aibo_driver/PlayMotionAction.h>
#include <ros/console.h>
#include <ros/steady_timer.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include "aibo_driver/exceptions.h"
#include "files/files.h"
#include "ros/body/robot_services.h"
#include "ros/joints/motion_state_publisher.h"

namespace aibo_driver::node {
namespace {

constexpr std::chrono::milliseconds kFeedbackPeriod{100};

class MotionServer : public PlayMotionServer {
 public:
  MotionServer(ros::NodeHandle handle, RcServerClient& client, JointMover& mover) : client_(client), mover_(mover) {
    constexpr bool kOneShot = false;
    constexpr bool kAutostart = false;
    timer_ = handle.createSteadyTimer(
        ros::WallDuration(std::chrono::duration<double>(kFeedbackPeriod).count()),
        [this](const ros::SteadyTimerEvent&) { report(); }, kOneShot, kAutostart);
    server_ = std::make_unique<Server>(
        handle, "play_motion", [this](const Server::GoalHandle& goal) { accept(goal); },
        [this](const Server::GoalHandle& goal) { cancel(goal); }, kAutostart);
    server_->start();
  }

 private:
  using Server = actionlib::ActionServer<PlayMotionAction>;

  struct Playing {
    Server::GoalHandle goal;
    JointMover::Fate motion;
    std::chrono::steady_clock::time_point begin;
  };

  void accept(Server::GoalHandle goal);
  void cancel(const Server::GoalHandle& goal);
  void report();
  static void finish(Server::GoalHandle goal, const movement::MovementFate& fate);

  RcServerClient& client_;
  JointMover& mover_;
  std::unique_ptr<Server> server_;
  std::vector<Playing> playing_;
  ros::SteadyTimer timer_;
};

void MotionServer::accept(Server::GoalHandle goal) {
  PlayMotionResult result;
  const std::string name = files::motionFileName(goal.getGoal()->name);
  const int repetitions = std::max<int>(1, goal.getGoal()->repetitions);
  try {
    if (name.empty()) {
      throw InvalidArgumentException("give the name of a motion. list_motions lists them.");
    }
    const auto motion = mover_.play(name, repetitions, RobotServices::kMotionTimeout);
    goal.setAccepted(name + " plays");
    playing_.push_back({goal, motion, std::chrono::steady_clock::now()});
    timer_.start();
  } catch (const Exception& error) {
    result.end = MotionState::REFUSED;
    result.message = std::string("Nothing was played: ") + error.what();
    goal.setRejected(result, result.message);
  }
}

// The robot reports the end of the motion, and with it the goal ends.
void MotionServer::cancel(const Server::GoalHandle& goal) {
  try {
    client_.stopMotion(files::motionFileName(goal.getGoal()->name), RobotServices::kMotionTimeout);
  } catch (const Exception& error) {
    ROS_WARN_STREAM_NAMED("joints", "The motion of a goal that was cancelled was not stopped: " << error.what());
  }
}

void MotionServer::report() {
  for (auto playing = playing_.begin(); playing != playing_.end();) {
    const movement::MovementFate fate = mover_.look(playing->motion);
    if (fate.end) {
      finish(playing->goal, fate);
      playing = playing_.erase(playing);
    } else {
      PlayMotionFeedback feedback;
      const auto time = std::chrono::steady_clock::now() - playing->begin;
      feedback.time = ros::Duration(std::chrono::duration<double>(time).count());
      playing->goal.publishFeedback(feedback);
      ++playing;
    }
  }
  if (playing_.empty()) {
    timer_.stop();
  }
}

void MotionServer::finish(Server::GoalHandle goal, const movement::MovementFate& fate) {
  PlayMotionResult result;
  result.success = static_cast<std::uint8_t>(fate.end == movement::MovementEnd::kDone);
  result.end = endConstant(*fate.end);
  result.message = fate.end == movement::MovementEnd::kDone ? "It was played to its end." : fate.reason;
  const bool was_cancelled = goal.getGoalStatus().status == actionlib_msgs::GoalStatus::PREEMPTING;
  if (fate.end == movement::MovementEnd::kDone || fate.end == movement::MovementEnd::kUnknown) {
    goal.setSucceeded(result, result.message);
  } else if (was_cancelled || fate.end == movement::MovementEnd::kReplaced) {
    goal.setCanceled(result, result.message);
  } else {
    goal.setAborted(result, result.message);
  }
}

}  // namespace

std::unique_ptr<PlayMotionServer> startPlayMotionServer(const ros::NodeHandle& handle, RcServerClient& client,
                                                        JointMover& mover) {
  return std::make_unique<MotionServer>(handle, client, mover);
}

}  // namespace aibo_driver::node
