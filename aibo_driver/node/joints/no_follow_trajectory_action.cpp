// This file is for a system without control_msgs, such as Debian 12.

#include "node/actions.h"

namespace aibo_driver::node {

std::unique_ptr<Action> startFollowTrajectory(const ros::NodeHandle&, const movement::JointTable&,
                                              const movement::MeasuredJoints&, movement::Mover&) {
  return nullptr;
}

}  // namespace aibo_driver::node
