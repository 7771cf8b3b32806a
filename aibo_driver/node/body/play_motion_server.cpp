#include "node/body/play_motion_server.h"

#include <actionlib/server/action_server.h>
#include <aibo_driver/EndedMovement.h>
#include <aibo_driver/PlayMotionAction.h>
#include <ros/console.h>
#include <ros/steady_timer.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include "aibo_client/exceptions.h"
#include "files/files.h"
#include "node/joints/motion_state_publisher.h"
#include "node/orders.h"

namespace aibo_driver::node {

using aibo_client::EndedHow;

namespace {

constexpr std::chrono::milliseconds kFeedbackPeriod{100};

class MotionServer : public PlayMotionServer {
 public:
  MotionServer(ros::NodeHandle handle, movement::Mover& mover) : mover_(mover) {
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
    movement::Mover::Begun motion;
    std::chrono::steady_clock::time_point begin;
  };

  void accept(Server::GoalHandle goal);
  void cancel(const Server::GoalHandle& goal);
  void report();
  static void finish(Server::GoalHandle goal, const movement::EndedMovement& end);

  movement::Mover& mover_;
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
      throw aibo_client::InvalidArgumentException("give the name of a motion. list_motions lists them.");
    }
    const movement::Mover::Begun motion = mover_.play(orderOfGoal(goal.getGoalID().id), name, repetitions);
    const movement::EndedMovement* const end = motion.ended();
    if (end != nullptr && end->how == EndedHow::kRefused) {
      throw aibo_client::CommandException(end->reason + ".");
    }
    goal.setAccepted(name + (motion.is_uncertain ? " may or may not play: " + motion.remark : " plays"));
    playing_.push_back({goal, motion, std::chrono::steady_clock::now()});
    timer_.start();
  } catch (const aibo_client::Exception& error) {
    result.end = EndedMovement::REFUSED;
    result.message = std::string("Nothing was played: ") + error.what();
    goal.setRejected(result, result.message);
  }
}

// The goal ends when the robot reports the end of the motion.
void MotionServer::cancel(const Server::GoalHandle& goal) {
  try {
    mover_.stopMotion(orderOfGoal(goal.getGoalID().id), files::motionFileName(goal.getGoal()->name));
  } catch (const aibo_client::Exception& error) {
    ROS_WARN_STREAM_NAMED("joints", "The motion of a goal that was cancelled was not stopped: " << error.what());
  }
}

void MotionServer::report() {
  for (auto playing = playing_.begin(); playing != playing_.end();) {
    if (const movement::EndedMovement* const end = playing->motion.ended()) {
      finish(playing->goal, *end);
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

void MotionServer::finish(Server::GoalHandle goal, const movement::EndedMovement& end) {
  PlayMotionResult result;
  result.success = static_cast<std::uint8_t>(end.how == EndedHow::kDone);
  result.end = endConstant(end.how);
  result.message = end.how != EndedHow::kDone ? end.reason
                   : end.reason.empty()       ? "It was played to its end."
                                              : "It was played to its end: " + end.reason + ".";
  const bool was_cancelled = goal.getGoalStatus().status == actionlib_msgs::GoalStatus::PREEMPTING;
  if (end.how == EndedHow::kDone || end.how == EndedHow::kUnknown) {
    goal.setSucceeded(result, result.message);
  } else if (was_cancelled || end.how == EndedHow::kReplaced) {
    goal.setCanceled(result, result.message);
  } else {
    goal.setAborted(result, result.message);
  }
}

}  // namespace

std::unique_ptr<PlayMotionServer> startPlayMotionServer(const ros::NodeHandle& handle, movement::Mover& mover) {
  return std::make_unique<MotionServer>(handle, mover);
}

}  // namespace aibo_driver::node
