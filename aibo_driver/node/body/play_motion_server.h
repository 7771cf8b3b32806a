/// @file play_motion_server.h
#ifndef AIBO_DRIVER_NODE_BODY_PLAY_MOTION_SERVER_H
#define AIBO_DRIVER_NODE_BODY_PLAY_MOTION_SERVER_H

#include <ros/node_handle.h>

#include <memory>

#include "movement/mover.h"

namespace aibo_driver::node {

/// The action play_motion. Several motions of different joints may play at the same time. If a motion does not begin,
/// its goal is rejected. Otherwise the goal ends with the motion. Cancelling the goal stops the motion.
///
/// If a server does not report the ends of motions, each goal succeeds as soon as its motion plays.
///
/// This is an interface because actionlib's headers take long to compile.
class PlayMotionServer {
 public:
  virtual ~PlayMotionServer() = default;
};

/// Starts the action.
/// @param handle whose callback queue one thread serves
/// @param mover must outlive the server
std::unique_ptr<PlayMotionServer> startPlayMotionServer(const ros::NodeHandle& handle, movement::Mover& mover);

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_NODE_BODY_PLAY_MOTION_SERVER_H
