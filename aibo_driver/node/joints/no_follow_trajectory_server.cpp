// This file is for a system without control_msgs, such as Debian 12.

#include "node/joints/follow_trajectory_server.h"

namespace aibo_driver::node {

std::unique_ptr<FollowTrajectoryServer> startFollowTrajectoryServer(const ros::NodeHandle&, const movement::JointTable&,
                                                                    const movement::MeasuredJoints&, movement::Mover&) {
  return nullptr;
}

}  // namespace aibo_driver::node
