#include <aibo_driver/TakePostureAction.h>

#include <map>

#include "node/followed_action.h"
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

std::unique_ptr<Action> startTakePosture(const ros::NodeHandle& handle, movement::Mover& mover) {
  ActionWay<TakePostureAction> way;
  way.name = "take_posture";
  way.logger = "joints";
  way.begin = [&mover](const TakePostureGoal& goal, const movement::Order& order) -> Followed<TakePostureAction> {
    const movement::Mover::Begun begun = mover.takePosture(order, postureNamed(goal.posture));
    return {begun.is_uncertain ? "The robot may or may not begin: " + begun.remark : "The robot begins",
            [&mover, begun](const movement::Order& by) { mover.cancel(begun.id, by.source + " cancelled the goal"); },
            lookFor<TakePostureAction>(begun, "The robot has taken the posture")};
  };
  way.refuse = refuseWith<TakePostureAction>("The robot does not take the posture");
  return std::make_unique<FollowedAction<TakePostureAction>>(handle, way);
}

}  // namespace aibo_driver::node
