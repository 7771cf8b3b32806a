#include <aibo_driver/GoToAction.h>

#include <memory>

#include "node/followed_action.h"
#include "node/walk/goal_walks.h"

namespace aibo_driver::node {

std::unique_ptr<Action> startGoTo(const ros::NodeHandle& handle, GoalWalks& walks) {
  ActionWay<GoToAction> way;
  way.name = "go_to";
  way.logger = "joints";
  way.period = GoalWalks::kPeriod;
  way.begin = [&walks](const GoToGoal& goal, const movement::Order& order) -> Followed<GoToAction> {
    const auto walk = std::make_shared<GoalWalks::Walk>(walks.begin(goal.pose, order));
    throwIfRefused(walk->begun());
    const auto stop = [walk](const movement::Order& by) { walk->stop(by.source + " cancelled the goal"); };
    const auto look = [walk](const Followed<GoToAction>::Publish& publish) -> std::optional<GoalEnd<GoToAction>> {
      if (const movement::EndedMovement* const ended = walk->goOn()) {
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
  way.refuse = refuseWith<GoToAction>("The robot does not walk to the goal");
  return std::make_unique<FollowedAction<GoToAction>>(handle, way);
}

}  // namespace aibo_driver::node
