#include <aibo_driver/GoToAction.h>

#include <memory>

#include "node/goal_server.h"
#include "node/walk/goal_walks.h"

namespace aibo_driver::node {

std::unique_ptr<Action> startGoTo(const ros::NodeHandle& handle, GoalWalks& walks) {
  ActionKind<GoToAction> kind;
  kind.name = "go_to";
  kind.logger = "joints";
  kind.period = GoalWalks::kPeriod;
  kind.begin = [&walks](const GoToGoal& goal, const movement::Order& order) -> Activity<GoToAction> {
    const auto walk = std::make_shared<GoalWalks::Walk>(walks.begin(goal.pose, order));
    throwIfRefused(walk->begun());
    const auto stop = [walk](const movement::Order& by) { walk->stop(by.source + " cancelled the goal"); };
    const auto look = [walk](const Activity<GoToAction>::Publish& publish) -> std::optional<GoalEnd<GoToAction>> {
      if (const movement::EndedMovement* const ended = walk->advance()) {
        return goalEnd<GoToAction>(*ended, "The robot is there");
      }
      GoToFeedback feedback;
      feedback.distance = walk->distanceLeft();
      feedback.turn = walk->turnLeft();
      publish(feedback);
      return std::nullopt;
    };
    return {"The robot walks to the goal", stop, look};
  };
  kind.refuse = refuseWith<GoToAction>("The robot does not walk to the goal");
  return std::make_unique<GoalServer<GoToAction>>(handle, kind);
}

}  // namespace aibo_driver::node
