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

// In all these functions, the callbacks of the handle's queue have to run one after the other. All other arguments must
// outlive the action.

/// Starts play_motion. Several motions of different joints may play at the same time. If a motion does not begin, its
/// goal is rejected. Otherwise the goal ends with the motion. Cancelling the goal stops the motion.
///
/// If a server does not report the ends of motions, each goal succeeds as soon as its motion plays.
Action startPlayMotion(const ros::NodeHandle& handle, movement::Mover& mover);

/// Starts play_sound. A goal ends with its sound, and cancelling it stops the sound.
Action startPlaySound(const ros::NodeHandle& handle, sound::Player& player);

/// Starts follow_joint_trajectory of control_msgs. A goal is a trajectory like those of the topic joint_trajectory,
/// with tolerances. Goals for different joints run side by side. Cancelling a goal stops its joints where they are.
/// @return null if the driver was built without control_msgs
Action startFollowTrajectory(const ros::NodeHandle& handle, const movement::JointTable& table,
                             const movement::MeasuredJoints& measured, movement::Mover& mover);

/// Starts go_to. A goal ends with its walk, and cancelling it stops the walk.
/// @param handle its queue also calls all other functions of `walks`
Action startGoTo(const ros::NodeHandle& handle, GoalWalks& walks, movement::Mover& mover);

/// Starts take_posture. A goal ends when the robot has taken the posture. After a cancel, the legs hold.
Action startTakePosture(const ros::NodeHandle& handle, movement::Mover& mover);

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_ACTIONS_H
