#include "ros/body/body_interface.h"

#include <utility>

namespace aibo_driver::node {

BodyInterface::BodyInterface(const ros::NodeHandle& handle, const robot_model::RobotModel& model,
                             RcServerClient& client, TelemetryStamper stamp_of)
    : sensors_(handle, model, std::move(stamp_of)),
      thread_(handle),
      expression_(thread_.handle(), model, client),
      motion_files_(thread_.handle(), client),
      power_(thread_.handle(), client) {
  thread_.start();
}

BodyInterface::~BodyInterface() {
  thread_.stop();
}

}  // namespace aibo_driver::node
