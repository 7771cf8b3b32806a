#include "tools/leave_to_move.h"

#include <ros/console.h>

#include "node/node.h"
#include "text/plain_text.h"

namespace aibo_driver::tools {
namespace {

// If a stream of cmd_vel was overruled, the driver ignores it until it has paused for 0.5 s.
const ros::WallDuration kPause(0.7);

}  // namespace

LeaveToMove::LeaveToMove(ros::NodeHandle handle, ros::NodeHandle parameters,
                         const std::function<std::string(const RobotState&)>& obstacle)
    : goes_on_(node::readFlag(parameters, "go_on_after_stop")), obstacle_(obstacle) {
  service_ = parameters.advertiseService<std_srvs::Trigger::Request, std_srvs::Trigger::Response>(
      "go_on", [this](std_srvs::Trigger::Request&, std_srvs::Trigger::Response& response) { return goOn(response); });
  states_ =
      handle.subscribe<RobotState>("robot_state", 1, [this](const RobotState::ConstPtr& state) { receive(*state); });
}

bool LeaveToMove::has() {
  const bool has = hindrance_.empty() && !needs_leave_ && ros::SteadyTime::now() >= free_at_;
  has_begun_ = has_begun_ || has;
  return has;
}

void LeaveToMove::overrule(const std::string& why) {
  if (has_begun_ && !goes_on_ && !needs_leave_) {
    needs_leave_ = true;
    ROS_WARN_STREAM("This node waits: " << why << ". It goes on when you call " << service_.getService() << ".");
  }
  free_at_ = ros::SteadyTime::now() + kPause;
}

void LeaveToMove::receive(const RobotState& state) {
  state_ = state;
  hindrance_ = state.stopped != 0 ? text::plainLine(state.stopped_by) + " has stopped the robot"
               : obstacle_        ? obstacle_(state)
                                  : "";
  has_begun_ = has_begun_ || state.stopped != 0;  // whoever stops everything means this node, too
  if (!hindrance_.empty()) {
    overrule(hindrance_);
  }
}

bool LeaveToMove::goOn(std_srvs::Trigger::Response& response) {
  needs_leave_ = needs_leave_ && !hindrance_.empty();
  response.success = static_cast<std::uint8_t>(hindrance_.empty());
  response.message = hindrance_.empty() ? "This node goes on." : "This node cannot go on: " + hindrance_ + ".";
  return true;
}

}  // namespace aibo_driver::tools
