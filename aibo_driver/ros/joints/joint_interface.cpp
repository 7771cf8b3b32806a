#include "ros/joints/joint_interface.h"

#include <ros/console.h>

#include <utility>

namespace aibo_driver::node {
namespace {

joints::JointLink::Robot robotOf(RcServerClient& client) {
  joints::JointLink::Robot robot;
  robot.connections = [&client] { return client.statistics().connections; };
  robot.set_speed_limits = [&client](const std::vector<JointSpeedLimit>& limits) {
    client.setJointSpeedLimits(limits);
  };
  robot.command = [&client](const std::vector<JointTarget>& targets, std::chrono::milliseconds duration) {
    client.commandJoints(targets, duration);
  };
  return robot;
}

}  // namespace

JointInterface::JointInterface(const ros::NodeHandle& handle, const DriverParameters& parameters,
                               RcServerClient& client, TelemetryStamper stamp_of)
    : table_(parameters.robot, parameters.joint_speed_limit),
      measured_(table_),
      telemetry_publisher_(handle, table_, measured_, std::move(stamp_of)),
      link_(robotOf(client)),
      thread_(handle),
      trajectories_(thread_.handle(), table_, measured_, link_, parameters.slow_down),
      commander_(thread_.handle(), table_, measured_, link_, parameters.approach_speed,
                 [this](const std::vector<joints::JointOrder>& orders) { trajectories_.yieldTo(orders); }),
      motors_(thread_.handle(), client,
              [this] {
                trajectories_.end("the motors are switched");
                commander_.startApproach();
              }),
      motions_(thread_.handle(), client, [this] {
        trajectories_.end("play_motion is to play a motion");
        link_.limitSpeeds(table_.speedLimits());
      }) {
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

}  // namespace aibo_driver::node
