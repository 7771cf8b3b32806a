#include <aibo_driver/PlayMotionAction.h>

#include <algorithm>

#include "node/goal_server.h"
#include "node/services.h"

namespace aibo_driver::node {

Action startPlayMotion(const ros::NodeHandle& handle, movement::Mover& mover) {
  ActionKind<PlayMotionAction> kind;
  kind.name = "play_motion";
  kind.begin = [&mover](const PlayMotionGoal& goal, const movement::Order& order) -> Activity<PlayMotionAction> {
    const std::string name = motionNamed(goal.name);
    const movement::Mover::Answer motion = mover.play(order, name, std::max<int>(1, goal.repetitions));
    const std::string remark = motion.remark.empty() ? "" : ": " + motion.remark;
    return {name + (motion.is_uncertain ? " may or may not play" : " plays") + remark,
            [&mover, name](const movement::Order& by) { mover.stopMotion(by, name); },
            lookFor<PlayMotionAction>(motion, "It was played to its end" + (motion.is_uncertain ? "" : remark))};
  };
  kind.refuse = refuseWith<PlayMotionAction>("Nothing was played");
  return std::make_shared<GoalServer<PlayMotionAction>>(handle, kind);
}

}  // namespace aibo_driver::node
