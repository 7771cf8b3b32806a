#include "node/walk/walk_commander.h"

#include <ros/message_event.h>

#include <chrono>
#include <cmath>

#include "node/orders.h"
#include "text/number.h"

namespace aibo_driver::node {
namespace {

using Twist = geometry_msgs::Twist;
using Seconds = std::chrono::duration<double>;

bool isFinite(const geometry_msgs::Vector3& vector) {
  return std::isfinite(vector.x) && std::isfinite(vector.y) && std::isfinite(vector.z);
}

}  // namespace

void WalkCommander::subscribe(const ros::NodeHandle& handle) {
  ros::NodeHandle topics(handle);
  constexpr bool kOneShot = true;
  constexpr bool kAutostart = false;
  timer_ = topics.createSteadyTimer(
      ros::WallDuration(Seconds(settings_.timeout).count()), [this](const ros::SteadyTimerEvent&) { runOut(); },
      kOneShot, kAutostart);
  const boost::function<void(const ros::MessageEvent<Twist const>&)> receive =
      [this](const ros::MessageEvent<Twist const>& event) { this->receive(*event.getMessage(), orderOf(event)); };
  constexpr std::uint32_t kNewest = 1;
  subscriber_ =
      topics.subscribe<Twist>("cmd_vel", kNewest, receive, ros::VoidConstPtr(), ros::TransportHints().tcpNoDelay());
}

void WalkCommander::receive(const Twist& message, const movement::Order& order) {
  if (!isFinite(message.linear) || !isFinite(message.angular)) {
    mover_.refuse(order, movement::Movement::Kind::kWalk, {},
                  "it has a value that is NaN or infinite. Without a good message the robot stops.");
    return;
  }
  const aibo_client::WalkVelocity wanted{message.linear.x, message.linear.y, message.angular.z};
  mover_.steer(order, walk::velocityToSend(wanted, settings_, client_.status().robot.walk_limits));
  timer_.stop();  // a timer that has run out does not start again unless it was stopped
  if (!wanted.isZero()) {
    timer_.start();
  }
}

void WalkCommander::runOut() {
  mover_.stopWalking("no cmd_vel came for " + text::decimal(Seconds(settings_.timeout).count(), 1) + " s");
}

}  // namespace aibo_driver::node
