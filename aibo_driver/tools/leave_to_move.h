/// @file leave_to_move.h
#ifndef AIBO_DRIVER_TOOLS_LEAVE_TO_MOVE_H
#define AIBO_DRIVER_TOOLS_LEAVE_TO_MOVE_H

#include <aibo_driver/RobotState.h>
#include <ros/node_handle.h>
#include <ros/service_server.h>
#include <ros/subscriber.h>
#include <std_srvs/Trigger.h>

#include <functional>
#include <string>

namespace aibo_driver::tools {

/// Permission for a node to move the robot by itself. When somebody stops the robot, or overrules the node in another
/// way, the node loses its permission. The user can give it back by the node's service ~go_on. If the parameter
/// ~go_on_after_stop is true, the node goes on by itself as soon as it can.
///
/// Only the thread that serves the handle's callbacks may call these functions.
class LeaveToMove {
 public:
  /// @param handle a handle in the driver's namespace
  /// @param parameters the node's own namespace
  /// @param obstacle says why the node cannot go on in this state of the robot, apart from a stop; empty if it can
  /// @throw std::runtime_error ~go_on_after_stop is neither true nor false
  LeaveToMove(ros::NodeHandle handle, ros::NodeHandle parameters,
              const std::function<std::string(const RobotState&)>& obstacle = {});

  /// Whether the node may move now. Once this has been true, any obstacle takes the permission away.
  bool has();

  /// Call this when something else moves what the node moves, for example a posture.
  void overrule(const std::string& why);

  /// The robot's state, as the driver last reported it.
  const RobotState& state() const { return state_; }

 private:
  void receive(const RobotState& state);
  bool goOn(std_srvs::Trigger::Response& response);

  const bool goes_on_;  ///< true: the node goes on by itself
  const std::function<std::string(const RobotState&)> obstacle_;
  RobotState state_;
  bool has_begun_ = false;
  bool needs_leave_ = false;
  std::string hindrance_;    ///< why the node cannot go on now; empty if it can
  ros::SteadyTime free_at_;  ///< when the node may go on if nothing else happens
  ros::ServiceServer service_;
  ros::Subscriber states_;  // last, because its callback uses all members above
};

}  // namespace aibo_driver::tools

#endif  // AIBO_DRIVER_TOOLS_LEAVE_TO_MOVE_H
