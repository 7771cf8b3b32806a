#include <aibo_driver/GoToAction.h>

#include "node/goal_server.h"
#include "node/walk/goal_walks.h"

namespace aibo_driver::node {

Action startGoTo(const ros::NodeHandle& handle, GoalWalks& walks, movement::Mover& mover) {
  ActionKind<GoToAction> kind;
  kind.name = "go_to";
  kind.begin = [&](const GoToGoal& goal, const movement::Order& order) -> Activity<GoToAction> {
    const movement::Mover::Answer begun = walks.begin(goal.pose, order);
    throwIfRefused(begun);
    const auto stop = [&mover, begun](const movement::Order& by) {
      mover.cancel(begun.id, by.source + " cancelled the goal");
    };
    const auto look = [&walks,
                       begun](const Activity<GoToAction>::Publish& publish) -> std::optional<GoalEnd<GoToAction>> {
      if (const movement::EndedMovement* const ended = begun.ended()) {
        return goalEnd<GoToAction>(*ended, "The robot is there");
      }
      GoToFeedback feedback;
      feedback.distance = walks.distanceLeft();
      feedback.turn = walks.turnLeft();
      publish(feedback);
      return std::nullopt;
    };
    return {"The robot walks to the goal", stop, look};
  };
  kind.refuse = refuseWith<GoToAction>("The robot does not walk to the goal");
  return std::make_shared<GoalServer<GoToAction>>(handle, kind);
}

}  // namespace aibo_driver::node
