#include <aibo_driver/PlaySoundAction.h>

#include "node/goal_server.h"
#include "sound/source.h"

namespace aibo_driver::node {
namespace {

using End = GoalEnd<PlaySoundAction>;

std::shared_ptr<sound::Playback> play(sound::Player* player, const PlaySoundGoal& goal) {
  if (goal.file.empty() == goal.text.empty()) {
    throw aibo_client::InvalidArgumentException("give a file or a text");
  }
  return player->play(goal.file.empty() ? sound::speak(goal.text, goal.voice) : sound::openSoundFile(goal.file));
}

}  // namespace

Action startPlaySound(const ros::NodeHandle& handle, sound::Player& player) {
  ActionKind<PlaySoundAction> kind;
  kind.name = "play_sound";
  kind.begin = [&player](const PlaySoundGoal& goal, const movement::Order&) -> Activity<PlaySoundAction> {
    const std::shared_ptr<sound::Playback> playback = play(&player, goal);
    return {"It plays.", [&player, playback](const movement::Order&) { player.stop(playback); },
            lookFor<PlaySoundAction>([playback]() -> std::optional<End> {
              const std::optional<sound::PlayedSound> end = playback->end();
              return end ? std::make_optional(goalEnd<PlaySoundAction>(end->how, end->message)) : std::nullopt;
            })};
  };
  kind.refuse = refuseWith<PlaySoundAction>("Nothing was played");
  return std::make_shared<GoalServer<PlaySoundAction>>(handle, kind);
}

}  // namespace aibo_driver::node
