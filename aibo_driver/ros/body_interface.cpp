#include "body_interface.h"

#include <utility>

#include "robot_model/robot_model.h"

namespace aibo_driver {

BodyInterface::BodyInterface(const ros::NodeHandle& handle, const std::string& design, RcServerClient& client,
                             TelemetryStamper stamp_of)
    : sensors_(handle, design, std::move(stamp_of)),
      thread_(handle),
      expression_(thread_.handle(), *robot_model::findRobotModel(design.c_str()), client),
      motion_files_(thread_.handle(), client),
      power_(thread_.handle(), client) {
  thread_.start();
}

BodyInterface::~BodyInterface() {
  thread_.stop();
}

}  // namespace aibo_driver
