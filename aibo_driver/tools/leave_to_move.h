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

/// Whether a node that moves the robot without being asked each time may do so. When somebody stops the robot, or
/// overrules the node in another way, it loses leave. It gets leave again when the user says so: by the node's service
/// ~go_on, or at the start by the parameter ~go_on_after_stop. Then it goes on by itself as soon as it can.
///
/// All functions from the thread that serves the handle's callbacks.
class LeaveToMove {
 public:
  /// @param handle in the driver's namespace
  /// @param parameters the node's own namespace
  /// @param obstacle says why the node cannot go on in this state of the robot, besides a stop; empty if it can
  LeaveToMove(ros::NodeHandle handle, ros::NodeHandle parameters,
              const std::function<std::string(const RobotState&)>& obstacle = {});

  /// Whether to move now. From the first time on that it is true, an obstacle takes leave.
  bool has();

  /// Something else moves what the node moves, such as a posture.
  void overrule(const std::string& why);

  /// The robot's, as the driver said last.
  const RobotState& state() const { return state_; }

 private:
  void receive(const RobotState& state);
  bool goOn(std_srvs::Trigger::Response& response);

  const bool goes_on_;  ///< by itself
  const std::function<std::string(const RobotState&)> obstacle_;
  RobotState state_;
  bool has_begun_ = false;
  bool needs_leave_ = false;
  std::string hindrance_;    ///< why it cannot go on now; empty if it can
  ros::SteadyTime free_at_;  ///< when it may go on, if nothing comes between
  ros::ServiceServer service_;
  ros::Subscriber states_;  // last: its callback uses all of the above
};

}  // namespace aibo_driver::tools

#endif  // AIBO_DRIVER_TOOLS_LEAVE_TO_MOVE_H
