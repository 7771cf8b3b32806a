#include <actionlib/server/action_server.h>
#include <aibo_driver/PlaySoundAction.h>
#include <ros/console.h>
#include <ros/steady_timer.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <vector>

#include "aibo_client/exceptions.h"
#include "node/joints/motion_state_publisher.h"
#include "node/sound/sound_services.h"
#include "sound/sound_file.h"
#include "sound/speech.h"
#include "text/plain_text.h"

namespace aibo_driver::node {

using aibo_client::EndedHow;

namespace {

constexpr double kFeedbackPeriod = 0.1;  // s

class SoundServer : public PlaySoundServer {
 public:
  SoundServer(ros::NodeHandle handle, sound::Player& player) : player_(player) {
    constexpr bool kOneShot = false;
    constexpr bool kAutostart = false;
    timer_ = handle.createSteadyTimer(
        ros::WallDuration(kFeedbackPeriod), [this](const ros::SteadyTimerEvent&) { report(); }, kOneShot, kAutostart);
    server_ = std::make_unique<Server>(
        handle, "play_sound", [this](const Server::GoalHandle& goal) { accept(goal); },
        [this](const Server::GoalHandle& goal) { cancel(goal); }, kAutostart);
    server_->start();
  }

 private:
  using Server = actionlib::ActionServer<PlaySoundAction>;

  struct Playing {
    Server::GoalHandle goal;
    std::shared_ptr<sound::Playback> playback;
  };

  void accept(Server::GoalHandle goal);
  void cancel(const Server::GoalHandle& goal);
  void report();
  static void finish(Server::GoalHandle goal, const sound::PlayedSound& end);

  sound::Player& player_;
  std::unique_ptr<Server> server_;
  std::vector<Playing> playing_;
  ros::SteadyTimer timer_;
};

void SoundServer::accept(Server::GoalHandle goal) {
  const PlaySoundGoal& wanted = *goal.getGoal();
  try {
    if (wanted.file.empty() == wanted.text.empty()) {
      throw aibo_client::InvalidArgumentException("give a file or a text");
    }
    const auto playback =
        player_.play(wanted.file.empty() ? sound::speak(wanted.text, wanted.voice) : sound::openSoundFile(wanted.file));
    goal.setAccepted("It plays.");
    playing_.push_back({goal, playback});
    timer_.start();
  } catch (const std::exception& error) {
    PlaySoundResult result;
    result.end = endConstant(EndedHow::kRefused);
    result.message = text::plainText(std::string("Nothing was played: ") + error.what());
    goal.setRejected(result, result.message);
  }
}

// The goal ends when the sound has.
void SoundServer::cancel(const Server::GoalHandle& goal) {
  const auto found = std::find_if(playing_.begin(), playing_.end(), [&goal](const Playing& playing) {
    return playing.goal.getGoalID().id == goal.getGoalID().id;
  });
  if (found == playing_.end()) {
    return;
  }
  try {
    player_.stop(found->playback);
  } catch (const std::exception& error) {
    ROS_WARN_STREAM_NAMED("sound", "The sound of a goal that was cancelled was not stopped: " << error.what());
  }
}

void SoundServer::report() {
  for (auto playing = playing_.begin(); playing != playing_.end();) {
    if (const auto end = playing->playback->end()) {
      finish(playing->goal, *end);
      playing = playing_.erase(playing);
    } else {
      PlaySoundFeedback feedback;
      feedback.time = ros::Duration(playing->playback->time().count());
      playing->goal.publishFeedback(feedback);
      ++playing;
    }
  }
  if (playing_.empty()) {
    timer_.stop();
  }
}

void SoundServer::finish(Server::GoalHandle goal, const sound::PlayedSound& end) {
  PlaySoundResult result;
  result.success = static_cast<std::uint8_t>(end.how == EndedHow::kDone);
  result.end = endConstant(end.how);
  result.message = end.message;
  const bool was_cancelled = goal.getGoalStatus().status == actionlib_msgs::GoalStatus::PREEMPTING;
  if (end.how == EndedHow::kDone) {
    goal.setSucceeded(result, result.message);
  } else if (was_cancelled || end.how == EndedHow::kReplaced) {
    goal.setCanceled(result, result.message);
  } else {
    goal.setAborted(result, result.message);
  }
}

}  // namespace

std::unique_ptr<PlaySoundServer> startPlaySoundServer(const ros::NodeHandle& handle, sound::Player& player) {
  return std::make_unique<SoundServer>(handle, player);
}

}  // namespace aibo_driver::node
