#include "tools/teleop/teleop_node.h"

#include <std_srvs/Trigger.h>

#include <utility>

#include "node/node.h"

namespace teleop {

using std_srvs::Trigger;

Speeds readSpeeds(const ros::NodeHandle& parameters) {
  using aibo_driver::node::readNumber;
  Speeds speeds;
  speeds.forward = readNumber(parameters, "speed", speeds.forward, 1.0);
  speeds.left = readNumber(parameters, "side_speed", speeds.left, 1.0);
  speeds.turn = readNumber(parameters, "turn_speed", speeds.turn, 10.0);
  return speeds;
}

geometry_msgs::Twist toTwist(const aibo_client::WalkVelocity& velocity) {
  geometry_msgs::Twist twist;
  twist.linear.x = velocity.forward;
  twist.linear.y = velocity.left;
  twist.angular.z = velocity.turn;
  return twist;
}

StopAndRelease::StopAndRelease(ros::NodeHandle handle, std::string how, std::function<void(const std::string&)> tell)
    : how_(std::move(how)), tell_(std::move(tell)), stop_(handle), release_(handle.resolveName("release")) {
  states_ = handle.subscribe("robot_state", 1, &StopAndRelease::receive, this);
}

void StopAndRelease::stop() {
  stop_.stop([this](const Trigger::Response* response) { logAnswer(stop_.service(), response); });
}

bool StopAndRelease::release() {
  if (stopped_by_.empty()) {
    return false;
  }
  call<Trigger>(calls_, release_, {});
  return true;
}

void StopAndRelease::receive(const aibo_driver::RobotState::ConstPtr& state) {
  const std::string stopped_by = state->stopped != 0 ? aibo_driver::text::plainLine(state->stopped_by) : "";
  if (stopped_by != std::exchange(stopped_by_, stopped_by)) {
    tell_(stopped_by.empty() ? "The robot may move again." : stopped_by + " has stopped the robot. " + how_);
  }
}

}  // namespace teleop
