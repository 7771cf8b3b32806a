/// @file follow_trajectory_server.h
#ifndef AIBO_DRIVER_NODE_JOINTS_FOLLOW_TRAJECTORY_SERVER_H
#define AIBO_DRIVER_NODE_JOINTS_FOLLOW_TRAJECTORY_SERVER_H

#include <ros/node_handle.h>

#include <memory>

#include "movement/joint_table.h"
#include "movement/measured_joints.h"
#include "movement/mover.h"

namespace aibo_driver::node {

/// The action follow_joint_trajectory of control_msgs. A goal is a trajectory like those of the topic joint_trajectory,
/// with tolerances. Goals for different joints run side by side. Cancelling a goal stops its joints where they are.
class FollowTrajectoryServer {
 public:
  virtual ~FollowTrajectoryServer() = default;
};

/// Starts the action.
/// @param handle whose callback queue one thread serves
/// @param table, measured, mover must outlive the server
/// @return null if the driver was built without control_msgs
std::unique_ptr<FollowTrajectoryServer> startFollowTrajectoryServer(const ros::NodeHandle& handle,
                                                                    const movement::JointTable& table,
                                                                    const movement::MeasuredJoints& measured,
                                                                    movement::Mover& mover);

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_JOINTS_FOLLOW_TRAJECTORY_SERVER_H
