#include "node/actions.h"

#include <aibo_driver/GoToAction.h>
#include <aibo_driver/PlayMotionAction.h>
#include <aibo_driver/PlaySoundAction.h>
#include <aibo_driver/TakePostureAction.h>

#include <algorithm>
#include <cstdint>

#include "aibo_client/names.h"
#include "node/goal_server.h"
#include "node/joints/motion_state_publisher.h"
#include "node/services.h"
#include "sound/source.h"
#include "text/plain_text.h"

namespace aibo_driver::node {

using aibo_client::EndedHow;
using aibo_client::Posture;
using movement::Order;

namespace {

/// @param message a sentence for the user
template <typename Spec>
GoalEnd<Spec> goalEnd(EndedHow how, const std::string& message) {
  using State = typename GoalEnd<Spec>::State;
  GoalEnd<Spec> end;
  end.state = how == EndedHow::kDone       ? State::kSucceeded
              : how == EndedHow::kReplaced ? State::kCanceled
                                           : State::kAborted;
  end.result.success = static_cast<std::uint8_t>(how == EndedHow::kDone);
  end.result.end = endConstant(how);
  end.result.message = message;
  end.text = message;
  return end;
}

/// Starts an action whose result has success, end and message.
/// @param failure the beginning of the message of a rejected goal
/// @param begin see ActionKind
template <typename Spec, typename Begin>
Action start(const ros::NodeHandle& handle, const std::string& name, const std::string& failure, const Begin& begin) {
  ActionKind<Spec> kind;
  kind.name = name;
  kind.begin = begin;
  kind.refuse = [failure](const std::exception& error) {
    return goalEnd<Spec>(EndedHow::kRefused, text::plainText(failure + ": " + error.what()));
  };
  return std::make_shared<GoalServer<Spec>>(handle, kind);
}

/// Returns a function that fills feedback with the time since now.
auto timeSinceNow() {
  return [begin = std::chrono::steady_clock::now()](auto* feedback) {
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
    feedback->time = ros::Duration(passed.count());
  };
}

/// Returns a function that looks for the end of a movement. If a server does not report the ends of motions, a goal
/// succeeds as soon as its motion plays.
/// @param done a text without a full stop that says that the robot has done it
/// @param fill fills feedback while the movement goes on
/// @throw CommandException the movement was refused
template <typename Spec, typename Fill>
auto lookFor(const movement::Mover::Answer& begun, const std::string& done, const Fill& fill) {
  throwIfRefused(begun);
  return [=](const typename Activity<Spec>::Publish& publish) -> std::optional<GoalEnd<Spec>> {
    const movement::EndedMovement* const ended = begun.ended();
    if (ended == nullptr) {
      FeedbackOf<Spec> feedback;
      fill(&feedback);
      publish(feedback);
      return std::nullopt;
    }
    const std::string& reason = ended->reason;
    const bool is_done = ended->how == EndedHow::kDone;
    GoalEnd<Spec> end =
        goalEnd<Spec>(ended->how, is_done ? done + (reason.empty() ? "" : ": " + reason) + "." : reason);
    if (ended->how == EndedHow::kUnknown && ended->movement.kind == movement::Movement::Kind::kMotion) {
      end.state = GoalEnd<Spec>::State::kSucceeded;
    }
    return end;
  };
}

Posture postureNamed(const std::string& name) {
  for (const Posture posture : {Posture::kStand, Posture::kSit, Posture::kRest}) {
    if (aibo_client::nameOfPosture(posture) == name) {
      return posture;
    }
  }
  throw aibo_client::InvalidArgumentException("the posture '" + text::plainLine(name) +
                                              "' is not one of stand, sit or rest.");
}

// Returns a function that ends a movement when its goal is cancelled.
auto cancelling(movement::Mover* mover, movement::MovementId movement) {
  return [=](const Order& by) { mover->cancel(movement, by.source + " cancelled the goal"); };
}

}  // namespace

Action startPlayMotion(const ros::NodeHandle& handle, movement::Mover& mover) {
  using Playing = Activity<PlayMotionAction>;
  const auto begin = [&mover](const PlayMotionGoal& goal, const Order& order) -> Playing {
    const std::string name = motionNamed(goal.name);
    const movement::Mover::Answer motion = mover.play(order, name, std::max<int>(1, goal.repetitions));
    const std::string remark = motion.remark.empty() ? "" : ": " + motion.remark;
    return {name + (motion.is_uncertain ? " may or may not play" : " plays") + remark,
            [&mover, name](const Order& by) { mover.stopMotion(by, name); },
            lookFor<PlayMotionAction>(motion, "It was played to its end" + (motion.is_uncertain ? "" : remark),
                                      timeSinceNow())};
  };
  return start<PlayMotionAction>(handle, "play_motion", "Nothing was played", begin);
}

Action startPlaySound(const ros::NodeHandle& handle, sound::Player& player) {
  using Playing = Activity<PlaySoundAction>;
  const auto begin = [&player](const PlaySoundGoal& goal, const Order&) -> Playing {
    if (goal.file.empty() == goal.text.empty()) {
      throw aibo_client::InvalidArgumentException("give a file or a text");
    }
    const std::shared_ptr<sound::Playback> playback =
        player.play(goal.file.empty() ? sound::speak(goal.text, goal.voice) : sound::openSoundFile(goal.file));
    const auto look = [playback](const Playing::Publish& publish) -> std::optional<GoalEnd<PlaySoundAction>> {
      if (const std::optional<sound::PlayedSound> end = playback->end()) {
        return goalEnd<PlaySoundAction>(end->how, end->message);
      }
      PlaySoundFeedback feedback;
      feedback.time = ros::Duration(playback->time().count());
      publish(feedback);
      return std::nullopt;
    };
    return {"It plays.", [&player, playback](const Order&) { player.stop(playback); }, look};
  };
  return start<PlaySoundAction>(handle, "play_sound", "Nothing was played", begin);
}

Action startGoTo(const ros::NodeHandle& handle, GoalWalks& walks, movement::Mover& mover) {
  const auto begin = [&](const GoToGoal& goal, const Order& order) -> Activity<GoToAction> {
    const GoalWalks::Begun begun = walks.begin(goal.pose, order);
    const auto what_is_left = [left = begun.left](GoToFeedback* feedback) {
      feedback->distance = left->distance;
      feedback->turn = left->turn;
    };
    return {"The robot is told to walk to the goal", cancelling(&mover, begun.answer.id),
            lookFor<GoToAction>(begun.answer, "The robot is there", what_is_left)};
  };
  return start<GoToAction>(handle, "go_to", "The robot does not walk to the goal", begin);
}

Action startTakePosture(const ros::NodeHandle& handle, movement::Mover& mover) {
  const auto begin = [&mover](const TakePostureGoal& goal, const Order& order) -> Activity<TakePostureAction> {
    const movement::Mover::Answer begun = mover.takePosture(order, postureNamed(goal.posture));
    return {begun.is_uncertain ? "The robot may or may not begin: " + begun.remark : "The robot begins",
            cancelling(&mover, begun.id),
            lookFor<TakePostureAction>(begun, "The robot has taken the posture", timeSinceNow())};
  };
  return start<TakePostureAction>(handle, "take_posture", "The robot does not take the posture", begin);
}

}  // namespace aibo_driver::node
