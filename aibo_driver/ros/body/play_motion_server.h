/// @file play_motion_server.h
#ifndef AIBO_DRIVER_ROS_BODY_PLAY_MOTION_SERVER_H
#define AIBO_DRIVER_ROS_BODY_PLAY_MOTION_SERVER_H

#include <actionlib/server/action_server.h>
#include <aibo_driver/PlayMotionAction.h>
#include <ros/node_handle.h>
#include <ros/steady_timer.h>

#include <chrono>
#include <memory>
#include <vector>

#include "aibo_driver/rcserver_client.h"
#include "ros/joints/joint_mover.h"

namespace aibo_driver::node {

/// The action play_motion. Several motions of different joints may play at the same time. A goal is rejected if its
/// motion does not begin; else it ends with the motion. Cancelling it stops the motion.
///
/// A server that does not report the ends of motions lets each goal succeed as soon as its motion plays.
class PlayMotionServer {
 public:
  static constexpr std::chrono::milliseconds kFeedbackPeriod{100};

  /// @param client, mover must outlive the server
  PlayMotionServer(RcServerClient& client, JointMover& mover) : client_(client), mover_(mover) {}

  /// @param handle whose callback queue one thread serves
  void start(const ros::NodeHandle& handle);

 private:
  using Server = actionlib::ActionServer<PlayMotionAction>;

  struct Playing {
    Server::GoalHandle goal;
    JointMover::Fate motion;
    std::chrono::steady_clock::time_point begin;
  };

  void accept(Server::GoalHandle goal);
  void cancel(const Server::GoalHandle& goal);
  void report();
  static void finish(Server::GoalHandle goal, const joints::MovementFate& fate);

  RcServerClient& client_;
  JointMover& mover_;
  std::unique_ptr<Server> server_;
  std::vector<Playing> playing_;
  ros::SteadyTimer timer_;
};

}  // namespace aibo_driver::node

#endif  // AIBO_DRIVER_ROS_BODY_PLAY_MOTION_SERVER_H
