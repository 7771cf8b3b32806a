#include "joint_interface.h"

#include <ros/console.h>

namespace aibo_driver {
namespace {

JointLink::Robot robotOf(RcServerClient& client) {
  JointLink::Robot robot;
  robot.connections = [&client] { return client.statistics().connections; };
  robot.set_speed_limits = [&client](const std::vector<JointSpeedLimit>& limits) {
    client.setJointSpeedLimits(limits);
  };
  robot.command = [&client](const std::vector<JointTarget>& targets, std::chrono::milliseconds duration) {
    client.commandJoints(targets, duration);
  };
  return robot;
}

ros::NodeHandle withQueue(ros::NodeHandle handle, ros::CallbackQueue& queue) {
  handle.setCallbackQueue(&queue);
  return handle;
}

}  // namespace

JointInterface::JointInterface(const ros::NodeHandle& handle, const DriverParameters& parameters,
                               RcServerClient& client)
    : table_(parameters.robot, parameters.joint_speed_limit),
      measured_(table_),
      telemetry_publisher_(handle, table_, measured_, parameters.time_offset),
      link_(robotOf(client)),
      handle_(withQueue(handle, queue_)),
      trajectories_(handle_, table_, measured_, link_, parameters.slow_down),
      commander_(handle_, table_, measured_, link_, parameters.approach_speed,
                 [this](const std::vector<JointOrder>& orders) { trajectories_.yieldTo(orders); }),
      motors_(handle_, client,
              [this](bool on) {
                commander_.startApproach();
                if (!on) {
                  trajectories_.end("the motors were switched off");
                }
              }),
      thread_(1, &queue_) {
  client.setTelemetryPeriod(parameters.telemetry_period);
  thread_.start();
}

JointInterface::~JointInterface() {
  thread_.stop();
}

void JointInterface::updateConnection(const ConnectionStatus& status) {
  if (status.state != ConnectionState::kConnected) {
    measured_.clear();
  } else if (!status.robot.design.empty() && status.robot.design != table_.design()) {
    ROS_WARN_STREAM_NAMED("joints", "The robot says it is an " << status.robot.design << ", but the parameter robot is "
                                                               << table_.design()
                                                               << ": its joints are not moved rightly. Set it.");
  }
}

}  // namespace aibo_driver
