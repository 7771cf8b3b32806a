#include <aibo_driver/TakePostureAction.h>

#include <map>

#include "node/goal_server.h"
#include "text/plain_text.h"

namespace aibo_driver::node {

using aibo_client::Posture;

namespace {

Posture postureNamed(const std::string& name) {
  static const std::map<std::string, Posture> kPostures = {
      {"stand", Posture::kStand}, {"sit", Posture::kSit}, {"rest", Posture::kRest}};
  const auto found = kPostures.find(name);
  if (found == kPostures.end()) {
    throw aibo_client::InvalidArgumentException("there is no posture '" + text::plainLine(name) +
                                                "'; there are stand, sit and rest.");
  }
  return found->second;
}

}  // namespace

Action startTakePosture(const ros::NodeHandle& handle, movement::Mover& mover) {
  ActionKind<TakePostureAction> kind;
  kind.name = "take_posture";
  kind.begin = [&mover](const TakePostureGoal& goal, const movement::Order& order) -> Activity<TakePostureAction> {
    const movement::Mover::Answer begun = mover.takePosture(order, postureNamed(goal.posture));
    return {begun.is_uncertain ? "The robot may or may not begin: " + begun.remark : "The robot begins",
            [&mover, begun](const movement::Order& by) { mover.cancel(begun.id, by.source + " cancelled the goal"); },
            lookFor<TakePostureAction>(begun, "The robot has taken the posture")};
  };
  kind.refuse = refuseWith<TakePostureAction>("The robot does not take the posture");
  return std::make_shared<GoalServer<TakePostureAction>>(handle, kind);
}

}  // namespace aibo_driver::node
