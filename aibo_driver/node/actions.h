/// @file actions.h
/// The driver's actions. goal_server.h has what they share.
#ifndef AIBO_DRIVER_NODE_ACTIONS_H
#define AIBO_DRIVER_NODE_ACTIONS_H

#include <ros/node_handle.h>

#include <memory>

#include "movement/joint_table.h"
#include "movement/measured_joints.h"
#include "movement/mover.h"
#include "node/walk/goal_walks.h"
#include "sound/player.h"

namespace aibo_driver::node {

/// An action, which is served while this object lives. Its type hides actionlib's headers, which take long to compile.
using Action = std::shared_ptr<void>;

// docs/ros_interface.md says what each action does. The callbacks of a handle's queue have to run one after the other.
// All other arguments must outlive the action.
Action startPlayMotion(const ros::NodeHandle& handle, movement::Mover& mover);
Action startPlaySound(const ros::NodeHandle& handle, sound::Player& player);
Action startTakePosture(const ros::NodeHandle& handle, movement::Mover& mover);

/// Starts follow_joint_trajectory.
/// @return null if the driver was built without control_msgs
Action startFollowTrajectory(const ros::NodeHandle& handle, const movement::JointTable& table,
                             const movement::MeasuredJoints& measured, movement::Mover& mover);

/// Starts go_to.
/// @param handle its queue also calls all other functions of `walks`
Action startGoTo(const ros::NodeHandle& handle, GoalWalks& walks, movement::Mover& mover);

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_ACTIONS_H
